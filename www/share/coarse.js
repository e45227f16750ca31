/**
 * A shape with few triangles, for a picture that travels: vertices in one cell of a grid become one.
 *
 * Source: J. Rossignac and P. Borrel, "Multi-resolution 3D approximations for rendering complex scenes", 1993; here the
 * representative of a cell is the vertex that comes first, so that nothing lies off the shape.
 *
 * @import { Picture } from '../types.js'
 */

/**
 * @param {Picture} picture
 * @param {number} cell Edge of the grid's cells, mm.
 * @returns {{ vertices: number[], triangles: number[] }} Numbers of the vertices that stay, and three places in that list
 *   a triangle.
 */
export function coarsened({ positions, indices }, cell) {
  /** @type {Map<string, number>} */
  const cells = new Map();
  /** @type {number[]} */
  const vertices = [];
  const place = Array.from({ length: positions.length / 3 }, (_, i) => {
    const key = [0, 1, 2].map((k) => Math.floor(positions[3 * i + k] / cell)).join();
    const known = cells.get(key);
    if (known !== undefined) return known;
    cells.set(key, vertices.length);
    return vertices.push(i) - 1;
  });
  /** @type {Set<string>} */
  const seen = new Set();
  /** @type {number[]} */
  const triangles = [];
  for (let i = 0; i < indices.length; i += 3) {
    const corners = [place[indices[i]], place[indices[i + 1]], place[indices[i + 2]]];
    const key = [...corners].sort((a, b) => a - b).join();
    if (new Set(corners).size < 3 || seen.has(key)) continue;
    seen.add(key);
    triangles.push(...corners);
  }
  return { vertices, triangles };
}

/** Normals of vertices, from the triangles around them. @param {Float32Array} positions @param {Uint32Array} indices */
export function normalsOf(positions, indices) {
  const normals = new Float32Array(positions.length);
  for (let i = 0; i < indices.length; i += 3) {
    const [a, b, c] = [indices[i], indices[i + 1], indices[i + 2]];
    const u = [0, 1, 2].map((k) => positions[3 * b + k] - positions[3 * a + k]);
    const v = [0, 1, 2].map((k) => positions[3 * c + k] - positions[3 * a + k]);
    const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    for (const vertex of [a, b, c]) for (let k = 0; k < 3; k += 1) normals[3 * vertex + k] += n[k];
  }
  for (let i = 0; i < normals.length; i += 3) {
    const size = Math.hypot(normals[i], normals[i + 1], normals[i + 2]) || 1;
    for (let k = 0; k < 3; k += 1) normals[i + k] /= size;
  }
  return normals;
}
