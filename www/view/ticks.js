/** Where numbers stand on an axis. */

/** The least step of 1, 2 or 5 times a power of ten that is at least `least`. @param {number} least */
export function niceStep(least) {
  const power = 10 ** Math.floor(Math.log10(least));
  return [1, 2, 5, 10].map((k) => k * power).find((size) => size >= least) ?? least;
}

/** Multiples of a step between two ends. @param {[number, number]} ends @param {number} step */
export function ticks([low, high], step) {
  const first = Math.ceil(low / step - 1e-9);
  const last = Math.floor(high / step + 1e-9);
  return Array.from({ length: last - first + 1 }, (_, i) => Number(((first + i) * step).toPrecision(6)));
}

/** Round numbers between two ends, at most about `count` of them. @param {[number, number]} ends @param {number} count */
export const niceTicks = ([low, high], count) =>
  ticks([low, high], niceStep((high - low) / Math.max(count, 1)));
