/** Whole numbers as few bytes: seven bits a byte, the sign in the lowest bit, and neighbours as differences. */

/** A number outside of what 32 bits hold, or bytes that end too early. */
export class Malformed extends Error {}

export function createWriter() {
  /** @type {number[]} */
  const bytes = [];

  /** @param {number} value From 0 to 2³¹ − 1. */
  function count(value) {
    let rest = value;
    while (rest > 127) {
      bytes.push((rest & 127) | 128);
      rest >>>= 7;
    }
    bytes.push(rest);
  }

  return {
    count,

    /** @param {number} value Between ±2³⁰. */
    signed: (value) => count(value < 0 ? -2 * value - 1 : 2 * value),

    bytes: () => Uint8Array.from(bytes),
  };
}

/** @param {Uint8Array} bytes */
export function createReader(bytes) {
  let at = 0;

  function count() {
    let value = 0;
    for (let bits = 0; bits < 35; bits += 7) {
      if (at >= bytes.length) throw new Malformed('the numbers end too early');
      const byte = bytes[at];
      at += 1;
      value += (byte & 127) * 2 ** bits;
      if (byte < 128) {
        if (value >= 2 ** 31) break;
        return value;
      }
    }
    throw new Malformed('a number is too large');
  }

  return {
    count,

    signed() {
      const value = count();
      return value % 2 ? -(value + 1) / 2 : value / 2;
    },

    /** How many follow: no more than `most`, nor than there are bytes. @param {number} most */
    size(most) {
      const value = count();
      if (value > most) throw new Malformed('there are too many numbers');
      return value;
    },
  };
}
