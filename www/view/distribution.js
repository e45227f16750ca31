/**
 * Median, 95 %, 99 % and largest excess on one line, against the limit.
 *
 * @import { Verified } from '../types.js'
 */
import { micron } from '../format.js';
import { t } from '../text/index.js';
import { h, s } from './dom.js';

const WIDTH = 280;
const BAR = { y: 22, height: 10 };

/** @param {Verified} verified @param {number} limit Millimetres. */
export function createDistribution(verified, limit) {
  // What half, 95 or 99 % of the area do not exceed is unknown where that much was not cut.
  const largest = verified.largest_excess_mm ?? 0;
  const q99 = verified.q99_mm ?? largest;
  const q95 = verified.q95_mm ?? q99;
  const median = verified.median_mm ?? q95;
  const most = Math.max(largest, limit) * 1.06 || 1;
  const at = (/** @type {number} */ mm) => (Math.max(0, Math.min(mm, most)) / most) * WIDTH;
  const { y, height } = BAR;
  const bar = (/** @type {number} */ from, /** @type {number} */ to, /** @type {string} */ name) =>
    s('rect', { class: name, x: at(from), y, width: Math.max(at(to) - at(from), 0.5), height });
  /** @type {[string, number][]} */
  const marks = [
    ['median', median],
    ['q95', q95],
    ['q99', q99],
    ['largest', largest],
  ];
  const limitAt = at(limit);
  const text = marks.map(([id, mm]) => `${t(`results.${id}`)} ${micron(mm)}`).join(', ');
  const drawing = s(
    'svg',
    { class: 'distribution', viewBox: `0 0 ${WIDTH} 40`, role: 'img', 'aria-label': text },
    s('rect', { class: 'ground', x: 0, y, width: WIDTH, height }),
    bar(0, median, 'half'),
    bar(median, q95, 'most'),
    bar(q95, q99, 'nearly'),
    bar(q99, largest, 'all'),
    s('path', { class: 'limit', d: `M${limitAt} ${y - 5}v${height + 10}` }),
    s(
      'text',
      { x: limitAt, y: y - 9, 'text-anchor': limitAt > WIDTH / 2 ? 'end' : 'start' },
      t('results.limit', { limit: micron(limit) }),
    ),
  );
  const key = marks.map(([id, mm], i) =>
    h(
      'span',
      { class: ['half', 'most', 'nearly', 'all'][i] },
      h('i', {}),
      h('span', {}, t(`results.${id}`)),
      h('b', {}, micron(mm)),
    ),
  );
  return h(
    'figure',
    {},
    h('figcaption', {}, t('results.distribution')),
    drawing,
    h('div', { class: 'key', 'aria-hidden': 'true' }, ...key),
  );
}
