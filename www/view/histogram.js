/** How the area is spread over the excess that is left on it. */
import { micron, percent } from '../format.js';
import { t } from '../text/index.js';
import { h, s } from './dom.js';

const WIDTH = 280;
const HEIGHT = 72;
const FOOT = 16;
/** Rows of the table; each stands for several bars. */
const ROWS = 10;

/** @param {Float32Array} histogram Where the first bar begins and the last ends (mm), then the area of each (mm²). @param {number} limit mm */
export function createHistogram(histogram, limit) {
  const [low, high] = histogram;
  const areas = [...histogram.subarray(2)];
  const whole = areas.reduce((sum, area) => sum + area, 0) || 1;
  const most = Math.max(...areas) || 1;
  const at = (/** @type {number} */ mm) => ((mm - low) / (high - low)) * WIDTH;
  const wide = WIDTH / areas.length;
  const tall = HEIGHT - FOOT;
  const share = (/** @type {number} */ from, /** @type {number} */ to) =>
    areas.slice(from, to).reduce((sum, area) => sum + area, 0) / whole;
  const edge = (/** @type {number} */ bar) => low + ((high - low) * bar) / areas.length;
  const rows = Array.from({ length: ROWS }, (_, i) => (i * areas.length) / ROWS);
  const step = areas.length / ROWS;
  return h(
    'figure',
    { class: 'histogram' },
    h('figcaption', {}, t('results.histogram')),
    s(
      'svg',
      { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, role: 'img', 'aria-label': t('results.histogram.label') },
      ...areas.map((area, i) =>
        s('rect', {
          class: edge(i + 1) <= 0 ? 'gouge' : edge(i) >= limit ? 'over' : 'bar',
          x: (i * wide).toFixed(2),
          y: (tall * (1 - area / most)).toFixed(2),
          width: Math.max(wide - 0.8, 0.4).toFixed(2),
          height: ((tall * area) / most).toFixed(2),
        }),
      ),
      s('path', { class: 'limit', d: `M0 ${tall}H${WIDTH}M${at(limit).toFixed(1)} 0V${tall + 4}` }),
      s('text', { x: 0, y: HEIGHT - 3 }, micron(low)),
      s('text', { x: WIDTH, y: HEIGHT - 3, 'text-anchor': 'end' }, micron(high)),
    ),
    h(
      'details',
      {},
      h('summary', {}, t('chart.table')),
      h(
        'table',
        {},
        h(
          'thead',
          {},
          h(
            'tr',
            {},
            h('th', { scope: 'col' }, t('results.distribution')),
            h('th', { scope: 'col' }, t('results.share')),
          ),
        ),
        h(
          'tbody',
          {},
          ...rows.map((from) =>
            h(
              'tr',
              {},
              h('th', { scope: 'row' }, `${micron(edge(from))} … ${micron(edge(from + step))}`),
              h('td', {}, percent(share(from, from + step))),
            ),
          ),
        ),
      ),
    ),
  );
}
