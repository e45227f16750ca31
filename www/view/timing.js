/**
 * When the cutter is where: minutes since the start at each point of a path, at the feeds that were asked for.
 *
 * A machine that slows down in corners is later.
 *
 * @import { Outcome, Spec } from '../types.js'
 */
import { KIND, LENGTH, STRIDE } from './way.js';

/**
 * @param {Outcome} outcome
 * @param {Spec['feeds']} feeds mm a minute.
 */
export function createTiming({ path }, feeds) {
  const points = path.length / STRIDE;
  const kindOf = (/** @type {number} */ i) => path[STRIDE * i + KIND];
  /** Of the move that ends at a point: the last one of a link goes down to the pass. @param {number} i */
  const speed = (i) => {
    if (kindOf(i) === 2) return feeds.rapid_mm_per_min;
    const plunges = kindOf(i) === 1 && (i + 1 >= points || kindOf(i + 1) === 0);
    return plunges ? feeds.plunge_mm_per_min : feeds.cut_mm_per_min;
  };
  const minutes = new Float64Array(points);
  for (let i = 1; i < points; i += 1) {
    const length = path[STRIDE * i + LENGTH] - path[STRIDE * (i - 1) + LENGTH];
    minutes[i] = minutes[i - 1] + length / (speed(i) || 1);
  }
  const length = (/** @type {number} */ i) => path[STRIDE * i + LENGTH];
  const all = points > 0 ? length(points - 1) : 0;

  /** The last point that is not beyond `wanted` in an ascending list, and the share of the way to the next. @param {(i: number) => number} value @param {number} wanted */
  function place(value, wanted) {
    let low = 0;
    let high = Math.max(points - 1, 0);
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (value(middle) <= wanted) low = middle;
      else high = middle - 1;
    }
    const next = Math.min(low + 1, points - 1);
    const span = value(next) - value(low);
    return { point: low, share: span > 0 ? (wanted - value(low)) / span : 0 };
  }

  return {
    /** Of the whole path. */
    minutes: minutes[points - 1] ?? 0,

    /** Minutes after a share of the path's length. @param {number} at */
    timeAt(at) {
      const { point, share } = place(length, at * all);
      return minutes[point] + ((minutes[point + 1] ?? minutes[point]) - minutes[point]) * share;
    },

    /** The share of the length after a time. @param {number} time Minutes. */
    atTime(time) {
      const { point, share } = place((i) => minutes[i], time);
      const next = Math.min(point + 1, points - 1);
      return all > 0 ? Math.min((length(point) + (length(next) - length(point)) * share) / all, 1) : 1;
    },

    /** The share of the length one move on (`by` 1) or back (−1). @param {number} at @param {number} by */
    stepped(at, by) {
      const { point, share } = place(length, at * all);
      // Within a move, back is to its start; points that coincide are one.
      let next = by > 0 ? point + 1 : share > 1e-6 ? point : point - 1;
      while (next > 0 && next < points - 1 && Math.abs(length(next) / all - at) < 1e-9) next += by;
      return all > 0 ? Math.min(Math.max(length(Math.min(Math.max(next, 0), points - 1)) / all, 0), 1) : 1;
    },

    /** The feed of the move under way, mm a minute, and its kind. @param {number} at */
    moveAt(at) {
      const { point } = place(length, at * all);
      const next = Math.min(point + 1, points - 1);
      return points > 1 ? { kind: kindOf(next), feed: speed(next) } : { kind: 0, feed: feeds.cut_mm_per_min };
    },
  };
}
