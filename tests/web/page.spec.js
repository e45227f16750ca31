/** What a person does with the page, in the order in which they do it. */
import { readFileSync } from 'node:fs';
import { data, drop, expect, figure, number, proof, set, test, visit } from './harness.js';

/** @param {string} name */
const file = (name) => ({ name, base64: readFileSync(data(name)).toString('base64') });
const plan = (page) => page.locator('button[name=plan]');

/** Notes from now on what stands on the progress bar whenever anything about it changes. */
const watchProgress = (page) =>
  page.evaluate(() => {
    window.seen = [];
    new MutationObserver(() => {
      const share = document.querySelector('progress').value;
      const phase = document.querySelector('.phase').textContent;
      window.seen.push({ share, phase, isBusy: !document.querySelector('.busy').hidden });
    }).observe(document.querySelector('#action'), { subtree: true, childList: true, attributes: true });
  });

test('first visit shows a planned and proven path without a click', async ({ page }) => {
  test.setTimeout(240_000);
  await visit(page);
  expect(number(await figure(page, 'cut').textContent())).toBeGreaterThan(100);
  expect(number(await figure(page, 'passes').textContent())).toBeGreaterThan(3);
  expect(await proof(page)).toBe(true);
  await expect(page.locator('.gallery [aria-pressed=true]')).toHaveCount(1);
  // Something is drawn: the canvas is not of one colour.
  const colours = await page.locator('#canvas canvas').evaluate(async (canvas) => {
    const copy = document.createElement('canvas');
    [copy.width, copy.height] = [64, 64];
    const context = copy.getContext('2d');
    // The picture is there only in the frame in which it was drawn.
    const drawn = new Promise((resolve) => {
      requestAnimationFrame(() => requestAnimationFrame(resolve));
    });
    canvas.dispatchEvent(new KeyboardEvent('keydown', { key: '+' }));
    await new Promise((resolve) => requestAnimationFrame(resolve));
    context.drawImage(canvas, 0, 0, 64, 64);
    await drawn;
    return new Set(new Uint32Array(context.getImageData(0, 0, 64, 64).data.buffer)).size;
  });
  expect(colours).toBeGreaterThan(20);
});

test('every surface of the gallery is planned and proven within its tolerance', async ({ page }) => {
  test.setTimeout(600_000);
  await visit(page);
  const cards = page.locator('.gallery button');
  expect(await cards.count()).toBeGreaterThanOrEqual(3);
  // The first is planned by itself, which another test looks at.
  for (const card of (await cards.all()).slice(1)) {
    await card.click();
    await expect(card).toHaveAttribute('aria-pressed', 'true');
    await expect(page.locator('[data-save=apt]')).toBeVisible();
    expect.soft(await proof(page), await card.textContent()).toBe(true);
  }
});

/** Real files, with the cutter that somebody would take for them and a finish that a small machine proves in a minute. */
const FILES = [
  {
    name: 'bladex_lower.iges',
    side: 'Back',
    settings: [
      ['cutter.corner_radius_mm', 1.5],
      ['cutter.diameter_mm', 6],
      ['strategy.lead_deg', 15],
      ['tolerance.scallop_mm', 0.08],
      ['verify.spacing_mm', 0.4],
    ],
  },
  {
    name: 'mt_bruno_elevation.csv',
    unit: 'mm',
    settings: [
      ['cutter.kind', 'ball'],
      ['cutter.diameter_mm', 4],
      ['strategy.kind', 'iso_planar'],
      ['strategy.lead_deg', 20],
      ['tolerance.scallop_mm', 0.05],
    ],
  },
  {
    name: 'terrain_small.stl',
    unit: 'mm',
    settings: [
      ['cutter.kind', 'ball'],
      ['cutter.diameter_mm', 6],
      ['tolerance.scallop_mm', 0.2],
      // Most of this mesh lies under its top, where samples cost time and prove nothing.
      ['verify.spacing_mm', 2],
    ],
  },
];

