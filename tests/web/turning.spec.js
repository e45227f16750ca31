/** The turning page: the paper's lens without a click, its switches, its plots, its programs. */
import { readFileSync } from 'node:fs';
import { expect, number, picture, set, test } from './harness.js';

/** Opens the turning page and waits until the first lens is planned and proven. */
async function visit(page) {
  const errors = [];
  const modules = [];
  page.on('pageerror', (error) => errors.push(String(error)));
  page.on('console', (message) => message.type() === 'error' && errors.push(message.text()));
  page.on('request', (request) => request.url().includes('.wasm') && modules.push(request.url()));
  await page.goto('./turning.html');
  await page.locator('html[data-ready]').waitFor({ timeout: 100_000 });
  expect(errors).toEqual([]);
  // The milling module is another page's.
  expect(modules.every((url) => url.includes('turning_bg'))).toBe(true);
}

const figure = (page, id) => page.locator(`#results [data-figure="${id}"] dd`);
const um = async (page, id) => number(await figure(page, id).textContent());
const settled = (page) => expect(page.locator('#action .busy')).toBeHidden({ timeout: 100_000 });

/** How many colours the picture has. */
const colours = (page) =>
  page.locator('#picture canvas').evaluate((canvas) => {
    const { width, height } = canvas;
    const { data } = canvas.getContext('2d').getImageData(0, 0, width, height);
    return new Set(new Uint32Array(data.buffer)).size;
  });

test('the paper’s lens is planned and proven without a click', async ({ page }) => {
  await visit(page);
  expect(await um(page, 'overcut')).toBeLessThan(-4.4);
  expect(await um(page, 'overcut')).toBeGreaterThan(-5);
  expect(await um(page, 'residue')).toBeGreaterThan(10);
  await expect(figure(page, 'sagitta-0')).toContainText('of 1.0556');
  await expect(figure(page, 'sagitta-90')).toContainText('of 5.3590');
  await expect(figure(page, 'outermost')).toHaveText(/^41\.3/);
  await expect(page.locator('#picture')).toHaveAttribute('data-drawn', 'map');
  expect(await colours(page)).toBeGreaterThan(30);
  for (const id of ['z', 'velocity', 'acceleration', 'stroke', 'peak', 'jerk']) {
    const points = await page.locator(`[data-plot=${id}] polyline`).getAttribute('points');
    expect(points.split(' ').length).toBeGreaterThan(50);
  }
  await picture(page, 'turning');
});

test('the lens turns, and the tolerance bands of the paper colour it', async ({ page }) => {
  await visit(page);
  await page.locator('[data-view=lens]').click();
  await expect(page.locator('#picture')).toHaveAttribute('data-drawn', 'lens');
  const look = () => page.locator('#picture canvas').evaluate((canvas) => canvas.toDataURL());
  const before = await look();
  await page.locator('#picture canvas').focus();
  await page.keyboard.press('ArrowLeft');
  await expect.poll(look).not.toBe(before);
  await picture(page, 'turning-lens');
  await page.locator('[data-view=map]').click();
  await page.locator('[name=range]').selectOption('wide');
  await expect(page.locator('.scale .numbers span').last()).toHaveText('+20');
});

test('circles against spiral, angles against arcs', async ({ page }) => {
  test.setTimeout(200_000);
  await visit(page);
  await page.locator('[data-choose=circles]').click();
  await settled(page);
  await expect(page.locator('[data-choose=circles]')).toHaveAttribute('aria-pressed', 'true');
  await page.locator('[data-choose=arc]').click();
  await settled(page);
  await expect(page.locator('[name="points.arc_mm"]')).toBeVisible();
  await page.locator('[name=compare]').click();
  const rows = page.locator('#compare tbody tr');
  await expect(rows).toHaveCount(4, { timeout: 100_000 });
  const cell = async (row, column) =>
    number(await page.locator(`[data-row=${row}] td`).nth(column).textContent());
  // Circles jerk X from one to the next; arcs make C change its speed.
  expect(await cell('circles-angle', 1)).toBeGreaterThan(10 * (await cell('spiral-angle', 1)));
  expect(await cell('spiral-angle', 2)).toBe(0);
  expect(await cell('spiral-arc', 2)).toBeGreaterThan(1);
});

test('a step chosen for a micrometre keeps it, and the program says so', async ({ page }) => {
  test.setTimeout(200_000);
  await visit(page);
  await set(page, 'guide.step', 'chosen');
  await set(page, 'points.spacing', 'chosen');
  await set(page, 'points.interpolation', 'pvt');
  await set(page, 'tolerance.residue_mm', 0.001);
  await set(page, 'tolerance.chord_mm', 0.00001);
  await page.locator('button[name=plan]').click();
  await settled(page);
  await expect(page.locator('.verdict.good')).toBeVisible();
  expect(await um(page, 'residue')).toBeLessThan(1);
  const waiting = page.waitForEvent('download');
  await page.locator('[data-save=program]').click();
  const text = readFileSync(await (await waiting).path(), 'utf8');
  expect(text).toContain('XZC BALL R15 TIP RADIUS TOOL');
  expect(text).toContain('PVT');
});

test('what is wrong is said beside its setting', async ({ page }) => {
  await visit(page);
  await set(page, 'aperture.radius_mm', 45);
  await page.locator('button[name=plan]').click();
  await expect(page.locator('#action .message')).toContainText('reaches to |y| = 39.395');
  await set(page, 'aperture.radius_mm', 30);
  await set(page, 'points.angle_deg', 10);
  await page.locator('button[name=plan]').click();
  const message = page.locator('[data-field="points.angle_deg"] .message');
  await expect(message).toContainText('apart would do');
});
