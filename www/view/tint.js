/**
 * What the surface is coloured by: a number for each of its vertices, and colours for the numbers.
 *
 * @import { Outcome, State, Tint, TintName } from '../types.js'
 */
import { COLUMNS, createNearest, hasPostures, rangeOf, valueAt } from './along-path.js';
import { divergingColor, excessRange, sequentialColor } from './colors.js';

/** @type {TintName[]} */
export const TINTS = ['none', 'excess', 'lead', 'yaw', 'strip'];

/** Which of them there is something to see of. @param {Outcome | null} outcome */
export function tintsOf(outcome) {
  if (!outcome) return [];
  const told = hasPostures(outcome);
  return TINTS.filter((name) => name === 'none' || (name === 'excess' ? outcome.report.verified : told));
}

/** Keeps what was found for a path while that is shown. */
export function createTints() {
  /** @type {{ outcome: Outcome | null, picture: unknown, made: Map<TintName, Tint>, moves: Float64Array | null }} */
  let kept = { outcome: null, picture: null, made: new Map(), moves: null };

  /** @param {State} state @returns {Tint | null} */
  return ({ outcome, picture, layers }) => {
    const shown = outcome?.picture ?? picture;
    if (!outcome || !shown || layers.tint === 'none' || !tintsOf(outcome).includes(layers.tint)) return null;
    if (kept.outcome !== outcome || kept.picture !== shown) {
      kept = { outcome, picture: shown, made: new Map(), moves: null };
    }
    const made = kept.made.get(layers.tint);
    if (made) return made;
    let tint = null;
    if (layers.tint === 'excess') {
      tint = outcome.excess && excessTint(outcome, outcome.excess);
    } else {
      kept.moves ??= nearestMoves(outcome, shown.positions);
      tint = postureTint(outcome, layers.tint, kept.moves);
    }
    if (tint) kept.made.set(layers.tint, tint);
    return tint;
  };
}

/** What the scale of a name reaches over, without a number for any vertex. @param {Outcome} outcome @param {TintName} name */
export function scaleOf(outcome, name) {
  if (name === 'none') return null;
  if (name === 'excess') {
    const high = excessRange(outcome.report);
    return { low: -high, high, color: divergingColor };
  }
  const { low, high } = rangeOf(outcome, COLUMNS[name]);
  if (name === 'yaw') {
    const most = Math.max(Math.abs(low), Math.abs(high), 1);
    return { low: -most, high: most, color: divergingColor };
  }
  return { low, high, color: sequentialColor };
}

/** @param {Outcome} outcome @param {Float32Array} values @returns {Tint | null} */
function excessTint(outcome, values) {
  const scale = scaleOf(outcome, 'excess');
  return scale && { values, ...scale };
}

/** @param {Outcome} outcome @param {'lead' | 'yaw' | 'strip'} name @param {Float64Array} moves @returns {Tint | null} */
function postureTint(outcome, name, moves) {
  const scale = scaleOf(outcome, name);
  const values = Float32Array.from(moves, (move) =>
    move < 0 ? Number.NaN : valueAt(outcome, move, COLUMNS[name]),
  );
  return scale && { values, ...scale };
}

/** @param {Outcome} outcome @param {Float32Array} positions */
function nearestMoves(outcome, positions) {
  const nearest = createNearest(outcome);
  return Float64Array.from({ length: positions.length / 3 }, (_, i) =>
    nearest(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]),
  );
}
