/** What the browser tests share. The test runner is one of the page's packages. */
import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { fileURLToPath } from 'node:url';
import { expect, test } from '../../www/node_modules/@playwright/test/index.mjs';

export { expect, test };

/** @param {string} path Seen from this folder. */
const here = (path) => fileURLToPath(new URL(path, import.meta.url));

/** The path of a surface file of the corpus. @param {string} name */
export function data(name) {
  const path = here(`../data/${name}`);
  if (!existsSync(path)) throw new Error(`${path} is missing`);
  return path;
}

/** Opens the page and waits until the first surface is planned; fails on any error in the console. */
export async function visit(page) {
  const errors = [];
  page.on('pageerror', (error) => errors.push(String(error)));
  page.on('console', (message) => message.type() === 'error' && errors.push(message.text()));
  await page.goto('./');
  await page.locator('html[data-ready]').waitFor();
  expect(errors).toEqual([]);
}

/** Waits for the proof of the path on show; whether it is good. */
export async function proof(page) {
  const verdict = page.locator('.verdict');
  await verdict.waitFor({ timeout: 200_000 });
  return /good/.test(await verdict.getAttribute('class'));
}

/** Drops files on the page, as a person would: on whatever is in its middle. */
export async function drop(page, files) {
  const transfer = await page.evaluateHandle((list) => {
    const data = new DataTransfer();
    for (const { name, base64 } of list) {
      const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
      data.items.add(new File([bytes], name));
    }
    return data;
  }, files);
  for (const type of ['dragenter', 'dragover', 'drop']) {
    await page.locator('#stage').dispatchEvent(type, { dataTransfer: transfer });
  }
}

/** A figure of the result panel, as it is read. */
export const figure = (page, id) => page.locator(`#results [data-figure="${id}"] dd:not(.meaning)`);

/** The number in a text such as “12,345 mm”. @param {string} text */
export const number = (text) =>
  Number(
    text
      .replaceAll(',', '')
      .replace('−', '-')
      .match(/-?[\d.]+/)?.[0],
  );

/** Keeps a picture of the page for people to look at. */
export async function picture(page, name) {
  const folder = here('output');
  mkdirSync(folder, { recursive: true });
  await page.screenshot({ path: `${folder}/${name}.png` });
}

/** Chooses or types a setting, in whatever section it is. */
export async function set(page, path, value) {
  const field = page.locator(`[name="${path}"]`);
  await field.evaluate((element) => element.closest('details')?.setAttribute('open', ''));
  if (typeof value === 'string') await field.selectOption(value);
  else await field.fill(String(value));
}

/** The controls over the picture that lie on colours of the surface, without the part's paths; the picture is taken without any control. */
export async function controlsOverSurface(page) {
  for (const layer of ['passes', 'links', 'rapids', 'cutter', 'zones', 'side']) {
    const button = page.locator(`[data-layer="${layer}"][aria-pressed="true"]`);
    if (await button.count()) await button.evaluate((element) => element.click());
  }
  const boxes = await page.evaluate(() =>
    ['layers', 'views', 'legend', 'scrub'].map((id) => {
      const { x, y, width, height } = document.getElementById(id).getBoundingClientRect();
      return { id, x, y, width, height };
    }),
  );
  const show = (opacity) =>
    page.evaluate((value) => {
      for (const control of document.querySelectorAll('#stage > :not(#canvas), .cube'))
        control.style.opacity = value;
    }, opacity);
  await show('0');
  await page.waitForTimeout(500);
  const shot = (await page.screenshot({ scale: 'css' })).toString('base64');
  await show('');
  return page.evaluate(
    async ([base64, boxes]) => {
      const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
      const image = await createImageBitmap(new Blob([bytes]));
      const context = new OffscreenCanvas(image.width, image.height).getContext('2d');
      context.drawImage(image, 0, 0);
      /** Ground and grid are grey. */
      const colored = ({ x, y, width, height }) => {
        const { data } = context.getImageData(x, y, width, height);
        let count = 0;
        for (let i = 0; i < data.length; i += 4) {
          const pixel = data.subarray(i, i + 3);
          if (Math.max(...pixel) - Math.min(...pixel) > 40) count += 1;
        }
        return count;
      };
      const stage = document.getElementById('stage').getBoundingClientRect();
      return {
        all: colored(stage),
        covered: boxes.filter((box) => box.width && colored(box) > 20).map(({ id }) => id),
      };
    },
    [shot, boxes],
  );
}

