/**
 * What the surface is coloured by: a number for each of its vertices, and colours for the numbers.
 *
 * @import { Outcome, State, Tint, TintName } from '../types.js'
 */
import { COLUMNS, createNearest, hasPostures, passesOf, rangeOf, speedsOf, valueAt } from './along-path.js';
import { divergingColor, excessRange, sequentialColor } from './colors.js';

/** @type {TintName[]} */
export const TINTS = ['none', 'excess', 'gouge', 'lead', 'yaw', 'strip', 'feed', 'pass'];

/** Which of them there is something to see of. @param {Outcome | null} outcome */
export function tintsOf(outcome) {
  if (!outcome) return [];
  const told = hasPostures(outcome);
  const isProven = Boolean(outcome.report.verified && outcome.excess);
  return TINTS.filter((name) => {
    if (name === 'excess' || name === 'gouge') return isProven;
    return name === 'none' || told;
  });
}

/** Keeps what was found for a path while that is shown. */
export function createTints() {
  /** @type {{ outcome: Outcome | null, picture: unknown, made: Map<TintName, Tint>, moves: Float64Array | null }} */
  let kept = { outcome: null, picture: null, made: new Map(), moves: null };

  /** @param {State} state @returns {Tint | null} */
  return ({ outcome, picture, layers, range }) => {
    const tint = whole(outcome, picture, layers);
    return tint && range ? { ...tint, low: range[0], high: range[1] } : tint;
  };

  /** @param {Outcome | null} outcome @param {State['picture']} picture @param {State['layers']} layers @returns {Tint | null} */
  function whole(outcome, picture, layers) {
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
    } else if (layers.tint === 'gouge') {
      const scale = scaleOf(outcome, 'gouge');
      // How deep, as a positive number.
      tint = outcome.excess &&
        scale && { values: outcome.excess.map((excess) => Math.max(0, -excess)), ...scale };
    } else {
      kept.moves ??= nearestMoves(outcome, shown.positions);
      tint = postureTint(outcome, layers.tint, kept.moves);
    }
    if (tint) kept.made.set(layers.tint, tint);
    return tint;
  }
}

/** What the scale of a name reaches over, without a number for any vertex. @param {Outcome} outcome @param {TintName} name */
export function scaleOf(outcome, name) {
  if (name === 'none') return null;
  if (name === 'excess') {
    const high = excessRange(outcome.report);
    return { low: -high, high, color: divergingColor };
  }
  if (name === 'gouge') {
    const deepest = -(outcome.report.verified?.largest_gouge_mm ?? 0);
    return { low: 0, high: deepest || 0.001, color: sequentialColor };
  }
  if (name === 'feed' || name === 'pass') {
    const along = name === 'feed' ? speedsOf(outcome) : passesOf(outcome);
    const known = along.filter((value) => !Number.isNaN(value)).sort();
    const [low, high] = [0.01, 0.99].map((share) => known[Math.floor(share * (known.length - 1))] ?? 0);
    return name === 'feed'
      ? { low, high, color: sequentialColor }
      : { low: known[0] ?? 0, high: known.at(-1) ?? 1, color: sequentialColor };
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

/** @param {Outcome} outcome @param {Exclude<TintName, 'none' | 'excess' | 'gouge'>} name @param {Float64Array} moves @returns {Tint | null} */
function postureTint(outcome, name, moves) {
  const scale = scaleOf(outcome, name);
  const along = name === 'feed' ? speedsOf(outcome) : name === 'pass' ? passesOf(outcome) : null;
  /** @param {number} move */
  const value = (move) => {
    if (move < 0) return Number.NaN;
    if (along) return along[Math.min(Math.floor(move) + 1, along.length - 1)];
    return valueAt(outcome, move, COLUMNS[/** @type {keyof typeof COLUMNS} */ (name)]);
  };
  const values = Float32Array.from(moves, value);
  return scale && { values, ...scale };
}

/** @param {Outcome} outcome @param {Float32Array} positions */
function nearestMoves(outcome, positions) {
  const nearest = createNearest(outcome);
  return Float64Array.from({ length: positions.length / 3 }, (_, i) =>
    nearest(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]),
  );
}
