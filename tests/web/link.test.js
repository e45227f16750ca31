/** Links: those of every version open for ever, and what is no link is refused before it costs anything. */
import assert from 'node:assert/strict';
import { createHash } from 'node:crypto';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { checksum } from '../../www/share/checksum.js';
import { linked, opened, WISHED } from '../../www/share/link.js';
import { createWriter } from '../../www/share/numbers.js';
import { deflate, joined, letters } from '../../www/share/squeeze.js';

/** Made by the first page that could share, and never made again. */
const GOLDEN = JSON.parse(readFileSync(new URL('links-v1.json', import.meta.url), 'utf8'));

/** What they hold: the job's digest, points of the path, and triangles of the shape. */
const HELD = JSON.parse(readFileSync(new URL('links-v1-held.json', import.meta.url), 'utf8'));

const digest = (value) => createHash('sha256').update(JSON.stringify(value)).digest('hex');

function held({ spec, name, isPreview, outcome }) {
  return {
    name,
    isPreview,
    spec: digest(spec),
    points: outcome.contacts.length / 3,
    triangles: outcome.picture.indices.length / 3,
    cut_mm: outcome.report.length.cut_mm,
    place: digest([...outcome.contacts].map((x) => Math.round(x * 1e3))),
  };
}

for (const [id, fragment] of Object.entries(GOLDEN)) {
  test(`the first links open: ${id}`, async () => {
    assert.ok(fragment.length <= WISHED);
    assert.deepEqual(held(await opened(fragment)), HELD[id]);
  });
}

test('what was opened can be shared again, and is the same', async () => {
  const first = await opened(GOLDEN.blade);
  const again = await linked({ ...first, picture: first.outcome.picture });
  const second = await opened(again.fragment);
  assert.deepEqual(second.spec, first.spec);
  assert.equal(second.outcome.report.passes, first.outcome.report.passes);
  const box = ({ contacts }) =>
    [0, 1, 2].flatMap((axis) => {
      const along = contacts.filter((_, i) => i % 3 === axis);
      return [Math.min(...along), Math.max(...along)];
    });
  const [before, after] = [box(first.outcome), box(second.outcome)];
  for (let i = 0; i < 6; i += 1) assert.ok(Math.abs(after[i] - before[i]) <= again.precision);
});

/** A link around any JSON text and preview, as a stranger could make one. */
async function forged(text, preview = new Uint8Array()) {
  const json = new TextEncoder().encode(text);
  const size = Uint8Array.from([0, 8, 16, 24].map((bits) => json.length >>> bits));
  const squeezed = await deflate(joined([size, json, preview]));
  const sum = checksum(squeezed);
  return `#1.${letters(joined([Uint8Array.from([0, 8, 16, 24].map((bits) => sum >>> bits)), squeezed]))}`;
}

const refuses = (fragment, code) => assert.rejects(opened(fragment), (thrown) => thrown.code === code);

test('letters that are missing or changed are told of', async () => {
  const { wave } = GOLDEN;
  await refuses(wave.slice(0, -20), 'cut');
  await refuses(`${wave.slice(0, 900)}${wave[900] === 'A' ? 'B' : 'A'}${wave.slice(901)}`, 'cut');
  await refuses('#1.', 'cut');
  await refuses('#1.<img src=x onerror=alert(1)>', 'cut');
  await refuses(wave.replace('#1.', '#2.'), 'new');
});

test('a link that swells is given up', async () => {
  await refuses(await forged('{}', new Uint8Array(40e6)), 'large');
  await refuses(`#1.${'A'.repeat(70_000)}`, 'large');
});

test('what is no job is refused', async () => {
  for (const text of ['', 'null', '[]', '{"spec":1}', '{"spec":{"source":{}}}', '{'.repeat(9000)]) {
    await refuses(await forged(text), 'odd');
  }
});

test('a preview of too much, or of nothing, is refused', async () => {
  const { spec, outcome } = await opened(GOLDEN.lens);
  const grid = { low: [0, 0, 0], step: 1, scale: 1 };
  const about = { spec, grid, report: outcome.report, outline: [0, 0] };
  const numbers = (...values) => {
    const writer = createWriter();
    for (const value of values) writer.count(value);
    return writer.bytes();
  };
  for (const preview of [
    numbers(2 ** 30),
    numbers(3, 0, 0),
    numbers(3, 9, 3),
    numbers(0, 3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 90),
    Uint8Array.from([255, 255, 255, 255, 255, 255]),
    numbers(5, 0, 5),
  ]) {
    await refuses(await forged(JSON.stringify(about), preview), 'odd');
  }
  const away = { ...about, grid: { ...grid, step: 'x' } };
  await refuses(await forged(JSON.stringify(away), numbers(0, 0, 0)), 'odd');
  const unsaid = { ...about, report: { ...outcome.report, passes: '<b>' } };
  await refuses(await forged(JSON.stringify(unsaid), numbers(0, 0, 0)), 'odd');
});
