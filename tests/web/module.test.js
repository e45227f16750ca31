/** The WebAssembly module by itself: the same bytes as the command line, and errors that name the setting. */
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { brotliCompressSync, gzipSync } from 'node:zlib';
import './link.test.js';
import './machine-text.test.js';
import './room.test.js';
import './study.test.js';
import './text.test.js';
import './turning-link.test.js';
import './turning-said.test.js';
import startMachines, * as machines from '../../www/wasm/machines.js';
import init, * as planner from '../../www/wasm/stepover.js';

const wasm = new URL('../../www/wasm/stepover_bg.wasm', import.meta.url);
await init({ module_or_path: readFileSync(wasm) });

const command = process.env.STEPOVER ?? 'target/debug/stepover';

/** What a visitor on a slow line has to wait for, bytes as hosts send them: the larger part of the 600 KB of a first visit. */
const MOST_BYTES = 368 * 1024;

test('the module is small enough to wait for', (context) => {
  const bytes = readFileSync(wasm);
  // What every host can send; brotli is smaller.
  const sent = gzipSync(bytes, { level: 9 }).length;
  const least = brotliCompressSync(bytes).length;
  context.diagnostic(`${bytes.length} bytes, ${sent} as gzip, ${least} as brotli`);
  assert.ok(sent <= MOST_BYTES);
});

/** What the command line writes for a spec, by file ending. */
function native(spec) {
  const folder = mkdtempSync(join(tmpdir(), 'stepover-'));
  writeFileSync(join(folder, 'job.json'), JSON.stringify(spec));
  const out = join(folder, 'out');
  execFileSync(command, ['plan', join(folder, 'job.json'), '--out', out], { stdio: 'pipe' });
  const ending = (name) => name.slice(name.lastIndexOf('.') + 1);
  return Object.fromEntries(
    readdirSync(out).map((name) => [ending(name), readFileSync(join(out, name), 'utf8')]),
  );
}

for (const { id, spec } of JSON.parse(planner.gallery())) {
  test(`${id}: the same bytes as the command line`, () => {
    const outcome = planner.plan(JSON.stringify(spec), undefined, () => {});
    outcome.prove(() => {});
    const files = native(spec);
    assert.equal(outcome.apt(), files.apt, 'APT');
    assert.equal(outcome.csv(), files.csv, 'CSV');
    assert.equal(outcome.nc(), files.nc, 'G-code');
    assert.equal(outcome.report(), files.json, 'report');
    outcome.free();
  });
}

test('the arrays of an outcome fit one another', () => {
  const [{ spec }] = JSON.parse(planner.gallery());
  const phases = [];
  const listen = (phase, fraction) => phases.push([phase, fraction]);
  const outcome = planner.plan(JSON.stringify(spec), undefined, listen);
  const planning = phases.splice(0);
  assert.equal(outcome.picture(), undefined);
  assert.equal(JSON.parse(outcome.report()).verified, null);
  outcome.prove(listen);
  const path = outcome.path();
  const picture = outcome.picture();
  assert.equal(path.length % 8, 0);
  assert.equal(outcome.contacts().length / 3, path.length / 8);
  assert.equal(picture.positions().length, picture.normals().length);
  assert.equal(picture.excess().length, picture.positions().length / 3);
  const vertices = picture.positions().length / 3;
  assert.ok(picture.indices().every((vertex) => vertex < vertices));
  const outline = planner.outline(JSON.stringify(spec));
  assert.ok(outline.length > 8 && outline.length % 2 === 0);
  assert.equal(outcome.unreached().centers().length % 3, 0);
  assert.equal(JSON.parse(outcome.report()).points, path.length / 8);
  for (let i = 1; i < path.length / 8; i += 1)
    assert.ok(path[8 * i + 7] >= path[8 * i - 1], `length at ${i}`);
  for (const told of [planning, phases]) {
    const fractions = told.map(([, fraction]) => fraction);
    assert.ok(fractions.length > 2);
    assert.deepEqual(
      fractions,
      [...fractions].sort((a, b) => a - b),
      'progress never falls',
    );
  }
  outcome.free();
});

test('an error names the setting', () => {
  const [{ spec }] = JSON.parse(planner.gallery());
  const wrong = { ...spec, tolerance: { ...spec.tolerance, scallop_mm: -1 } };
  assert.throws(
    () => planner.plan(JSON.stringify(wrong), undefined, () => {}),
    (thrown) => JSON.parse(thrown).field === 'tolerance.scallop_mm',
  );
});

test('what is no surface is refused in words', () => {
  for (const bytes of [new Uint8Array(), new TextEncoder().encode('hello')]) {
    assert.throws(
      () => planner.inspect('nothing.stl', bytes),
      (thrown) => JSON.parse(thrown).message.length > 10,
    );
  }
});

test('a machine’s program has the same bytes as the command line’s', async () => {
  const code = new URL('../../www/wasm/machines_bg.wasm', import.meta.url);
  await startMachines({ module_or_path: readFileSync(code) });
  const [{ spec }] = JSON.parse(planner.gallery());
  const outcome = planner.plan(JSON.stringify(spec), undefined, () => {});
  const [apt, csv] = [outcome.apt(), outcome.csv()];
  outcome.free();
  const folder = mkdtempSync(join(tmpdir(), 'stepover-'));
  const file = (name, text) => {
    writeFileSync(join(folder, name), text);
    return join(folder, name);
  };
  const { text: machine } = JSON.parse(machines.machine_shipped())[2];
  const options = { cutting: { speeds: 'material', material: 'steel' }, holding: { turn_z_deg: 30 } };
  const args = [
    ['--machine', file('machine.json', machine)],
    ['--contacts', file('path.csv', csv)],
    ['--settings', file('settings.json', JSON.stringify(options))],
    ['--dialect', 'linuxcnc', '--out', join(folder, 'path.ngc')],
    ['--read-back', join(folder, 'back.apt')],
  ].flat();
  execFileSync(command, ['post', file('path.apt', apt), ...args], { stdio: 'pipe' });
  const told = [];
  const work = machines.machine_post(apt, csv, machine, JSON.stringify(options), (_, at) => told.push(at));
  assert.equal(work.text(), readFileSync(join(folder, 'path.ngc'), 'utf8'));
  assert.equal(work.read_back(), readFileSync(join(folder, 'back.apt'), 'utf8'));
  assert.deepEqual(
    told,
    told.toSorted((a, b) => a - b),
    'progress never falls',
  );
  const kept = JSON.parse(work.prove(JSON.stringify(spec), undefined, () => {}));
  assert.ok(kept.largest_change_mm <= kept.allowed_mm, `${kept.largest_change_mm} mm`);
  const [low, high] = [0, 1].map((share) => work.at_share(share)[0]);
  assert.ok(low >= 0 && high > 10);
  assert.ok(Math.abs(work.share_at(work.at_share(0.4)[0]) - 0.4) < 1e-6);
  work.free();
});
