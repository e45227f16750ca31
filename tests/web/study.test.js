/** The second module by itself: the same bytes as the command line, and what it tells of a surface. */
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import init, * as planner from '../../www/wasm/study.js';

const wasm = new URL('../../www/wasm/study_bg.wasm', import.meta.url);
await init({ module_or_path: readFileSync(wasm) });

const command = process.env.STEPOVER ?? 'target/debug/stepover';

/** A small rod, bent along u by 30 mm and straight along v. */
const ROD = {
  name: 'Rod',
  source: { kind: 'cylinder', radius_mm: 30, angle_deg: 30, length_mm: 14 },
  cutter: { kind: 'bull_nose', diameter_mm: 10, corner_radius_mm: 2, height_mm: 30 },
  strategy: { kind: 'flow', lead_deg: 6 },
  tolerance: { scallop_mm: 0.05, chord_mm: 0.005 },
  verify: { spacing_mm: 1 },
};
const text = JSON.stringify(ROD);
const quiet = () => {};

test('along the widest strips: the same bytes as the command line', () => {
  const outcome = planner.plan(text, undefined, quiet);
  const folder = mkdtempSync(join(tmpdir(), 'stepover-'));
  writeFileSync(join(folder, 'job.json'), text);
  execFileSync(command, ['plan', join(folder, 'job.json'), '--out', folder], { stdio: 'pipe' });
  assert.equal(outcome.apt(), readFileSync(join(folder, 'path.apt'), 'utf8'));
  outcome.free();
});

test('what is cut when ends as what the proof finds', () => {
  const outcome = planner.plan(text, undefined, quiet);
  outcome.prove(quiet);
  const proven = outcome.picture().excess();
  const removed = planner.study_removed(text, undefined, outcome.apt(), quiet);
  const [steps, vertices, excess] = [removed.steps(), removed.vertices(), removed.excess()];
  const left = new Float32Array(proven.length).fill(NaN);
  steps.forEach((step, k) => {
    assert.ok(k === 0 || step >= steps[k - 1]);
    left[vertices[k]] = excess[k];
  });
  const moves = outcome.path().length / 8;
  assert.ok(steps.at(-1) < moves);
  left.forEach((value, i) => {
    assert.ok(Math.abs(value - proven[i]) < 1e-6, `${i}: ${value} ${proven[i]}`);
  });
  outcome.free();
});

test('places of a surface, and none of a mesh', () => {
  const surface = planner.study_surface(text, undefined);
  const { u, v, least_curvature: least, most_curvature: most } = JSON.parse(surface.place(2, 0, 33));
  assert.ok(Math.abs(least + 1 / 30) < 1e-9 && Math.abs(most) < 1e-9, `${least} ${most}`);
  const [u0, u1, v0, v1] = surface.domain();
  assert.ok(u > u0 && u < u1 && v > v0 && v < v1);
  // On a rod the widest strip runs around it.
  const potential = surface.potential(5, quiet);
  for (let i = 0; i < potential.length; i += 6) {
    const [, , along, across, widest, narrowest] = potential.subarray(i, i + 6);
    assert.ok(Math.abs(along * 30) > 50 * Math.abs(across) && widest > narrowest);
  }
  const mesh = { ...ROD, source: { kind: 'file', path: 'a.obj', unit: 'mm' }, strategy: { kind: 'raster' } };
  const bytes = new TextEncoder().encode('v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n');
  assert.equal(planner.study_surface(JSON.stringify(mesh), bytes), undefined);
});

test('every contender is a whole job, and an error names the setting', () => {
  const contenders = JSON.parse(planner.study_contenders(text, undefined));
  assert.ok(contenders.length > 10);
  for (const { spec } of contenders) assert.deepEqual(spec.cutter, contenders[0].spec.cutter);
  const wrong = JSON.stringify({ ...ROD, tolerance: { scallop_mm: -1 } });
  assert.throws(
    () => planner.study_floor(wrong, undefined, quiet),
    (thrown) => JSON.parse(thrown).field === 'tolerance.scallop_mm',
  );
});
