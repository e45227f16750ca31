/** Holds the turning planner: the only file that knows its module's functions. */
import { serve } from '../serving.js';
import init, * as planner from '../wasm/turning.js';

/** @import { Progress } from '../serving.js' */

/** Rays and places on each of the lens that is drawn. */
const LENS = [360, 56];
/** Points of the path that are drawn: more than a screen shows. */
const DRAWN = 40_000;

/** What was planned last, for its proof and its turns. @type {planner.Turned | null} */
let current = null;

/** @param {any} spec @param {Progress} progress */
function plan(spec, progress) {
  current?.free();
  current = null;
  current = planner.turning_plan(JSON.stringify(spec), undefined, progress);
  return current;
}

serve(init, {
  start: () => ({
    result: {
      schema: JSON.parse(planner.turning_schema()),
      spec: JSON.parse(planner.turning_complete('{}')),
    },
    transfer: [],
  }),

  complete: ([text]) => ({ result: JSON.parse(planner.turning_complete(text)), transfer: [] }),

  table: ([spec, bytes]) => ({
    result: JSON.parse(planner.turning_table(JSON.stringify(spec), bytes)),
    transfer: [],
  }),

  lathe: ([spec, machine]) => ({
    result: JSON.parse(planner.turning_lathe(JSON.stringify(spec), machine)),
    transfer: [],
  }),

  plan([spec, machine], progress) {
    const planned = plan(spec, progress);
    if (machine) planned.fits(machine);
    const report = planned.report();
    const [rays, rings] = LENS;
    const heights = planned.heights(rays, rings);
    const touches = planned.touches(DRAWN);
    const turns = planned.turns();
    // As blobs the texts stay out of the page's memory until somebody saves them.
    const files = {
      program: new Blob([planned.program()], { type: 'text/plain' }),
      csv: new Blob([planned.csv()], { type: 'text/csv' }),
      turns: new Blob([planned.turns_csv()], { type: 'text/csv' }),
      apt: new Blob([planned.apt()], { type: 'text/plain' }),
      report: new Blob([report], { type: 'application/json' }),
    };
    const result = {
      report: JSON.parse(report),
      farthest: planned.farthest(),
      heights: { values: heights, rays, rings },
      touches,
      turns,
      residues: null,
      extension: planned.extension(),
      files,
    };
    return { result, transfer: buffers([heights, touches, turns]) };
  },

  prove(_, progress) {
    if (!current) throw new Error('nothing is planned');
    current.prove(progress);
    const report = current.report();
    const values = current.residues();
    const residues = values.length > 0 ? { values, rays: current.rays(), rings: current.rings() } : null;
    const file = new Blob([report], { type: 'application/json' });
    return { result: { report: JSON.parse(report), residues, file }, transfer: buffers([values]) };
  },

  // Whoever cancelled something else has a new worker, which has planned nothing.
  motion([spec, radius], progress) {
    const values = (current ?? plan(spec, progress)).motion(radius);
    return { result: values, transfer: buffers([values]) };
  },

  compare([spec], progress) {
    const planned = planner.turning_plan(JSON.stringify(spec), undefined, progress);
    planned.prove(progress);
    const report = JSON.parse(planned.report());
    planned.free();
    return { result: report, transfer: [] };
  },
});

/** @param {Float32Array[]} arrays */
function buffers(arrays) {
  return arrays.map((array) => /** @type {ArrayBuffer} */ (array.buffer));
}
