/** A cutter's outline as points (radius, height), millimetres, from its tip up. @param {Float32Array} flat */
export function pairs(flat) {
  /** @type {[number, number][]} */
  const points = [];
  for (let i = 0; i + 1 < flat.length; i += 2) points.push([flat[i], flat[i + 1]]);
  return points;
}
