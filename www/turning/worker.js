/** Holds the turning planner: the only file that knows its module's functions. */
import init, * as planner from '../wasm/turning.js';

/** Messages to the page are no use faster than it draws. */
const PROGRESS_EVERY_MS = 30;

/** Rays and places on each of the lens that is drawn. */
const LENS = [360, 56];
/** Points of the path that are drawn: more than a screen shows. */
const DRAWN = 40_000;

/** @type {(module: WebAssembly.Module) => void} */
let provide;
/** The module arrives as a message, and requests may arrive before it. */
const ready = new Promise((resolve) => {
  provide = resolve;
}).then((module) => init({ module_or_path: /** @type {WebAssembly.Module} */ (module) }));

/** @typedef {(phase: string, fraction: number) => void} Progress */
/** @typedef {{ result: any, transfer: Transferable[] }} Answer */

/** What was planned last, for its proof and its turns. @type {planner.Turned | null} */
let current = null;

/** @param {any} spec @param {Progress} progress */
function plan(spec, progress) {
  current?.free();
  current = null;
  current = planner.turning_plan(JSON.stringify(spec), undefined, progress);
  return current;
}

/** @type {Record<string, (args: any[], progress: Progress) => Answer>} */
const operations = {
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

  plan([spec], progress) {
    const planned = plan(spec, progress);
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
};

/** @param {Float32Array[]} arrays */
function buffers(arrays) {
  return arrays.map((array) => /** @type {ArrayBuffer} */ (array.buffer));
}

/**
 * The planner throws a text that holds `{code, message, field?}`; anything else is a fault of its own.
 *
 * @param {unknown} thrown
 */
function problem(thrown) {
  if (typeof thrown === 'string') {
    try {
      return JSON.parse(thrown);
    } catch {
      return { code: 'planner', message: thrown };
    }
  }
  return { code: 'trap', message: thrown instanceof Error ? thrown.message : String(thrown) };
}

/** @param {number} id @returns {Progress} */
function reporter(id) {
  let last = -PROGRESS_EVERY_MS;
  return (phase, fraction) => {
    const time = performance.now();
    if (time - last < PROGRESS_EVERY_MS) return;
    last = time;
    postMessage({ id, type: 'progress', phase, fraction });
  };
}

/** @param {MessageEvent} event */
globalThis.onmessage = async ({ data }) => {
  if (data.module) {
    provide(data.module);
    return;
  }
  const { id, op, args } = data;
  try {
    await ready;
    const { result, transfer } = operations[op](args, reporter(id));
    postMessage({ id, type: 'done', result }, { transfer });
  } catch (thrown) {
    postMessage({ id, type: 'error', ...problem(thrown) });
  }
};
