/**
 * What the colours and lines of the picture mean.
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
  const lines = h('ul', { class: 'lines' });
  const items = ['pass', 'link', 'rapid', 'zone', 'unknown'].map((id) => {
    const item = h('li', { class: id }, h('i', {}), t(`legend.${id}`));
    lines.append(item);
    return item;
  });
  root.append(h('div', { class: 'legend', role: 'group', 'aria-label': t('legend.label') }, scale, lines));

  return {
    /** @param {State} state */
    update({ outcome, layers }) {
      const verified = outcome?.report.verified ?? null;
      root.hidden = outcome === null;
      scale.hidden = !verified || !layers.excess;
      const range = outcome ? excessRange(outcome.report) * 1000 : 0;
      say(low, `−${plain(range)}`);
      say(high, `+${plain(range)}`);
      const [pass, link, rapid, zone, unknown] = items;
      pass.hidden = !layers.passes;
      link.hidden = !layers.links || !outcome?.report.length.link_mm;
      rapid.hidden = !layers.links || !outcome?.report.length.rapid_mm;
      zone.hidden = !layers.zones || !outcome?.zones.length;
      unknown.hidden = scale.hidden || !outcome?.report.verified?.excluded_area_mm2;
    },
  };
}
