/** Programs for machines: the module that is loaded when asked for, the program, its proof, its axes, and what is wrong with a machine. */
import { readFileSync } from 'node:fs';
import { data, expect, number, picture, set, test, visit } from './harness.js';

const machineFile = (name) => data(`../../examples/machines/${name}.json`);
const playhead = (page) => page.locator('[name=at]').inputValue().then(Number);

/** Opens machines, and waits until one can be chosen. */
async function open(page) {
  await page.locator('button[name=machine]').click();
  await expect(page.locator('button[name=machine-write]')).toBeEnabled();
}

async function write(page) {
  await page.locator('button[name=machine-write]').click();
  await expect(page.locator('.machine-verdict.good, .machine-verdict.bad')).toBeVisible({ timeout: 100_000 });
  await expect(page.locator('[data-machine-figure=change]')).toBeVisible();
}

const figure = (page, id) => page.locator(`[data-machine-figure="${id}"] dd`);

test('a program is written, proven, played and saved', async ({ page }) => {
  const modules = [];
  page.on('request', (request) => request.url().includes('.wasm') && modules.push(request.url()));
  await visit(page);
  expect(modules.some((url) => url.includes('machines'))).toBe(false);
  await open(page);
  expect(modules.some((url) => url.includes('machines_bg'))).toBe(true);
  await page.locator('[name="machine.file"]').selectOption('head_table_bc');
  await page.locator('[name="program.dialect"]').selectOption('fanuc_tip');
  // The machines' module proves what the page's second one planned.
  await set(page, 'strategy.kind', 'constant_scallop');
  await page.locator('button[name=plan]').click();
  await expect(page.locator('.stale').first()).toBeHidden({ timeout: 60_000 });
  await write(page);

  await expect(page.locator('.machine-verdict.good')).toBeVisible();
  expect(number(await figure(page, 'back').textContent())).toBeLessThan(1);
  expect(number(await figure(page, 'axis').textContent())).toBeLessThan(0.001);
  expect(number(await figure(page, 'change').textContent())).toBeLessThan(2);
  const letters = page.locator('.machine-plots figure');
  await expect(letters).toHaveCount(5);
  for (const letter of ['X', 'Y', 'Z', 'B', 'C']) {
    const line = await page.locator(`[data-axis=${letter}] .line`).getAttribute('d');
    expect(line.length).toBeGreaterThan(500);
  }
  await expect(page.locator('[data-axis=B] .bounds')).toContainText('limits');

  // The machine stands elsewhere once the playhead does.
  const drawing = page.locator('#machine-drawing canvas');
  const look = () => drawing.evaluate((canvas) => canvas.toDataURL());
  const before = await look();
  await page.locator('[data-axis=X] svg').click({ position: { x: 90, y: 20 } });
  await expect.poll(() => playhead(page)).toBeLessThan(5000);
  await expect.poll(look).not.toBe(before);
  const shown = () => page.locator('[data-axis=X] output').textContent();
  const at = await shown();
  await page.locator('button[name=on]').click();
  await expect.poll(shown).not.toBe(at);
  const note = page.locator('.note').first();
  if (await note.count()) {
    const place = await playhead(page);
    await note.click();
    await expect.poll(() => playhead(page)).not.toBe(place);
  }
  await picture(page, 'machine');

  const waiting = page.waitForEvent('download');
  await page.locator('[data-machine-save=program]').click();
  const text = readFileSync(await (await waiting).path(), 'utf8');
  expect(text).toContain('G43.4 H1');
  expect(text).toContain('Tilting head B');
  expect(text.trimEnd().endsWith('%')).toBe(true);
});

test('what a machine cannot do is said with its axis, and leads to the place', async ({ page }) => {
  await visit(page);
  await open(page);
  await page.locator('[name="machine.file"]').selectOption('three_axis');
  await page.locator('button[name=machine-write]').click();
  await expect(page.locator('.machine-problem')).toContainText('a machine without rotary axes cannot do');
  await page.locator('[name="machine-place"]').click();
  await expect.poll(() => playhead(page)).toBeLessThan(9999);

  const text = readFileSync(machineFile('table_table_ac'), 'utf8');
  const own = (change) => ({
    name: 'own.json',
    mimeType: 'application/json',
    buffer: Buffer.from(change(text)),
  });
  const input = page.locator('[name=machine-own]');
  await input.setInputFiles(own((t) => t.replace('"limits_deg": [-120, 30]', '"limits_deg": [30, -120]')));
  await expect(page.locator('.machine-problem')).toContainText('own.json: ');
  await expect(page.locator('.machine-problem')).toContainText('least position and then the greatest');
  // One that only tilts by a degree: the path leaves its limits, and the axis is named.
  await input.setInputFiles(own((t) => t.replace('"limits_deg": [-120, 30]', '"limits_deg": [-1, 1]')));
  await expect(page.locator('[name="machine.file"]')).toHaveValue('own');
  await page.locator('button[name=machine-write]').click();
  await expect(page.locator('.machine-problem')).toContainText('A would go to');
  await expect(page.locator('[data-machine-save=program]')).toBeHidden();
  // What was opened is still there after a reload.
  await page.reload();
  await page.locator('html[data-ready]').waitFor();
  await open(page);
  await expect(page.locator('[name="machine.file"]')).toHaveValue('own');
});

test('settings are checked, cancelling leaves a page that works, and it speaks Chinese', async ({ page }) => {
  await page.addInitScript(() => localStorage.setItem('language', 'zh'));
  await visit(page);
  await open(page);
  await expect(page.locator('button[name=machine-write]')).toHaveText('生成程序');
  await page.locator('#machine-panel summary').click();
  const chord = page.locator('[name="following.chord_mm"]');
  await chord.fill('7');
  await expect(page.locator('[data-field="following.chord_mm"] .message')).toContainText('1 mm');
  await page.locator('button[name=machine-write]').click();
  await expect(chord).toBeFocused();
  await chord.fill('0.0001');
  await page.locator('[name="cutting.speeds"]').selectOption('material');
  await page.locator('[name="cutting.material"]').selectOption('titanium');
  await page.locator('button[name=machine-write]').click();
  await page.locator('button[name=machine-cancel]').click();
  await expect(page.locator('button[name=machine-write]')).toBeVisible();
  await write(page);
  await expect(figure(page, 'spindle')).toContainText('rpm');
  expect(number(await figure(page, 'change').textContent())).toBeLessThan(1);
});
