/** Looking closely at a path: what is cut when, what is where, all strategies side by side, drawings, and what survives. */
import { readFileSync } from 'node:fs';
import { drop, expect, expectToLookAs, figure, number, picture, proof, set, test, visit } from './harness.js';

/** A rod of 30 mm radius, so small and coarse that it is planned and proven at once. */
const ROD = {
  version: 1,
  name: 'Rod',
  source: { kind: 'cylinder', radius_mm: 30, angle_deg: 30, length_mm: 14 },
  cutter: { kind: 'bull_nose', diameter_mm: 10, corner_radius_mm: 2, height_mm: 30 },
  strategy: { kind: 'iso_parametric', along: 'u', lead_deg: 6 },
  tolerance: { scallop_mm: 0.05, chord_mm: 0.005 },
  verify: { spacing_mm: 1 },
};

const encoded = (text) => Buffer.from(text).toString('base64');
const plan = (page) => page.locator('button[name=plan]').click();

/** Opens the page with the rod planned and proven. */
async function open(page, job = ROD) {
  await visit(page);
  await drop(page, [{ name: 'rod.job.json', base64: encoded(JSON.stringify(job)) }]);
  await expect(page.locator('[name="tolerance.scallop_mm"]')).toHaveValue('0.05');
  await plan(page);
  await expect(page.locator('.stale')).toBeHidden();
  await proof(page);
}

async function saved(page, id) {
  const [download] = await Promise.all([
    page.waitForEvent('download'),
    page.locator(`[data-save=${id}]`).click(),
  ]);
  return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
}

test('a path is looked at closely: what it cuts when, places, parameters, drawings, and every strategy beside it', async ({
  page,
}) => {
  test.setTimeout(240_000);
  await open(page);

  // Every figure tells what it means, on request.
  const excess = page.locator('[data-figure=excess]').first();
  await expect(excess.locator('.why')).toBeHidden();
  await excess.locator('.ask').click();
  await expect(excess.locator('.why')).toContainText('above the surface');
  const asked = await page.locator('#results [data-figure]').count();
  expect(await page.locator('#results [data-figure] .ask').count()).toBe(asked);

  // The histogram's shares are of the whole.
  await page.locator('.histogram summary').click();
  const shares = (await page.locator('.histogram td').allTextContents()).map(number);
  // Each is rounded.
  expect(Math.abs(shares.reduce((sum, share) => sum + share, 0) - 100)).toBeLessThan(4);

  // Half way along the path a part is still to be cut, at its end nothing is.
  await page.locator('input[name=at]').fill('3000');
  await expect(page.locator('#legend')).toContainText('still to be cut');
  await picture(page, 'removal');
  await expectToLookAs(page, 'removal');
  await page.locator('input[name=at]').fill('10000');
  await expect(page.locator('#legend')).not.toContainText('still to be cut');

  // The rod bends by its radius one way, and not the other.
  await page.locator('#canvas canvas').click();
  const picked = (id) => page.locator(`#picked [data-figure=${id}] dd`);
  await expect(picked('least')).toContainText('R 30.0 mm');
  await expect(picked('most')).toHaveText('flat');
  await expect(picked('uv')).toHaveText(/^−?[\d.]+, −?[\d.]+$/);
  expect(number(await picked('excess').textContent())).toBeLessThan(50.1);

  // The colours' range is pulled apart, and put back.
  await page.locator('.range summary').click();
  await page.locator('input[name="range-high"]').fill('50');
  await expect(page.locator('#legend .numbers')).toContainText('+25');
  await page.locator('button[name=range-reset]').click();
  await expect(page.locator('#legend .numbers')).toContainText('+50');

  // Standard views and the other projection, by the keyboard and by the cube.
  await page.locator('#canvas canvas').focus();
  await page.keyboard.press('o');
  await expect(page.locator('button[name=parallel]')).toHaveAttribute('aria-pressed', 'true');
  await page.keyboard.press('2');
  await expect(page.locator('.cube [data-side=front]')).toBeEnabled();
  await expect(page.locator('.cube [data-side=top]')).toBeDisabled();
  await page.keyboard.press('1');
  await expect(page.locator('.cube [data-side=top]')).toBeEnabled();

  // Passes over the parameters: as many as there are.
  await page.keyboard.press('u');
  const passes = page.locator('#domain .passes');
  await passes.waitFor();
  const ways = (await passes.getAttribute('d')).match(/M/g).length;
  expect(ways).toBe(number(await figure(page, 'passes').textContent()));
  await picture(page, 'domain');
  await expectToLookAs(page, 'domain');
  const domain = await saved(page, 'domain');
  expect(domain.bytes.toString()).toMatch(/^<svg[^>]*xmlns/);
  const above = await saved(page, 'plan');
  expect(above.name).toMatch(/^rod.*\.plan\.svg$/);
  expect(above.bytes.toString()).toMatch(/^<svg[\s\S]*<\/svg>\s*$/);
  await page.locator('button[name=flat]').click();
  const png = await saved(page, 'png');
  expect(png.bytes.subarray(1, 4).toString()).toBe('PNG');
  expect(png.bytes.length).toBeGreaterThan(10_000);

  // The sheet for the machine, as it is handed to the printer.
  await page.evaluate(() => {
    window.print = () => {
      window.printed = document.querySelector('#sheet').textContent;
    };
  });
  await page.locator('[data-save=sheet]').click();
  const sheet = await page.evaluate(() => window.printed);
  for (const told of ['Rod', 'T1', '10.0 mm', '1,500 mm/min', '50.0 µm']) expect(sheet).toContain(told);
  await page.emulateMedia({ media: 'print' });
  expect(await page.locator('#sheet').evaluate((element) => element.scrollHeight)).toBeLessThan(1060);
  await picture(page, 'sheet');
  await page.emulateMedia({ media: 'screen' });

  // All strategies, none below the floor; one is laid over the picture, another taken up.
  await page.locator('button[name=compare]').click();
  await expect(page.locator('button[name=stop-comparing]')).toBeVisible();
  await expect(page.locator('button[name=stop-comparing]')).toBeHidden({ timeout: 120_000 });
  const rows = page.locator('table.runs tbody tr');
  expect(await rows.count()).toBeGreaterThan(9);
  const floors = (await rows.locator('td:nth-of-type(2)').allTextContents())
    .filter((text) => text !== '–')
    .map(number);
  expect(floors.length).toBeGreaterThan(9);
  for (const share of floors) expect(share).toBeGreaterThan(1);
  await rows.nth(1).locator('input').check();
  await picture(page, 'runs');
  const flow = rows.filter({ hasText: 'Along the widest strips' });
  expect(await flow.filter({ hasText: 'Several families' }).count()).toBe(1);
  await flow.filter({ hasNotText: 'Several families' }).locator('button.name').click();
  await expect(page.locator('[name="strategy.kind"]')).toHaveValue('flow');
  // Only the second module knows how; it plans and proves like the first.
  await plan(page);
  await expect(page.locator('.stale')).toBeHidden();
  expect(await proof(page)).toBe(true);
  await expect(figure(page, 'strategy')).toHaveText('Along the widest strips');
});

