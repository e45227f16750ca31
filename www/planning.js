/** What a module that plans for mills can be asked for. Several do: the first one of the page, and the one that knows more. */

/**
 * @import { Operations } from './serving.js'
 * @typedef {typeof import('./wasm/stepover.js')} Planner
 */

/**
 * @param {Pick<Planner, 'schema' | 'gallery' | 'inspect' | 'preview' | 'outline' | 'stepover' | 'plan'>} planner
 * @returns {Operations}
 */
export function planning(planner) {
  /** What was planned last, for its proof. @type {import('./wasm/stepover.js').Outcome | null} */
  let current = null;

  return {
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
      const none = { picture: null, excess: null, histogram: null, proofSeconds: null };
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
      const shares = { excess: shown.excess(), histogram: current.histogram() };
      shown.free();
      return {
        result: { ...result, picture: arrays, ...shares },
        transfer: [...buffers(arrays), ...buffers(shares)],
      };
    },
  };
}

/** @param {{ positions(): Float32Array, normals(): Float32Array, indices(): Uint32Array }} source */
export function picture(source) {
  return { positions: source.positions(), normals: source.normals(), indices: source.indices() };
}

/** @param {Record<string, ArrayBufferView>} arrays */
export function buffers(arrays) {
  return Object.values(arrays).map((array) => /** @type {ArrayBuffer} */ (array.buffer));
}
