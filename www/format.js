/** Numbers for people, each with its unit. */
import { t } from './text/index.js';
import { isInch, shownIn } from './units.js';

const SPACE = ' ';

/** @param {number} value @param {number} digits */
function fixed(value, digits) {
  return new Intl.NumberFormat(t('locale'), { minimumFractionDigits: digits, maximumFractionDigits: digits })
    .format(value)
    .replace(/^-/, '−');
}

/** A number without needless zeros. @param {number} value */
export function plain(value) {
  return new Intl.NumberFormat(t('locale'), { maximumSignificantDigits: 7 }).format(value).replace(/^-/, '−');
}

/** @param {number} value @param {string} unit Of the value; it is shown in whichever unit people chose. */
function withUnit(value, unit) {
  const [factor, shown] = shownIn(unit);
  const number = value * factor;
  const size = Math.abs(number);
  // An inch is long: it takes two digits more.
  const more = isInch ? 2 : 0;
  return `${fixed(number, size >= 1000 ? 0 : size >= 10 ? 1 : 2 + more)}${SPACE}${shown}`;
}

/** @param {number} mm */
export const length = (mm) => withUnit(mm, 'mm');

/** @param {number} mmPerMin */
export const feed = (mmPerMin) => {
  const [factor, unit] = shownIn('mm/min');
  return `${fixed(mmPerMin * factor, isInch ? 1 : 0)}${SPACE}${unit}`;
};

/** @param {number} value */
export const degrees = (value) => `${fixed(value, 1)}°`;

/** @param {number} mm2 */
export const area = (mm2) => withUnit(mm2, 'mm²');

/** Millimetres as micrometres, or as millionths of an inch. @param {number} mm */
export function micron(mm) {
  if (isInch) return `${fixed(Math.abs(mm) < 5e-6 ? 0 : (mm / 25.4) * 1e6, 0)}${SPACE}µin`;
  const um = mm * 1000;
  const digits = Math.abs(um) >= 100 ? 0 : Math.abs(um) >= 1 ? 1 : 2;
  return `${fixed(Math.abs(um) < 0.005 ? 0 : um, digits)}${SPACE}µm`;
}

/** @param {number} value */
export const count = (value) => fixed(value, 0);

/** A share from 0 to 1; all is said only of all. @param {number} share */
export function percent(share) {
  const value = share < 1 ? Math.min(share * 100, 99.99) : 100;
  return `${fixed(value, value === 100 || value < 10 ? 0 : value > 99.9 ? 2 : 1)}${SPACE}%`;
}

/** @param {number} seconds */
export function seconds(seconds) {
  if (seconds < 0.1) return `${fixed(seconds * 1000, 0)}${SPACE}ms`;
  if (seconds < 100) return `${fixed(seconds, seconds < 10 ? 2 : 1)}${SPACE}s`;
  return minutes(seconds / 60);
}

/** @param {number} minutes */
export function minutes(minutes) {
  const total = Math.round(minutes * 60);
  const h = Math.floor(total / 3600);
  const m = Math.floor((total % 3600) / 60);
  const s = total % 60;
  if (h > 0) return `${h}${SPACE}h ${m}${SPACE}min`;
  return m > 0 ? `${m}${SPACE}min ${s}${SPACE}s` : `${s}${SPACE}s`;
}

/** @param {number} count */
export function bytes(count) {
  if (count < 1000) return `${fixed(count, 0)}${SPACE}B`;
  return count < 1e6
    ? `${fixed(count / 1e3, 0)}${SPACE}kB`
    : `${fixed(count / 1e6, count < 1e8 ? 1 : 0)}${SPACE}MB`;
}

/** Three edges of a box, of millimetres in metres where it is that large. @param {[number[], number[]]} bounds @param {string} unit */
export function box([low, high], unit) {
  const edges = low.map((from, i) => high[i] - from);
  const inMetres = unit === 'mm' && Math.max(...edges) >= 10_000;
  const text = edges.map((edge) => shortened(inMetres ? edge / 1000 : edge)).join(' × ');
  return `${text}${SPACE}${inMetres ? 'm' : unit}`;
}

/** About three digits. @param {number} value */
function shortened(value) {
  return value >= 100
    ? fixed(value, 0)
    : new Intl.NumberFormat(t('locale'), { maximumSignificantDigits: 3 }).format(value);
}