for (const { name, side, unit, settings } of FILES) {
  test(`${name}: dropped, planned with progress, proven, saved`, async ({ page }) => {
    test.setTimeout(600_000);
    await visit(page);
    await drop(page, [file(name)]);
    await expect(page.locator('.file .name')).toContainText(name);
    if (side) {
      await page.locator('button[name=flip]').click();
      await expect(page.locator('.side')).toContainText(side);
    }
    for (const [path, value] of settings) await set(page, path, value);
    if (unit) {
      await plan(page).click();
      await expect(page.locator('.notice')).toBeVisible();
      await expect(page.locator('input[name="source.unit"]').first()).toBeFocused();
      await page.locator(`input[name="source.unit"][value=${unit}]`).check();
    }
    await watchProgress(page);
    await plan(page).click();
    await expect(page.locator('[data-save=apt]')).toBeVisible({ timeout: 300_000 });
    await proof(page);
    const seen = await page.evaluate(() => window.seen);
    const shares = seen.filter(({ isBusy }) => isBusy).map(({ share }) => share);
    expect(shares.length).toBeGreaterThan(2);
    expect(shares[0]).toBe(0);
    expect(shares).toEqual([...shares].sort((a, b) => a - b));
    // Whoever waits is told for what, from the first moment.
    expect(seen.filter(({ isBusy, phase }) => isBusy && phase === '')).toEqual([]);

    const read = async (id) => number(await figure(page, id).textContent());
    expect(await read('cut')).toBeGreaterThan(1000);
    expect(await read('passes')).toBeGreaterThan(50);
    expect(await read('samples')).toBeGreaterThan(10_000);
    expect(await read('unreachable')).toBeGreaterThanOrEqual(0);
    expect(await read('unreachable')).toBeLessThan(await read('area'));
    const [, scallop] = settings.find(([path]) => path === 'tolerance.scallop_mm');
    const micrometres = 1000 * scallop + (await read('error'));
    expect.soft(await read('excess'), 'largest excess').toBeLessThanOrEqual(micrometres);
    expect.soft(await read('gouge'), 'largest gouge').toBeGreaterThanOrEqual(-1);
    await expect.soft(page.locator('[data-figure=uncut]')).toHaveCount(0);

    const [download] = await Promise.all([
      page.waitForEvent('download'),
      page.locator('[data-save=apt]').click(),
    ]);
    expect(download.suggestedFilename()).toBe(name.replace(/\.\w+$/, '.apt'));
    const text = readFileSync(await download.path(), 'utf8');
    expect(text.includes('GOTO/')).toBe(true);
    expect(text.trimEnd().endsWith('FINI')).toBe(true);
  });
}

test('cancel answers at once and keeps what was there', async ({ page }) => {
  await visit(page);
  const before = await figure(page, 'cut').textContent();
  // So fine that planning takes seconds.
  await page.locator('input[name="tolerance.scallop_mm"]').fill('0.002');
  await plan(page).click();
  await expect(page.locator('html[data-job=plan]')).toHaveCount(1);
  const waited = await page.locator('button[name=cancel]').evaluate(async (button) => {
    const start = performance.now();
    button.click();
    while (document.documentElement.dataset.job) await new Promise((resolve) => setTimeout(resolve, 1));
    return performance.now() - start;
  });
  expect(waited).toBeLessThan(200);
  await expect(figure(page, 'cut')).toHaveText(before);
  // And it can plan again.
  await page.locator('input[name="tolerance.scallop_mm"]').fill('0.2');
  await plan(page).click();
  await expect(figure(page, 'cut')).not.toHaveText(before);
});

test('a bad file says what is wrong and leaves what was loaded', async ({ page }) => {
  await visit(page);
  const before = await figure(page, 'cut').textContent();
  await drop(page, [{ name: 'broken.stl', base64: btoa('solid nothing\nendsolid\n') }]);
  const notice = page.locator('.notice');
  await expect(notice).toBeVisible();
  expect((await notice.locator('p').textContent()).length).toBeGreaterThan(10);
  await expect(figure(page, 'cut')).toHaveText(before);
  await expect(page.locator('.gallery [aria-pressed=true]')).toHaveCount(1);
  await notice.getByRole('button').click();
  await expect(notice).toBeHidden();
});

test('a file of every format opens, and what is not read names what is', async ({ page }) => {
  await visit(page);
  for (const name of [
    'tigl_D150_wing.igs',
    'featuretype.STL',
    'canonical_face_model.obj',
    'geomdl_ex_surface01.cpt',
    'curvo_union.json',
    'mt_bruno_elevation.csv',
  ]) {
    await drop(page, [file(name)]);
    await expect(page.locator('.file .name')).toContainText(name);
    await expect(page.locator('.notice')).toBeHidden();
  }
  const notice = page.locator('.notice');
  for (const [name, instead] of [
    ['tigl_face.stp', 'IGES'],
    ['wavy_mesh_with_hole.ply', 'STL or OBJ'],
  ]) {
    await drop(page, [file(name)]);
    await expect(notice).toContainText(instead);
    await expect(page.locator('.file .name')).toContainText('mt_bruno_elevation.csv');
    await notice.getByRole('button').click();
  }
});

test('a wrong value is told at its field, by the form and by the planner', async ({ page }) => {
  await visit(page);
  const diameter = page.locator('[data-field="cutter.diameter_mm"]');
  await diameter.locator('input').fill('0');
  await expect(diameter.locator('.message')).toContainText('At least');
  await plan(page).click();
  await expect(diameter.locator('input')).toBeFocused();
  await diameter.locator('input').fill('10');
  await expect(diameter.locator('.message')).toHaveText('');
  // Only the planner knows that this corner does not fit this diameter.
  const corner = page.locator('[data-field="cutter.corner_radius_mm"]');
  await corner.locator('input').fill('7');
  await plan(page).click();
  await expect(corner.locator('.message')).toContainText('5');
  await expect(corner.locator('input')).toBeFocused();
  await expect(corner.locator('input')).toHaveAttribute('aria-invalid', 'true');
});

