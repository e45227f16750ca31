/** Holds the planner: the only file that knows the module's functions. */
import init, * as planner from './wasm/stepover.js';

/** Messages to the page are no use faster than it draws. */
const PROGRESS_EVERY_MS = 30;

/** @type {(module: WebAssembly.Module) => void} */
let provide;
/** The module arrives as a message, and requests may arrive before it. */
const ready = new Promise((resolve) => {
  provide = resolve;
}).then((module) => init({ module_or_path: /** @type {WebAssembly.Module} */ (module) }));

/** @typedef {(phase: string, fraction: number) => void} Progress */
/** @typedef {{ result: any, transfer: Transferable[] }} Answer */

/** What was planned last, for its proof. @type {planner.Outcome | null} */
let current = null;

/** @type {Record<string, (args: any[], progress: Progress) => Answer>} */
const operations = {
  start: () => ({
    result: { schema: JSON.parse(planner.schema()), gallery: JSON.parse(planner.gallery()) },
    transfer: [],
  }),

  inspect: ([name, bytes]) => ({ result: JSON.parse(planner.inspect(name, bytes)), transfer: [] }),

  preview([spec, bytes]) {
    const preview = planner.preview(JSON.stringify(spec), bytes ?? undefined);
    const result = picture(preview);
    preview.free();
    return { result, transfer: buffers(result) };
  },

  outline([spec]) {
    const result = planner.outline(JSON.stringify(spec));
    return { result, transfer: buffers({ result }) };
  },

  stepover([spec, radii]) {
    const text = planner.stepover(JSON.stringify(spec), new Float64Array(radii));
    return { result: JSON.parse(text), transfer: [] };
  },

  plan([spec, bytes], progress) {
    const text = JSON.stringify(spec);
    const began = performance.now();
    current?.free();
    current = null;
    const outcome = planner.plan(text, bytes ?? undefined, progress);
    current = outcome;
    const seconds = (performance.now() - began) / 1000;
    const unreached = outcome.unreached();
    const arrays = {
      path: outcome.path(),
      contacts: outcome.contacts(),
      postures: outcome.postures(),
      zones: unreached.centers(),
      outline: planner.outline(text),
    };
    const zoneEdge = unreached.edge();
    unreached.free();
    const report = outcome.report();
    const nc = outcome.nc();
    // As blobs the texts stay out of the page's memory until somebody saves them.
    const files = {
      apt: new Blob([outcome.apt()], { type: 'text/plain' }),
      nc: nc === undefined ? null : new Blob([nc], { type: 'text/plain' }),
      csv: new Blob([outcome.csv()], { type: 'text/csv' }),
      report: new Blob([report], { type: 'application/json' }),
    };
    const none = { picture: null, excess: null, proofSeconds: null };
    return {
      result: { report: JSON.parse(report), seconds, ...arrays, zoneEdge, ...none, files },
      transfer: buffers(arrays),
    };
  },

  prove(_, progress) {
    if (!current) throw new Error('nothing is planned');
    const began = performance.now();
    current.prove(progress);
    const proofSeconds = (performance.now() - began) / 1000;
    const report = current.report();
    const files = { report: new Blob([report], { type: 'application/json' }) };
    const result = { report: JSON.parse(report), proofSeconds, files };
    const shown = current.picture();
    if (!shown) return { result, transfer: [] };
    const arrays = picture(shown);
    const excess = shown.excess();
    shown.free();
    return {
      result: { ...result, picture: arrays, excess },
      transfer: [...buffers(arrays), ...buffers({ excess })],
    };
  },
};

/** @param {{ positions(): Float32Array, normals(): Float32Array, indices(): Uint32Array }} source */
function picture(source) {
  return { positions: source.positions(), normals: source.normals(), indices: source.indices() };
}

/** @param {Record<string, ArrayBufferView>} arrays */
function buffers(arrays) {
  return Object.values(arrays).map((array) => /** @type {ArrayBuffer} */ (array.buffer));
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
  let last = { time: -PROGRESS_EVERY_MS, phase: '' };
  return (phase, fraction) => {
    const time = performance.now();
    if (phase === last.phase && time - last.time < PROGRESS_EVERY_MS) return;
    last = { time, phase };
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
