/**
 * Looks closely at a job: what is at a place, its passes in the domain of the parameters, what is cut when.
 *
 * @import { Draft } from '../types.js'
 */
import { createStudyPlanner } from './planner.js';

/**
 * @typedef {{ u: number, v: number, least_curvature: number | null, most_curvature: number | null }} Place
 * Curvatures in 1/mm, above 0 where hollow.
 * @typedef {{ uv: Float32Array, potential: Float32Array, ends: Float64Array }} DomainPicture
 * `uv` has two numbers a move; `potential` six a place: u, v, a step along the widest strip as long as it is wide, the widest and the
 * narrowest strip (mm); `ends` of u, then of v.
 * @typedef {{ steps: Uint32Array, vertices: Uint32Array, excess: Float32Array }} Removed
 */

export function createStudy() {
  const planner = createStudyPlanner('study');
  /** What the worker holds the surface of. @type {{ source: unknown, strategy: unknown, cutter: unknown, bytes: unknown, key: number }} */
  let held = { source: null, strategy: null, cutter: null, bytes: null, key: 0 };

  /** Has the worker hold the surface of a draft; whether it has parameters. @param {Draft} draft @returns {Promise<boolean>} */
  function hold({ spec, source: { bytes } }) {
    const { source, strategy, cutter } = spec;
    const same =
      held.source === source && held.strategy === strategy && held.cutter === cutter && held.bytes === bytes;
    if (!same) held = { source, strategy, cutter, bytes, key: held.key + 1 };
    const holding = planner.call('surface', [held.key, spec, same ? null : bytes]);
    // A worker that was stopped holds nothing.
    holding.catch(() => {
      held = { ...held, source: null };
    });
    return holding;
  }

  return {
    /** What is at a point of the surface, mm; nothing on a mesh. @param {Draft} draft @param {number[]} point @returns {Promise<Place | null>} */
    async place(draft, point) {
      return (await hold(draft)) ? planner.call('place', point) : null;
    },

    /** @param {Draft} draft @param {Float32Array} contacts @param {number} count Places of the potential a side. @returns {Promise<DomainPicture | null>} */
    async domain(draft, contacts, count) {
      return (await hold(draft)) ? planner.call('domain', [contacts, count]) : null;
    },

    /** @param {Draft} draft @param {string} apt @param {(phase: string, fraction: number) => void} onProgress @returns {Promise<Removed>} */
    removed: (draft, apt, onProgress) =>
      planner.call('removed', [draft.spec, draft.source.bytes, apt], onProgress),

    /** The path from above, as SVG. @param {string} apt @returns {Promise<string>} */
    drawing: (apt) => planner.call('drawing', [apt]),

    /** Stops whatever it does; the surface is held anew. */
    cancel() {
      held = { source: null, strategy: null, cutter: null, bytes: null, key: held.key + 1 };
      planner.cancel();
    },
  };
}