test('edits are undone and redone', async ({ page }) => {
  await visit(page);
  const scallop = page.locator('input[name="tolerance.scallop_mm"]');
  const before = await scallop.inputValue();
  await scallop.fill('0.03');
  await expect(page.locator('.stale')).toBeVisible();
  await page.locator('button[name=undo]').click();
  await expect(scallop).toHaveValue(before);
  await expect(page.locator('.stale')).toBeHidden();
  await page.keyboard.press('Control+Shift+Z');
  await expect(scallop).toHaveValue('0.03');
});

test('the side is flipped, and a saved job opens again', async ({ page }) => {
  await visit(page);
  await page.locator('button[name=flip]').click();
  await expect(page.locator('.side')).toContainText('Back');
  await page.locator('input[name="tolerance.scallop_mm"]').fill('0.03');
  const [download] = await Promise.all([
    page.waitForEvent('download'),
    page.locator('[data-save=spec]').click(),
  ]);
  const base64 = readFileSync(await download.path()).toString('base64');
  await page.locator('.gallery button').nth(1).click();
  await expect(page.locator('.side')).toContainText('Front');
  await drop(page, [{ name: 'saved.job.json', base64 }]);
  await expect(page.locator('.side')).toContainText('Back');
  await expect(page.locator('input[name="tolerance.scallop_mm"]')).toHaveValue('0.03');
});

test('everything is reached by the keyboard', async ({ page }) => {
  await visit(page);
  const reached = new Set();
  for (let i = 0; i < 140; i += 1) {
    await page.keyboard.press('Tab');
    const name = await page.evaluate(() => {
      const { activeElement: e } = document;
      const outlined = getComputedStyle(e).outlineStyle !== 'none';
      const d = e.dataset;
      return `${e.name || d.id || d.layer || d.save || e.localName}${outlined ? '' : ' unseen'}`;
    });
    reached.add(name);
  }
  for (const name of [
    'flip',
    'open',
    'canvas',
    'at',
    'play',
    'passes',
    'view-fit',
    'apt',
    'cutter.diameter_mm',
  ]) {
    expect([...reached]).toContain(name);
  }

  // A whole job without a pointer: settings, plan, look, undo, save, and the sheet that tells how.
  const scallop = page.locator('[name="tolerance.scallop_mm"]');
  await scallop.focus();
  await page.keyboard.press('Control+A');
  await page.keyboard.type('0.08');
  await page.keyboard.press('Control+Enter');
  await expect(page.locator('html')).toHaveAttribute('data-job', 'plan');
  await expect(page.locator('html')).not.toHaveAttribute('data-job', 'plan');
  await page.locator('#canvas canvas').focus();
  for (const key of ['ArrowLeft', '+', '1', ',', 'u', 'u', 'o']) await page.keyboard.press(key);
  await expect(page.locator('button[name=parallel]')).toHaveAttribute('aria-pressed', 'true');
  await expect(page.locator('input[name=at]')).not.toHaveValue('10000');
  const [download] = await Promise.all([page.waitForEvent('download'), page.keyboard.press('Control+S')]);
  expect(download.suggestedFilename()).toMatch(/job\.json$/);
  await page.keyboard.press('Control+Z');
  await expect(scallop).toHaveValue('0.05');
  await page.keyboard.press('?');
  await expect(page.locator('dialog.keys')).toBeVisible();
  await page.keyboard.press('Escape');
  await expect(page.locator('dialog.keys')).toBeHidden();
});

test('a start curve is picked on the surface, and what is written is its text', async ({ page }) => {
  await visit(page);
  await set(page, 'strategy.kind', 'constant_scallop');
  await set(page, 'strategy.start', 'curve');
  const field = page.locator('[data-field="strategy.start_points_mm"]');
  const area = field.locator('textarea');
  await plan(page).click();
  await expect(field.locator('.message')).toContainText('At least two points');
  await field.locator('button[name=pick]').click();
  await expect(field.locator('button[name=pick]')).toHaveAttribute('aria-pressed', 'true');
  // The surface lies in the middle of the picture.
  const box = await page.locator('#canvas canvas').boundingBox();
  for (const aside of [-60, 60]) {
    await page.mouse.click(box.x + box.width / 2 + aside, box.y + box.height / 2);
  }
  await expect(area).toHaveValue(/^-?[\d.]+(, -?[\d.]+){2}\n-?[\d.]+(, -?[\d.]+){2}$/);
  await expect(field.locator('.message')).toHaveText('');
  await plan(page).click();
  await expect(page.locator('.stale')).toBeHidden({ timeout: 60_000 });
  expect(number(await figure(page, 'passes').textContent())).toBeGreaterThan(10);
  await area.fill('1, 2');
  await expect(field.locator('.message')).toContainText('each of three numbers');
});
