/** Line drawings of the example surfaces, by id. */
import { s } from './dom.js';

/** @type {Record<string, string>} */
const PATHS = {
  wave: 'M4 21c6-12 12-12 18-6s10 6 16-3M10 27c6-12 12-12 18-6s10 6 16-3M16 33c6-12 12-12 18-6s10 6 16-3M4 21l12 12M22 15l12 12M38 12l12 12',
  blade: 'M8 32C12 20 24 10 48 8M10 36C18 28 30 20 50 20M14 38c10-4 22-6 34-4M8 32l6 6M22 17l7 18M48 8l0 26',
  dome: 'M6 30c4-24 40-24 44 0M6 30c0 9 44 9 44 0M28 12v25M17 15c-5 8-5 14-3 21M39 15c5 8 5 14 3 21M9 22c8 6 30 6 38 0',
  saddle:
    'M6 14c10 16 34 16 44 0M6 30c10 8 34 8 44 0M6 14v16M50 14v16M28 26c-4 2-6 6-6 12M28 26c4 2 6 6 6 12',
};

/** @param {string} id */
export function glyph(id) {
  const d = PATHS[id] ?? 'M6 30 22 12 50 16 34 36zM14 21l28 5M11 25l28 7M30 13 18 33';
  return s('svg', { class: 'glyph', viewBox: '0 0 56 44', 'aria-hidden': 'true' }, s('path', { d }));
}
