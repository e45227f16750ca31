/** What the browser tests share. The test runner is one of the page's packages. */
import { existsSync, mkdirSync } from 'node:fs';
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
export const figure = (page, id) => page.locator(`#results [data-figure="${id}"] dd`);

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
