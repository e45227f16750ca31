/** The turning page: the paper's lens without a click, its switches, its plots, its programs, and that nothing is lost. */
import { readFileSync } from 'node:fs';
import { drop, expect, number, picture, set, test } from './harness.js';

/** Opens the turning page and waits until its lens is planned and proven. */
async function visit(page, address = './turning.html') {
  const errors = [];
  const modules = [];
  page.on('pageerror', (error) => errors.push(String(error)));
  page.on('console', (message) => message.type() === 'error' && errors.push(message.text()));
  page.on('request', (request) => request.url().includes('.wasm') && modules.push(request.url()));
  await page.goto(address);
  await page.locator('html[data-ready]').waitFor({ timeout: 100_000 });
  expect(errors).toEqual([]);
  // The milling module is another page's.
  expect(modules.every((url) => url.includes('turning_bg'))).toBe(true);
}

const figure = (page, id) => page.locator(`#results [data-figure="${id}"] dd`);
const um = async (page, id) => number(await figure(page, id).textContent());
const settled = (page) => expect(page.locator('#action .busy')).toBeHidden({ timeout: 100_000 });
const pointsOf = async (page, plot) => {
  const points = await page.locator(`[data-plot=${plot}] polyline`).getAttribute('points');
  return points.split(' ').map((point) => point.split(',').map(Number));
};

/** How many colours the picture has. */
const colours = (page) =>
  page.locator('#picture canvas').evaluate((canvas) => {
    const { width, height } = canvas;
    const { data } = canvas.getContext('2d').getImageData(0, 0, width, height);
    return new Set(new Uint32Array(data.buffer)).size;
  });

test('the paper’s lens is planned and proven without a click', async ({ page }) => {
  await visit(page);
  expect(await um(page, 'overcut')).toBeLessThan(-4.6);
  expect(await um(page, 'overcut')).toBeGreaterThan(-4.9);
  expect(await um(page, 'residue')).toBeGreaterThan(11.5);
  await expect(figure(page, 'sagitta-0')).toContainText('of 1.0556');
  await expect(figure(page, 'sagitta-90')).toContainText('of 5.3590');
  await expect(figure(page, 'outermost')).toHaveText(/^41\.3/);
  await expect(page.locator('#picture')).toHaveAttribute('data-drawn', 'map');
  expect(await colours(page)).toBeGreaterThan(30);
  for (const id of ['position', 'velocity', 'acceleration', 'jerk', 'stroke', 'most-velocity', 'most-jerk']) {
    expect((await pointsOf(page, id)).length).toBeGreaterThan(50);
  }
  // C turns evenly on the way: its acceleration is a line.
  await page.locator('[data-axis=c]').click();
  const heights = new Set((await pointsOf(page, 'acceleration')).map(([, y]) => y));
  expect(heights.size).toBe(1);
  await page.locator('[data-axis=z]').click();
  await page.locator('[data-plot=position] svg').hover();
  await expect(page.locator('[data-plot=position] output')).toContainText(':');
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
  await page.locator('#picture canvas').hover({ position: { x: 300, y: 200 } });
  await expect(page.locator('.reading')).toContainText('µm');
  await page.locator('[name=range]').selectOption('wide');
  await expect(page.locator('.scale .numbers span').last()).toHaveText('+20');
  await expect(page.locator('.beyond')).toContainText('0 % left, 0 % cut');
  await page.locator('[name=range]').selectOption('fine');
  await expect(page.locator('.beyond')).toContainText(/0\.0\d+ % left/);
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
  await picture(page, 'turning-compare');
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
  await expect(page.locator('#action .message')).toContainText('87.5 % of its size would do');
  await set(page, 'aperture.radius_mm', 30);
  await set(page, 'points.angle_deg', 10);
  await page.locator('button[name=plan]').click();
  const message = page.locator('[data-field="points.angle_deg"] .message');
  await expect(message).toContainText('apart would do');
  await page.locator('[name="points.angle_deg"]').fill('');
  await page.locator('button[name=plan]').click();
  await expect(page.locator('[name="points.angle_deg"]')).toBeFocused();
});

