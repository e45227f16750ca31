/**
 * What the colours of the surface mean.
 *
 * @import { State, TintName, Outcome } from '../types.js'
 */
import { plain } from '../format.js';
import { t } from '../text/index.js';
import { css } from './colors.js';
import { h, say } from './dom.js';
import { scaleOf, tintsOf } from './tint.js';

/** Steps of the drawn scale. */
const STEPS = 9;
/** Excess is shown in micrometres. */
const MICRO = 1000;

/** @param {HTMLElement} root */
export function createLegend(root) {
  const [low, middle, high] = [h('span', {}), h('span', {}), h('span', {})];
  const [below, title, above] = [h('span', {}), h('strong', {}), h('span', {})];
  const swatches = Array.from({ length: STEPS }, () => h('i', {}));
  const scale = h(
    'div',
    { class: 'scale' },
    h('div', { class: 'ends' }, below, title, above),
    h('div', { class: 'ramp', 'aria-hidden': 'true' }, ...swatches),
    h('div', { class: 'ends numbers' }, low, middle, high),
  );
  const unknown = h('p', { class: 'unknown' }, h('i', {}), t('legend.unknown'));
  root.append(h('div', { class: 'legend', role: 'group', 'aria-label': t('legend.label') }, scale, unknown));
  /** @type {{ outcome: Outcome | null, tint: TintName }} */
  let shown = { outcome: null, tint: 'none' };

  return {
    /** @param {State} state */
    update({ outcome, layers: { tint } }) {
      if (shown.outcome === outcome && shown.tint === tint) return;
      shown = { outcome, tint };
      const drawn = outcome && tintsOf(outcome).includes(tint) ? scaleOf(outcome, tint) : null;
      root.hidden = drawn === null;
      if (!drawn || !outcome) return;
      swatches.forEach((swatch, i) => {
        swatch.style.background = css(drawn.color((2 * i) / (STEPS - 1) - 1));
      });
      say(title, t(`legend.${tint}`));
      const isExcess = tint === 'excess';
      say(below, isExcess ? t('legend.gouge') : '');
      say(above, isExcess ? t('legend.left') : '');
      const [from, to] = [drawn.low, drawn.high].map((value) => value * (isExcess ? MICRO : 1));
      const signed = from < 0;
      const number = (/** @type {number} */ value) => plain(Number(value.toPrecision(3)));
      say(low, number(from));
      say(middle, signed ? '0' : number(0.5 * (from + to)));
      say(high, signed ? `+${number(to)}` : number(to));
      const verified = outcome.report.verified;
      unknown.hidden = !isExcess || (!verified?.excluded_area_mm2 && !verified?.uncut_area_mm2);
    },
  };
}
