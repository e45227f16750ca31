/** The lessons: figures that are computed, moved by the keyboard and by a pointer, told to who does not see them, in both languages. */
import { expect, expectToLookAs, number, picture, seriousFindings, test } from './harness.js';

const figure = (page, id) => page.locator(`figure[data-figure=${id}]`);

/** Waits until a figure is drawn, as a reader who comes to it does. */
async function drawn(page, id) {
  await figure(page, id).scrollIntoViewIfNeeded();
  await figure(page, id).and(page.locator('[data-drawn]')).waitFor({ timeout: 90_000 });
  return figure(page, id);
}

/** The numbers of a row of a figure's table. */
async function row(shown, name) {
  const cells = await shown.locator(`tbody tr:has(th:text-is("${name}")) td`).allTextContents();
  return cells.map(number);
}

test('every lesson is computed, has a text and a table, and opens its case in the planner', async ({
  page,
}) => {
  test.setTimeout(240_000);
  const errors = [];
  page.on('pageerror', (error) => errors.push(String(error)));
  page.on('console', (message) => message.type() === 'error' && errors.push(message.text()));
  await page.goto('./learn.html');
  await page.locator('html[data-ready]').waitFor();
  for (const id of ['tilt', 'strip', 'stepover', 'schur', 'restarts', 'families', 'turning']) {
    const shown = await drawn(page, id);
    const alt = await shown.locator('> svg').getAttribute('aria-label');
    expect(alt?.length, id).toBeGreaterThan(60);
    await shown.locator('summary').click();
    expect(await shown.locator('tbody tr').count(), id).toBeGreaterThan(2);
    await expect(page.locator(`article#${id} a.open`)).toHaveAttribute(
      'href',
      /index\.html#1\.|turning\.html/,
    );
  }
  // Equations are there with their numbers in the papers.
  expect(await page.locator('math').count()).toBeGreaterThan(12);
  await expect(page.locator('#strip .number').first()).toHaveText('[1] (8)');

  // 10/tan: the effective radius at 30°, R1 = 3, r = 2 is 8 mm.
  const tilt = figure(page, 'tilt');
  await tilt.locator('input[name="tilt.lead"]').fill('30');
  await expect(tilt.locator('figcaption')).toContainText('8.00 mm');
  // On a plane, R1 = 3, r = 2: the exact stepover stays below the circle's.
  const [exact, circle] = await row(figure(page, 'stepover'), '15°');
  expect(circle).toBeGreaterThan(exact);
  // A blade's torsion: yaw matters, and the Schur complement follows.
  const widths = await row(figure(page, 'schur'), '-20°');
  expect(widths[0]).toBeCloseTo(3.47, 1);
  expect(Math.abs(widths[1] / widths[0] - 1)).toBeLessThan(0.02);
  expect(Math.abs(widths[2] / widths[0] - 1)).toBeGreaterThan(0.25);
  // The field needs less than either parameter, and nobody less than the floor.
  const shares = await Promise.all(
    ['Along u', 'Along v', 'Along the widest strips'].map((name) => row(figure(page, 'families'), name)),
  );
  for (const [, share, , , excess] of shares) {
    expect(share).toBeGreaterThan(1);
    expect(excess).toBeLessThan(21);
  }
  expect(shares[2][0]).toBeLessThan(0.9 * Math.min(shares[0][0], shares[1][0]));

  // The band of tolerance is dragged.
  const strip = figure(page, 'strip');
  const before = await strip.locator('figcaption').textContent();
  await strip.scrollIntoViewIfNeeded();
  const box = await strip.locator('> svg').boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height * 0.75);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height * 0.35, { steps: 4 });
  await page.mouse.up();
  await expect(strip.locator('figcaption')).not.toHaveText(before);
  await picture(page, 'learn-strip');

  expect(await seriousFindings(page)).toEqual([]);
  expect(errors).toEqual([]);
  // The case opens as a job of its own.
  await page.locator('article#tilt a.open').click();
  await page.locator('html[data-ready]').waitFor();
  await expect(page.locator('[name="cutter.diameter_mm"]')).toHaveValue('10');
  await page.locator('.verdict.good').waitFor();
});

test('the lessons stand in 中文 and fit a phone', async ({ browser }) => {
  const viewport = { width: 390, height: 844 };
  const context = await browser.newContext({ locale: 'zh-CN', viewport, hasTouch: true, isMobile: true });
  const page = await context.newPage();
  await page.goto('./learn.html');
  await expect(page.locator('#lessons h2').first()).toContainText('铣刀');
  await drawn(page, 'schur');
  await picture(page, 'learn-phone-zh');
  await page.evaluate(() => scrollTo(0, 0));
  await expectToLookAs(page, 'learn-phone-zh');
  const [inner, scroll] = await page.evaluate(() => [innerWidth, document.documentElement.scrollWidth]);
  expect(scroll).toBeLessThanOrEqual(inner);
  await context.close();
});