test('a planner that breaks down is told of, loses nothing, and plans again', async ({ page }) => {
  await open(page);
  const before = await figure(page, 'cut').textContent();
  // As if the module had met what it holds for impossible, in this worker alone.
  const [worker] = page.workers().filter((one) => /worker/.test(one.url()));
  await worker.evaluate(() => {
    JSON.stringify = () => {
      throw new WebAssembly.RuntimeError('unreachable');
    };
  });
  await set(page, 'tolerance.scallop_mm', 0.02);
  await plan(page);
  await expect(page.locator('.notice')).toContainText('stopped unexpectedly');
  await expect(page.locator('html[data-job=plan]')).toHaveCount(0);
  await expect(figure(page, 'cut')).toHaveText(before);
  await expect(page.locator('[name="tolerance.scallop_mm"]')).toHaveValue('0.02');
  await set(page, 'tolerance.scallop_mm', 0.08);
  await plan(page);
  await expect(page.locator('.stale')).toBeHidden();
  await expect(page.locator('.notice')).toBeHidden();
  await expect(figure(page, 'cut')).not.toHaveText(before);
});

test('a job travels with its surface, files are found again, and inches are shown', async ({
  page,
  browser,
}) => {
  const hill = ['v 0 0 0', 'v 20 0 1', 'v 20 20 2', 'v 0 20 1', 'f 1 2 3 4'].join('\n');
  await visit(page);
  await drop(page, [{ name: 'tilted.obj', base64: encoded(hill) }]);
  await page.locator('input[name="source.unit"][value=mm]').check();
  await set(page, 'tolerance.scallop_mm', 0.2);
  await expect(page.locator('.recent')).toContainText('tilted.obj');
  const job = await saved(page, 'spec');

  const context = await browser.newContext({ viewport: { width: 1440, height: 900 } });
  const other = await context.newPage();
  await visit(other);
  await drop(other, [{ name: job.name, base64: job.bytes.toString('base64') }]);
  await expect(other.locator('.file .name')).toContainText('tilted.obj');
  await expect(other.locator('[name="tolerance.scallop_mm"]')).toHaveValue('0.2');
  await plan(other);
  await expect(other.locator('[data-save=nc]')).toBeVisible();
  // It is at hand after a reload, until it is forgotten.
  await other.locator('[data-id=wave]').click();
  await expect(other.locator('.file .name')).toHaveCount(0);
  await other.locator('.recent .again').click();
  await expect(other.locator('.file .name')).toContainText('tilted.obj');
  await other.waitForTimeout(600);

  await other.locator('button[name=unit]').click();
  await other.locator('html[data-ready]').waitFor();
  const diameter = other.locator('[name="cutter.diameter_mm"]');
  await expect(other.locator('[data-field="cutter.diameter_mm"] .unit')).toHaveText('inch');
  expect(Number(await diameter.inputValue())).toBeCloseTo(8 / 25.4, 4);
  await diameter.fill('0.5');
  // What is stored stays in millimetres.
  const stored = JSON.parse((await saved(other, 'spec')).bytes.toString());
  expect(stored.cutter.diameter_mm).toBeCloseTo(12.7, 9);
  await other.locator('.recent button[aria-label*=Forget]').click();
  await expect(other.locator('.recent')).toBeHidden();
  await context.close();
});
