/**
 * A path and the shape below it as few bytes: points on a grid, neighbours as differences of differences, colours as bytes.
 *
 * @import { Outcome, Picture } from '../types.js'
 */
import { coarsened, normalsOf } from './coarse.js';
import { createReader, createWriter, Malformed } from './numbers.js';
import { simplified } from './simplify.js';

/** Numbers a point of a path: tip, axis, kind, length so far. */
const STRIDE = 8;
const KIND = 6;

/** What a link may ask to be drawn. */
const MOST_POINTS = 60_000;
const MOST_VERTICES = 20_000;
const MOST_TRIANGLES = 40_000;

/** A colour byte: 0 where nothing is known, and the scale from its low to its high end on the others. */
const LEVELS = 254;

/**
 * @typedef {{ low: number[], step: number, scale: number }} Grid Its corner and its step, mm, and the excess at the end of
 *   the colours, mm.
 */

/**
 * @param {Outcome} outcome
 * @param {Picture | null} picture
 * @param {number} step mm; the path is simplified within half of it.
 * @param {number} cell Of the coarse shape, mm.
 * @returns {{ grid: Grid, bytes: Uint8Array }}
 */
export function packed({ path, contacts, excess, report }, picture, step, cell) {
  const kept = simplified(contacts, (i) => path[STRIDE * i + KIND], 0.5 * step);
  const coarse = picture ? coarsened(picture, cell) : { vertices: [], triangles: [] };
  const { vertices, triangles } = coarse;
  const low = [0, 1, 2].map((k) => {
    const path = contacts.reduce((least, x, i) => (i % 3 === k && x < least ? x : least), Infinity);
    return vertices.reduce((least, i) => Math.min(least, picture?.positions[3 * i + k] ?? least), path);
  });
  const scale = report.scallop_mm > 0 ? report.scallop_mm : 0.01;
  const writer = createWriter();
  writer.count(kept.length);
  for (const [kind, length] of runs(kept.map((i) => path[STRIDE * i + KIND]))) {
    writer.count(kind);
    writer.count(length);
  }
  const place = (/** @type {Float32Array} */ all, /** @type {number} */ i, /** @type {number} */ k) =>
    Math.round((all[3 * i + k] - low[k]) / step);
  for (let k = 0; k < 3; k += 1) {
    let [last, slope] = [0, 0];
    for (const i of kept) {
      const value = place(contacts, i, k);
      writer.signed(value - last - slope);
      [slope, last] = [value - last, value];
    }
  }
  writer.count(vertices.length);
  for (let k = 0; k < 3 && picture; k += 1) {
    let last = 0;
    for (const i of vertices) {
      const value = place(picture.positions, i, k);
      writer.signed(value - last);
      last = value;
    }
  }
  let last = 0;
  for (const i of vertices) {
    const value = level(excess && picture ? excess[i] : Number.NaN, scale);
    writer.signed(value - last);
    last = value;
  }
  writer.count(triangles.length / 3);
  last = 0;
  for (const vertex of triangles) {
    writer.signed(vertex - last);
    last = vertex;
  }
  return { grid: { low, step, scale }, bytes: writer.bytes() };
}

/**
 * What {@link packed} put together, as the arrays of an outcome. Throws {@link Malformed}.
 *
 * @param {Grid} grid
 * @param {Uint8Array} bytes
 */
export function unpacked({ low, step, scale }, bytes) {
  const reader = createReader(bytes);
  const count = reader.size(MOST_POINTS);
  const path = new Float32Array(STRIDE * count);
  const contacts = new Float32Array(3 * count);
  for (let i = 0; i < count; ) {
    const kind = reader.size(2);
    const length = reader.size(count - i);
    if (length === 0) throw new Malformed('a run of no moves');
    for (const end = i + length; i < end; i += 1) path[STRIDE * i + KIND] = kind;
  }
  for (let k = 0; k < 3; k += 1) {
    let [last, slope] = [0, 0];
    for (let i = 0; i < count; i += 1) {
      slope += reader.signed();
      last += slope;
      contacts[3 * i + k] = low[k] + step * last;
    }
  }
  lay(path, contacts);
  const vertices = reader.size(MOST_VERTICES);
  const positions = new Float32Array(3 * vertices);
  for (let k = 0; k < 3; k += 1) {
    let last = 0;
    for (let i = 0; i < vertices; i += 1) {
      last += reader.signed();
      positions[3 * i + k] = low[k] + step * last;
    }
  }
  const excess = new Float32Array(vertices);
  let last = 0;
  for (let i = 0; i < vertices; i += 1) {
    last += reader.signed();
    excess[i] = last <= 0 ? Number.NaN : ((last - 1) / LEVELS) * 2 * scale - scale;
  }
  const indices = new Uint32Array(3 * reader.size(MOST_TRIANGLES));
  last = 0;
  for (let i = 0; i < indices.length; i += 1) {
    last += reader.signed();
    if (last < 0 || last >= vertices) throw new Malformed('a triangle without its vertex');
    indices[i] = last;
  }
  if (![...contacts, ...positions].every(Number.isFinite)) throw new Malformed('a point that is nowhere');
  const picture = vertices > 0 ? { positions, normals: normalsOf(positions, indices), indices } : null;
  return { path, contacts, picture, excess: picture ? excess : null };
}

/** Fills in what a path has besides its kinds: tips at the contacts, upright axes, lengths. @param {Float32Array} path @param {Float32Array} contacts */
function lay(path, contacts) {
  let length = 0;
  for (let i = 0; i < contacts.length / 3; i += 1) {
    const [x, y, z] = contacts.subarray(3 * i, 3 * i + 3);
    const j = i > 0 ? i - 1 : 0;
    length += Math.hypot(x - contacts[3 * j], y - contacts[3 * j + 1], z - contacts[3 * j + 2]);
    path.set([x, y, z, 0, 0, 1], STRIDE * i);
    path[STRIDE * i + 7] = length;
  }
}

/** @param {number[]} values @returns {[number, number][]} Each with how often it follows itself. */
function runs(values) {
  /** @type {[number, number][]} */
  const found = [];
  for (const value of values) {
    const last = found.at(-1);
    if (last && last[0] === value) last[1] += 1;
    else found.push([value, 1]);
  }
  return found;
}

/** @param {number} mm @param {number} scale */
function level(mm, scale) {
  if (!Number.isFinite(mm)) return 0;
  return 1 + Math.round(((Math.min(Math.max(mm / scale, -1), 1) + 1) / 2) * LEVELS);
}
