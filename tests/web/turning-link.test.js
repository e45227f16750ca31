/** Links of turning jobs: those of every version open for ever, and what is no link is refused before it costs anything. */
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { checksum } from '../../www/share/checksum.js';
import { deflate, joined, letters } from '../../www/share/squeeze.js';
import { isLink, linked, opened } from '../../www/turning/link.js';

/** Made by the first page that could share turning jobs, and never made again. */
const GOLDEN = JSON.parse(readFileSync(new URL('links-turning-v1.json', import.meta.url), 'utf8'));

for (const [id, { link, held }] of Object.entries(GOLDEN)) {
  test(`the first turning links open: ${id}`, async () => {
    assert.ok(isLink(link));
    assert.deepEqual(await opened(link), held);
    assert.deepEqual(await opened(await linked(held)), held);
  });
}

/** A link around any text, as a stranger could make one. */
async function forged(bytes) {
  const squeezed = await deflate(bytes);
  const sum = checksum(squeezed);
  return `#t1.${letters(joined([Uint8Array.from([0, 8, 16, 24].map((bits) => sum >>> bits)), squeezed]))}`;
}

const refuses = (fragment, code) => assert.rejects(opened(fragment), (thrown) => thrown.code === code);

test('what is no turning link is refused', async () => {
  const { link } = GOLDEN.lens;
  await refuses(link.slice(0, -5), 'cut');
  await refuses('#t1.', 'cut');
  await refuses('#t1.<img src=x onerror=alert(1)>', 'cut');
  await refuses(link.replace('#t1.', '#t2.'), 'new');
  await refuses(`#t1.${'A'.repeat(70_000)}`, 'large');
  await refuses(await forged(new Uint8Array(40e6)), 'large');
  const text = (json) => new TextEncoder().encode(json);
  for (const json of ['', 'null', '[]', '{"surface":1}', '{"source":{"kind":"wave"}}', '{'.repeat(9000)]) {
    await refuses(await forged(text(json)), 'odd');
  }
});
