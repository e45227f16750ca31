/**
 * Contacts along the path, found from any place near it.
 *
 * @import { Outcome } from '../types.js'
 */
import { KIND, LENGTH, STRIDE } from './way.js';

/** Numbers a move of `postures`. */
export const POSTURE = 4;
/** Their places: degrees, degrees, millimetres, and what keeps the lead from being less. */
export const COLUMNS = /** @type {const} */ ({ lead: 0, yaw: 1, strip: 2 });
/** A cell of the search is at most this share of the path's size. */
const LARGEST_CELL = 0.02;

/** @param {Outcome} outcome @param {number} move */
export const touches = ({ postures }, move) => !Number.isNaN(postures[move * POSTURE]);

/** Whether strips are known anywhere: not on meshes. @param {Outcome | null} outcome */
export function hasPostures(outcome) {
  return outcome?.postures.some((value, i) => i % POSTURE === COLUMNS.strip && !Number.isNaN(value)) ?? false;
}

/**
 * The least and the largest number of a column but for the outermost hundredths, which are spots.
 *
 * @param {Outcome} outcome
 * @param {number} column
 */
export function rangeOf({ postures }, column) {
  const values = new Float32Array(postures.length / POSTURE);
  let count = 0;
  for (let i = column; i < postures.length; i += POSTURE) {
    if (Number.isNaN(postures[i])) continue;
    values[count] = postures[i];
    count += 1;
  }
  const sorted = values.subarray(0, count).sort();
  return { low: sorted[Math.floor(0.01 * count)] ?? 0, high: sorted[Math.floor(0.99 * (count - 1))] ?? 0 };
}

/**
 * Finds the contact nearest to a place, at most about a strip away.
 *
 * @param {Outcome} outcome
 */
export function createNearest(outcome) {
  const { path, contacts } = outcome;
  const cell = cellOf(outcome);
  /** Places in order of their cells: x, y, z, and the move with a fraction for how far before its end. @type {number[]} */
  const places = [];
  for (let i = 1; i < path.length / STRIDE; i += 1) {
    if (path[i * STRIDE + KIND] !== 0 || !touches(outcome, i)) continue;
    const from = touches(outcome, i - 1) ? i - 1 : i;
    const at = (/** @type {number} */ share, /** @type {number} */ k) =>
      contacts[3 * from + k] + (contacts[3 * i + k] - contacts[3 * from + k]) * share;
    const way = Math.hypot(...[0, 1, 2].map((k) => contacts[3 * i + k] - contacts[3 * from + k]));
    const count = Math.max(1, Math.ceil((2 * way) / cell));
    for (let n = 1; n <= count; n += 1) {
      const share = n / count;
      places.push(at(share, 0), at(share, 1), at(share, 2), i - 1 + share);
    }
  }
  /** @type {Map<number, number[]>} */
  const cells = new Map();
  const key = (/** @type {number} */ x, /** @type {number} */ y, /** @type {number} */ z) =>
    (x * 73856093) ^ (y * 19349663) ^ (z * 83492791);
  const floor = (/** @type {number} */ value) => Math.floor(value / cell);
  for (let p = 0; p < places.length; p += 4) {
    const k = key(floor(places[p]), floor(places[p + 1]), floor(places[p + 2]));
    const list = cells.get(k);
    if (list) list.push(p);
    else cells.set(k, [p]);
  }

  /**
   * The move whose way passes nearest, with a fraction for how much of it is done; −1 where none is near.
   *
   * @param {number} x
   * @param {number} y
   * @param {number} z
   */
  return (x, y, z) => {
    let best = -1;
    let least = cell * cell;
    for (let n = 0; n < 27; n += 1) {
      const [i, j, k] = [(n % 3) - 1, (Math.floor(n / 3) % 3) - 1, Math.floor(n / 9) - 1];
      for (const p of cells.get(key(floor(x) + i, floor(y) + j, floor(z) + k)) ?? []) {
        const [dx, dy, dz] = [places[p] - x, places[p + 1] - y, places[p + 2] - z];
        const far = dx * dx + dy * dy + dz * dz;
        if (far < least) {
          least = far;
          best = places[p + 3];
        }
      }
    }
    return best;
  };
}

/** The width of most strips, but no more than a share of the whole. @param {Outcome} outcome */
function cellOf(outcome) {
  const { contacts } = outcome;
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < contacts.length; i += 1) {
    if (!touches(outcome, Math.floor(i / 3))) continue;
    low[i % 3] = Math.min(low[i % 3], contacts[i]);
    high[i % 3] = Math.max(high[i % 3], contacts[i]);
  }
  const size = Math.hypot(...low.map((from, k) => high[k] - from));
  const widest = rangeOf(outcome, COLUMNS.strip).high;
  const largest = LARGEST_CELL * size || 1;
  return widest > 0 ? Math.min(widest, largest) : largest;
}

/**
 * A column at a place on the path, between the ends of a move.
 *
 * @param {Outcome} outcome
 * @param {number} place The move before it and how much of the next is done.
 * @param {number} column
 */
export function valueAt({ postures }, place, column) {
  const move = Math.floor(place);
  const from = postures[move * POSTURE + column];
  const to = postures[Math.min(move + 1, postures.length / POSTURE - 1) * POSTURE + column];
  if (Number.isNaN(from)) return to;
  return Number.isNaN(to) ? from : from + (to - from) * (place - move);
}

/** How fast the contact runs over the surface on each move, as a share of the tip's speed. @param {Outcome} outcome */
export function speedsOf({ path, contacts, postures }) {
  const speeds = new Float32Array(path.length / STRIDE).fill(Number.NaN);
  for (let i = 1; i < speeds.length; i += 1) {
    const isCut = path[i * STRIDE + KIND] === 0;
    if (!isCut || Number.isNaN(postures[i * POSTURE]) || Number.isNaN(postures[(i - 1) * POSTURE])) continue;
    const way = Math.hypot(...[0, 1, 2].map((k) => contacts[3 * i + k] - contacts[3 * (i - 1) + k]));
    const tip = path[i * STRIDE + LENGTH] - path[(i - 1) * STRIDE + LENGTH];
    if (tip > 0) speeds[i] = way / tip;
  }
  return speeds;
}

/** The number of the pass of each move, from 1. @param {Outcome} outcome */
export function passesOf({ path }) {
  const passes = new Float32Array(path.length / STRIDE).fill(Number.NaN);
  let pass = 0;
  for (let i = 1; i < passes.length; i += 1) {
    if (path[i * STRIDE + KIND] !== 0) continue;
    if (i === 1 || path[(i - 1) * STRIDE + KIND] !== 0) pass += 1;
    passes[i] = pass;
  }
  return passes;
}

/** The moves of the pass that the cutter is on at `move`, or of the one before: first and last. @param {Outcome} outcome @param {number} move */
export function passAt({ path }, move) {
  const isCut = (/** @type {number} */ i) => path[i * STRIDE + KIND] === 0;
  let last = Math.min(move, path.length / STRIDE - 1);
  while (last > 0 && !isCut(last)) last -= 1;
  let first = last;
  while (first > 1 && isCut(first - 1)) first -= 1;
  while (last + 1 < path.length / STRIDE && isCut(last + 1)) last += 1;
  return { first: Math.max(first - 1, 0), last };
}
