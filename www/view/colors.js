/**
 * The diverging colours of excess: gouges towards blue-violet, material left over towards orange-brown, light
 * grey at zero. Lightness falls evenly to both sides and the two hues differ for every common kind of colour
 * blindness (the ends of Brewer's PuOr).
 *
 * @import { Report } from '../types.js'
 */

/** sRGB, from −1 over 0 to +1. */
const STOPS = [
  [0x3f, 0x16, 0x6b],
  [0x6a, 0x51, 0xa3],
  [0xa5, 0x9c, 0xcd],
  [0xe9, 0xe9, 0xec],
  [0xf9, 0xb6, 0x62],
  [0xd9, 0x76, 0x14],
  [0x8c, 0x45, 0x06],
];

/** sRGB. */
const RISING = [
  [0x44, 0x01, 0x54],
  [0x3b, 0x52, 0x8b],
  [0x21, 0x91, 0x8c],
  [0x5e, 0xc9, 0x62],
  [0xfd, 0xe7, 0x25],
];

/** Runs that are laid over the picture: told apart by common colour-blind eyes too (M. Okabe and K. Ito, 2008). */
export const OVERLAYS = ['#d55e00', '#0072b2', '#cc79a7', '#009e73', '#e69f00', '#56b4e9'];

/** Where nothing is known. */
export const UNKNOWN = [0x8b, 0x94, 0x9e];

/**
 * The excess that the ends of the scale stand for, millimetres: the limit that was asked for.
 *
 * @param {Report} report
 */
export function excessRange(report) {
  return report.scallop_mm > 0 ? report.scallop_mm : (report.verified?.largest_excess_mm ?? 0.01);
}

/** sRGB bytes for a value from −1 to 1; beyond, the ends. @param {number} value */
export const divergingColor = (value) => mixed(STOPS, (value + 1) / 2);

/**
 * The colours of what has no middle, from −1 to 1; beyond, the ends. Lightness rises evenly (viridis, S. van der Walt and
 * N. Smith, 2015, CC0).
 *
 * @param {number} value
 */
export const sequentialColor = (value) => mixed(RISING, (value + 1) / 2);

/** @param {number[][]} stops @param {number} share */
function mixed(stops, share) {
  const place = Math.max(0, Math.min(1, share)) * (stops.length - 1);
  const i = Math.min(Math.floor(place), stops.length - 2);
  return stops[i].map((low, k) => low + (stops[i + 1][k] - low) * (place - i));
}

/** @param {number[]} color */
export const css = (color) => `rgb(${color.map(Math.round).join(' ')})`;
