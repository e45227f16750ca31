/**
 * What the colours of the surface mean.
 *
 * @import { State } from '../types.js'
 */
import { plain } from '../format.js';
import { t } from '../text/index.js';
import { excessCss, excessRange } from './colors.js';
import { h, say } from './dom.js';

/** Steps of the drawn scale. */
const STEPS = 9;

/** @param {HTMLElement} root */
export function createLegend(root) {
  const low = h('span', {});
  const high = h('span', {});
  const swatches = Array.from({ length: STEPS }, () => h('i', {}));
  swatches.forEach((swatch, i) => {
    swatch.style.background = excessCss((2 * i) / (STEPS - 1) - 1);
  });
  const scale = h(
    'div',
    { class: 'scale' },
    h(
      'div',
      { class: 'ends' },
      h('span', {}, t('legend.gouge')),
      h('strong', {}, t('legend.excess')),
      h('span', {}, t('legend.left')),
    ),
    h('div', { class: 'ramp', 'aria-hidden': 'true' }, ...swatches),
    h('div', { class: 'ends numbers' }, low, h('span', {}, '0'), high),
  );
  const unknown = h('p', { class: 'unknown' }, h('i', {}), t('legend.unknown'));
  root.append(h('div', { class: 'legend', role: 'group', 'aria-label': t('legend.label') }, scale, unknown));

  return {
    /** @param {State} state */
    update({ outcome, layers }) {
      const verified = outcome?.report.verified ?? null;
      root.hidden = !verified || !layers.excess;
      const range = outcome ? excessRange(outcome.report) * 1000 : 0;
      say(low, `−${plain(range)}`);
      say(high, `+${plain(range)}`);
      unknown.hidden = !verified?.excluded_area_mm2 && !verified?.uncut_area_mm2;
    },
  };
}
