/** The turning planner's sentences in Chinese: none is left as it is. */
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { said } from '../../www/text/turning-said-zh.js';
import init, * as planner from '../../www/wasm/turning.js';

await init({
  module_or_path: readFileSync(new URL('../../www/wasm/turning_bg.wasm', import.meta.url)),
});

const insert = (more) => ({ tool: { kind: 'insert', ...more } });

/** Jobs that are refused. */
const WRONG = [
  { aperture: { radius_mm: 45 } },
  { surface: { kind: 'conic', conic: 3 }, aperture: { radius_mm: 60 } },
  { surface: { kind: 'biconic' }, aperture: { radius_mm: 45 } },
  { surface: { kind: 'grid', columns: 5, heights_mm: Array(25).fill(0) } },
  { surface: { kind: 'grid', columns: 7, heights_mm: [1, 2] } },
  { surface: { kind: 'sphere', shape: 'concave', radius_mm: 14 }, aperture: { radius_mm: 10 } },
  insert({ sweep_deg: 20 }),
  insert({ clearance_deg: 7 }),
  insert({ least_rake_deg: 0 }),
  { points: { angle_deg: 10 } },
  { points: { kind: 'arc', arc_mm: 9 } },
  { speed: { rate: 'given', c_rpm: 90 } },
  { speed: { rate: 'given', c_rpm: 400 } },
  { speed: { least_rpm: 200 } },
  { guide: { step_mm: 1e-5 } },
  { guide: { step: 'chosen' } },
  { surface: { kind: 'toric', rotation_radius_mm: -50 } },
  { surface: { kind: 'biconic', radius_x_mm: 0 } },
  { surface: { kind: 'zernike', terms: [[3, 2, 1.0]] } },
  { surface: { kind: 'polynomial', terms: [[30, 2, 1.0]] } },
];

const english = (text) => (text.match(/[A-Za-z]{4,}/g) ?? []).filter((word) => word !== 'Fanuc');

test('what is refused is said in Chinese', () => {
  for (const job of WRONG) {
    let message = '';
    try {
      planner.turning_plan(JSON.stringify(job), undefined, () => {});
    } catch (thrown) {
      message = JSON.parse(thrown).message;
    }
    assert.notEqual(message, '', JSON.stringify(job));
    assert.deepEqual(english(said(message)), [], message);
  }
});

test('and so is what does not fit a lathe', () => {
  const text = readFileSync(new URL('../../examples/machines/lathe_xzc.json', import.meta.url), 'utf8');
  const job = planner.turning_lathe('{}', text);
  assert.equal(JSON.parse(job).limits.c_deg_per_s3, 1e6);
  const planned = planner.turning_plan(job, undefined, () => {});
  planned.fits(text);
  for (const wrong of [
    text.replace('"limits_mm": [-100, 100]', '"limits_mm": [-1, 1]'),
    text.replace('"letter": "C"', '"letter": "B"'),
    text.replace(/\{\s*"kind": "rotary".*?\},/s, ''),
  ]) {
    assert.throws(
      () => planned.fits(wrong),
      (thrown) => {
        const { field, message } = JSON.parse(thrown);
        const told = said(`${field}: ${message.replace(`${field}: `, '')}`);
        assert.deepEqual(english(told), [], told);
        return true;
      },
    );
  }
});

test('and so is what is warned of', () => {
  const job = {
    ...insert({ rake_deg: -10, clearance_deg: 22 }),
    guide: { step_mm: 1 },
    output: { dialect: 'fanuc', decimals_mm: 3 },
    tolerance: { chord_mm: 0.0004 },
    points: { spacing: 'chosen' },
  };
  const planned = planner.turning_plan(JSON.stringify(job), undefined, () => {});
  const { warnings } = JSON.parse(planned.report());
  assert.ok(warnings.length >= 4, warnings.join('\n'));
  for (const warning of warnings)
    assert.deepEqual(english(said(warning.replace(/^[\w.]+: /, ''))), [], warning);
});
