/** A path as the planner gives it, and places on it. */

/** Numbers a point of `path`; the kind of the move that ends there (0 cut, 1 link, 2 rapid), and the length so far. */
export const STRIDE = 8;
export const KIND = 6;
export const LENGTH = 7;

/** The share of the path at which the last pass ends. @param {Float32Array} path */
export function lastCut(path) {
  let point = path.length / STRIDE - 1;
  const all = path[point * STRIDE + LENGTH];
  while (point > 0 && path[point * STRIDE + KIND] !== 0) point -= 1;
  return all > 0 ? path[point * STRIDE + LENGTH] / all : 1;
}

/** The share of the path that is done at a place: the move before it and how much of the next. @param {Float32Array} path @param {number} place */
export function shareAt(path, place) {
  const last = path.length / STRIDE - 1;
  const move = Math.min(Math.floor(place), last);
  const from = path[move * STRIDE + LENGTH];
  const to = path[Math.min(move + 1, last) * STRIDE + LENGTH];
  const all = path[last * STRIDE + LENGTH];
  return all > 0 ? (from + (to - from) * (place - move)) / all : 1;
}

/**
 * Where the cutter is after a share of the path: the point reached last, and tip and axis between it and the next.
 *
 * @param {Float32Array} path
 * @param {number} at From 0 to 1.
 */
export function locate(path, at) {
  const points = path.length / STRIDE;
  const wanted = at * path[(points - 1) * STRIDE + LENGTH];
  let low = 0;
  let high = points - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (path[middle * STRIDE + LENGTH] <= wanted) low = middle;
    else high = middle - 1;
  }
  const next = Math.min(low + 1, points - 1);
  const from = path[low * STRIDE + LENGTH];
  const span = path[next * STRIDE + LENGTH] - from;
  const share = span > 0 ? (wanted - from) / span : 0;
  const mix = (/** @type {number} */ k) =>
    path[low * STRIDE + k] + (path[next * STRIDE + k] - path[low * STRIDE + k]) * share;
  return { point: at >= 1 ? points : low, tip: [mix(0), mix(1), mix(2)], axis: [mix(3), mix(4), mix(5)] };
}
