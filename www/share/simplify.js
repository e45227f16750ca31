/**
 * Which points of a path stay so that it nowhere leaves its course by more than a tolerance.
 *
 * Source: U. Ramer 1972, D. Douglas and T. Peucker 1973. The kinds of moves meet in points that stay.
 *
 * @param {Float32Array} points Three numbers a point.
 * @param {(i: number) => number} kind Of the move that ends at a point.
 * @param {number} tolerance mm.
 * @returns {number[]} Ascending.
 */
export function simplified(points, kind, tolerance) {
  const count = points.length / 3;
  const stays = new Uint8Array(count);
  let first = 0;
  for (let i = 1; i < count; i += 1) {
    if (i + 1 < count && kind(i + 1) === kind(i)) continue;
    keep(points, first, i, tolerance, stays);
    first = i;
  }
  if (count > 0) stays[0] = 1;
  /** @type {number[]} */
  const kept = [];
  for (let i = 0; i < count; i += 1) if (stays[i]) kept.push(i);
  return kept;
}

/** @param {Float32Array} points @param {number} from @param {number} to @param {number} tolerance @param {Uint8Array} stays */
function keep(points, from, to, tolerance, stays) {
  stays[from] = stays[to] = 1;
  // A list instead of calls within calls: a pass may have a million points.
  const open = [[from, to]];
  for (let span = open.pop(); span; span = open.pop()) {
    const [a, b] = span;
    let most = tolerance * tolerance;
    let worst = -1;
    for (let i = a + 1; i < b; i += 1) {
      const far = distance2(points, i, a, b);
      if (far > most) [most, worst] = [far, i];
    }
    if (worst < 0) continue;
    stays[worst] = 1;
    open.push([a, worst], [worst, b]);
  }
}

/** The square of a point's distance from a segment. @param {Float32Array} p @param {number} i @param {number} a @param {number} b */
function distance2(p, i, a, b) {
  const [x, y, z] = [p[3 * b] - p[3 * a], p[3 * b + 1] - p[3 * a + 1], p[3 * b + 2] - p[3 * a + 2]];
  const [u, v, w] = [p[3 * i] - p[3 * a], p[3 * i + 1] - p[3 * a + 1], p[3 * i + 2] - p[3 * a + 2]];
  const long = x * x + y * y + z * z;
  const share = long > 0 ? Math.min(Math.max((u * x + v * y + w * z) / long, 0), 1) : 0;
  return (u - share * x) ** 2 + (v - share * y) ** 2 + (w - share * z) ** 2;
}
