/**
 * What is left on the surface while the path is run.
 *
 * @import { Removal } from '../types.js'
 */

/** @param {Removal} removal @param {number} vertices */
export function createRemoving({ steps, vertices: cut, excess }, vertices) {
  /** What is left at each vertex, mm; not a number where nothing has come near yet. */
  const left = new Float32Array(vertices).fill(Number.NaN);
  let next = 0;

  return {
    left,

    /**
     * Goes to the end of a move; returns the vertices that changed since.
     *
     * @param {number} move
     * @returns {Iterable<number>}
     */
    to(move) {
      const before = next > 0 ? steps[next - 1] : -1;
      if (move < before) {
        left.fill(Number.NaN);
        next = 0;
      }
      const from = next;
      while (next < steps.length && steps[next] <= move) {
        left[cut[next]] = excess[next];
        next += 1;
      }
      return move < before ? left.keys() : cut.subarray(from, next);
    },
  };
}