test('a reload, undo and a link lose nothing', async ({ page, browser }) => {
  await visit(page);
  await set(page, 'aperture.radius_mm', 12);
  await page.locator('button[name=undo]').click();
  await expect(page.locator('[name="aperture.radius_mm"]')).toHaveValue('30');
  await page.locator('button[name=redo]').click();
  await expect(page.locator('[name="aperture.radius_mm"]')).toHaveValue('12');
  await page.waitForTimeout(600);
  await visit(page);
  await expect(page.locator('[name="aperture.radius_mm"]')).toHaveValue('12');
  await page.locator('button[name=share]').click();
  await expect(page.locator('[name=link]')).toHaveValue(/#t1\./);
  const link = await page.locator('[name=link]').inputValue();
  const context = await browser.newContext();
  const other = await context.newPage();
  await visit(other, link);
  await expect(other.locator('[name="aperture.radius_mm"]')).toHaveValue('12');
  expect(new URL(other.url()).hash).toBe('');
  // A link that lost letters leaves the work alone.
  await other.goto('about:blank');
  await other.goto(link.slice(0, -9));
  await other.locator('html[data-ready]').waitFor({ timeout: 100_000 });
  await expect(other.locator('#action .message')).toContainText('incomplete');
  await expect(other.locator('[name="aperture.radius_mm"]')).toHaveValue('12');
  await context.close();
});

test('a table of heights is dropped, turned, and saved with the job', async ({ page }) => {
  await visit(page);
  const rows = Array.from({ length: 21 }, (_, j) =>
    Array.from({ length: 21 }, (_, i) => (0.004 * ((i - 10) ** 2 - (j - 10) ** 2)).toFixed(6)).join(','),
  );
  const base64 = Buffer.from(rows.join('\n')).toString('base64');
  await drop(page, [{ name: 'saddle.csv', base64 }]);
  await settled(page);
  await expect(page.locator('[name="surface.kind"]')).toHaveValue('grid');
  await expect(page.locator('[name="aperture.radius_mm"]')).toHaveValue('10');
  expect(await um(page, 'pv')).toBeGreaterThan(0);
  const waiting = page.waitForEvent('download');
  await page.locator('[data-save=spec]').click();
  const path = await (await waiting).path();
  await page.locator('[name="surface.kind"]').selectOption('sphere');
  const job = readFileSync(path).toString('base64');
  await drop(page, [{ name: 'saddle.job.json', base64: job }]);
  await settled(page);
  await expect(page.locator('[name="surface.kind"]')).toHaveValue('grid');
  const wrong = Buffer.from('1,2\n3,x\n').toString('base64');
  await drop(page, [{ name: 'broken.csv', base64: wrong }]);
  await expect(page.locator('#action .message')).toContainText('line 2');
});

test('cancelled work can be gone on with', async ({ page }) => {
  await visit(page);
  await set(page, 'guide.step_mm', 0.01);
  await page.locator('button[name=plan]').click();
  await page.locator('button[name=cancel]').click();
  await settled(page);
  await page.locator('[name=radius]').focus();
  const before = await pointsOf(page, 'position');
  await page.locator('[name=radius]').fill('10');
  await expect.poll(async () => String(await pointsOf(page, 'position'))).not.toBe(String(before));
});

test('中文, what the planner says too, on a phone in the dark', async ({ browser }) => {
  const context = await browser.newContext({
    locale: 'zh-CN',
    viewport: { width: 390, height: 844 },
    colorScheme: 'dark',
  });
  const page = await context.newPage();
  await visit(page);
  await expect(page.locator('#action button.primary')).toContainText('规划');
  const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
  expect(wide).toBe(0);
  await picture(page, 'turning-phone');
  await set(page, 'aperture.radius_mm', 45);
  await page.locator('button[name=plan]').click();
  await expect(page.locator('#action .message')).toHaveText(/^口径在 x .+环曲面.+缩小到 87\.5 % 即可$/);
  // Nothing that a person reads is left in English, but for names.
  const words = await page.locator('body').evaluate((body) => body.innerText.match(/[A-Za-z]{4,}/g) ?? []);
  const names = ['Stepover', 'English', 'Zernike', 'LinuxCNC', 'Fanuc', 'json', 'report', 'turns'];
  expect([...new Set(words)].filter((word) => !names.includes(word))).toEqual([]);
  await context.close();
});

test('a lathe is opened from its file, kept, and what it cannot reach is said', async ({ page }) => {
  await visit(page);
  const text = readFileSync(new URL('../../examples/machines/lathe_xzc.json', import.meta.url), 'utf8');
  const file = (machine) => ({ name: 'lathe.json', base64: Buffer.from(machine).toString('base64') });
  await drop(page, [file(text)]);
  await settled(page);
  await expect(page.locator('[name="limits.x_mm_per_s2"]')).toHaveValue('1000');
  await expect(page.locator('#action .message')).toHaveText('');
  // One whose carriage hardly moves: the path leaves its travels, and the axis is named.
  const short = text.replace('"limits_mm": [-100, 100]', '"limits_mm": [-1, 1]');
  await drop(page, [file(short.replace('Lathe with', 'Short lathe with'))]);
  await expect(page.locator('#action .message')).toContainText('axes.Z.limits_mm: are -1.000 to 1.000 mm');
  await page.reload();
  await expect(page.locator('.lathe-name')).toContainText('Short lathe');
  await expect(page.locator('#action .message')).toContainText('axes.Z');
  await page.locator('[data-group=limits] summary').click();
  await picture(page, 'turning-lathe');
  await page.locator('[name=lathe-forget]').click();
  await page.locator('button[name=plan]').click();
  await expect(page.locator('#action .message')).toHaveText('');
  await drop(page, [file(text.replace('"version": 1', '"version": 9'))]);
  await expect(page.locator('#action .message')).toContainText('version');
});
