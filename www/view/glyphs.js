/** Line drawings of the example surfaces, by id. */
import { s } from './dom.js';

/** @type {Record<string, string>} */
const PATHS = {
  wave: 'M4 21c6-12 12-12 18-6s10 6 16-3M10 27c6-12 12-12 18-6s10 6 16-3M16 33c6-12 12-12 18-6s10 6 16-3M4 21l12 12M22 15l12 12M38 12l12 12',
  blade: 'M8 32C12 20 24 10 48 8M10 36C18 28 30 20 50 20M14 38c10-4 22-6 34-4M8 32l6 6M22 17l7 18M48 8l0 26',
  lens: 'M4 16c5-7 43-7 48 0M4 16c3 18 45 18 48 0M4 16c9 6 39 6 48 0M28 10.500v20M15 12c1 6 2 11 4 17M41 12c-1 6-2 11-4 17M9 24c8 4 30 4 38 0',
};

/** @param {string} id */
export function glyph(id) {
  const d = PATHS[id] ?? 'M6 30 22 12 50 16 34 36zM14 21l28 5M11 25l28 7M30 13 18 33';
  return s('svg', { class: 'glyph', viewBox: '0 0 56 44', 'aria-hidden': 'true' }, s('path', { d }));
}
