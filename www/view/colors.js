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

/** Where the excess was not verified. */
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
export function excessColor(value) {
  const place = ((Math.max(-1, Math.min(1, value)) + 1) / 2) * (STOPS.length - 1);
  const i = Math.min(Math.floor(place), STOPS.length - 2);
  const share = place - i;
  return STOPS[i].map((low, k) => low + (STOPS[i + 1][k] - low) * share);
}

/** @param {number} value */
export function excessCss(value) {
  return `rgb(${excessColor(value).map(Math.round).join(' ')})`;
}
