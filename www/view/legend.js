/**
 * What the colours of the surface mean.
 *
 * @import { State, TintName, Outcome } from '../types.js'
 */
import { percent, plain } from '../format.js';
import { t } from '../text/index.js';
import { css } from './colors.js';
import { h, say } from './dom.js';
import { scaleOf, tintsOf } from './tint.js';

/** Steps of the drawn scale. */
const STEPS = 9;
/** Excess is shown in micrometres. */
const MICRO = 1000;

/** Excess and gouges. */
const isMicro = (/** @type {TintName} */ tint) => tint === 'excess' || tint === 'gouge';
/** Places of a handle on the scale; the scale reaches further than the colours at first, so that these can be pulled apart. */
const PLACES = 200;
const BEYOND = 2;

/**
 * @param {HTMLElement} root
 * @param {{ onRange: (range: [number, number] | null) => void }} callbacks
 */
export function createLegend(root, { onRange }) {
  const handles = /** @type {const} */ (['low', 'high']).map((end) =>
    h('input', {
      type: 'range',
      min: 0,
      max: PLACES,
      name: `range-${end}`,
      'aria-label': t(`legend.${end}`),
      oninput: pull,
    }),
  );
  const reset = h(
    'button',
    { type: 'button', class: 'small', name: 'range-reset', onclick: () => onRange(null) },
    t('legend.reset'),
  );
  const range = h('details', { class: 'range' }, h('summary', {}, t('legend.range')), ...handles, reset);
  /** The scale that the handles stand on. @type {{ from: number, to: number, isSigned: boolean }} */
  let ground = { from: 0, to: 1, isSigned: false };
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
  const unknown = h('p', { class: 'unknown' }, h('i', {}), h('span', {}));
  const removing = h('p', { class: 'unknown', 'aria-live': 'polite' });
  root.append(
    h(
      'div',
      { class: 'legend', role: 'group', 'aria-label': t('legend.label') },
      scale,
      range,
      unknown,
      removing,
    ),
  );
  /** @type {{ outcome: Outcome | null, tint: TintName, range: State['range'], isRun: boolean }} */
  let shown = { outcome: null, tint: 'none', range: null, isRun: false };

  function pull() {
    const [low, high] = handles.map(
      ({ valueAsNumber }) => ground.from + ((ground.to - ground.from) * valueAsNumber) / PLACES,
    );
    const least = (ground.to - ground.from) / PLACES;
    // Around zero both ends are as far from it.
    if (ground.isSigned) onRange([-Math.max(high, least), Math.max(high, least)]);
    else onRange([Math.min(low, high - least), Math.max(high, low + least)]);
  }

  /** @param {{ low: number, high: number }} whole @param {{ low: number, high: number }} drawn */
  function place(whole, drawn) {
    const isSigned = whole.low < 0;
    const span = whole.high - whole.low || Math.abs(whole.high) || 1;
    ground = isSigned
      ? { from: 0, to: BEYOND * whole.high, isSigned }
      : { from: Math.max(0, whole.low - 0.5 * span), to: whole.high + 0.5 * span, isSigned };
    handles[0].hidden = isSigned;
    [drawn.low, drawn.high].forEach((value, k) => {
      if (handles[k] !== document.activeElement)
        handles[k].value = String(((value - ground.from) / (ground.to - ground.from)) * PLACES);
    });
  }

  return {
    /** @param {State} state */
    update({ outcome, layers: { tint }, range: pulled, at, removal, removing: share }) {
      removing.hidden = share === null || tint !== 'excess';
      if (share !== null) say(removing, t('legend.removing', { share: percent(share) }));
      const isRun = tint === 'excess' && at < 1 && removal?.outcome === outcome;
      if (shown.outcome === outcome && shown.tint === tint && shown.range === pulled && shown.isRun === isRun)
        return;
      shown = { outcome, tint, range: pulled, isRun };
      const whole = outcome && tintsOf(outcome).includes(tint) ? scaleOf(outcome, tint) : null;
      const drawn = whole && pulled ? { ...whole, low: pulled[0], high: pulled[1] } : whole;
      root.hidden = drawn === null;
      if (!drawn || !outcome) return;
      swatches.forEach((swatch, i) => {
        swatch.style.background = css(drawn.color((2 * i) / (STEPS - 1) - 1));
      });
      say(title, t(tint === 'gouge' ? 'legend.gouge.title' : `legend.${tint}`));
      if (whole) place(whole, drawn);
      reset.disabled = pulled === null;
      const isExcess = tint === 'excess';
      say(below, isExcess ? t('legend.gouge') : '');
      say(above, isExcess ? t('legend.left') : '');
      const [from, to] = [drawn.low, drawn.high].map((value) => value * (isMicro(tint) ? MICRO : 1));
      const signed = from < 0;
      const number = (/** @type {number} */ value) => plain(Number(value.toPrecision(3)));
      say(low, number(from));
      say(middle, signed ? '0' : number(0.5 * (from + to)));
      say(high, signed ? `+${number(to)}` : number(to));
      const verified = outcome.report.verified;
      const isPart = Boolean(verified?.excluded_area_mm2 || verified?.uncut_area_mm2);
      unknown.hidden = !isExcess || !(isRun || isPart);
      say(unknown.lastElementChild ?? unknown, t(isRun ? 'legend.stock' : 'legend.unknown'));
    },
  };
}