const AXE = here('../../www/node_modules/axe-core/axe.min.js');

/** What axe-core finds serious or critical on the page as it stands. */
export async function seriousFindings(page) {
  if (!(await page.evaluate(() => 'axe' in window))) await page.evaluate(readFileSync(AXE, 'utf8'));
  return page.evaluate(async () => {
    const { violations } = await window.axe.run();
    const serious = violations.filter(({ impact }) => impact === 'serious' || impact === 'critical');
    return serious.map(({ id, nodes }) => `${id}: ${nodes.map(({ target }) => target).join(', ')}`);
  });
}

/** Width of the stored pictures: small enough that fonts of another machine do not matter, large enough for what moved or broke. */
const THUMB = 96;
/** How far a picture may be off on average, and any ninth of it, of 255. */
const OFF = { whole: 5, ninth: 14 };

/**
 * Compares what is seen with a stored picture that people looked at; keeps the new one with `UPDATE_LOOKS=1`.
 *
 * @param {import('../../www/node_modules/@playwright/test').Page} page
 * @param {string} name
 */
export async function expectToLookAs(page, name) {
  const path = here(`looks/${name}.png`);
  const shot = (await page.screenshot()).toString('base64');
  const isKept = Boolean(process.env.UPDATE_LOOKS);
  if (!isKept && !existsSync(path))
    throw new Error(`${path} is missing: look at the page, then keep it with UPDATE_LOOKS=1`);
  const kept = isKept ? null : readFileSync(path).toString('base64');
  const found = await page.evaluate(
    async ([now, before, width]) => {
      const bitmap = (base64) =>
        createImageBitmap(new Blob([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))]));
      const image = await bitmap(now);
      const height = Math.round((width * image.height) / image.width);
      const canvas = new OffscreenCanvas(width, height);
      const context = canvas.getContext('2d', { willReadFrequently: true });
      context.imageSmoothingQuality = 'high';
      context.drawImage(image, 0, 0, width, height);
      const seen = context.getImageData(0, 0, width, height).data;
      if (!before) {
        const bytes = new Uint8Array(await (await canvas.convertToBlob()).arrayBuffer());
        return { base64: btoa(String.fromCharCode(...bytes)) };
      }
      const old = await bitmap(before);
      if (old.width !== width || old.height !== height) return { whole: 255, ninth: 255 };
      context.drawImage(old, 0, 0);
      const stored = context.getImageData(0, 0, width, height).data;
      const sums = Array.from({ length: 9 }, () => [0, 0]);
      for (let i = 0; i < seen.length; i += 1) {
        if (i % 4 === 3) continue;
        const [x, y] = [(i >> 2) % width, Math.floor((i >> 2) / width)];
        const part = sums[3 * Math.floor((3 * y) / height) + Math.floor((3 * x) / width)];
        part[0] += Math.abs(seen[i] - stored[i]);
        part[1] += 1;
      }
      const ninths = sums.map(([sum, count]) => sum / count);
      return { whole: ninths.reduce((a, b) => a + b, 0) / 9, ninth: Math.max(...ninths) };
    },
    [shot, kept, THUMB],
  );
  if (isKept) {
    mkdirSync(here('looks'), { recursive: true });
    writeFileSync(path, Buffer.from(found.base64, 'base64'));
    return;
  }
  expect.soft(found.whole, `${name} as a whole`).toBeLessThan(OFF.whole);
  expect.soft(found.ninth, `a part of ${name}`).toBeLessThan(OFF.ninth);
}
