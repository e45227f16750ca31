/**
 * Stepover against tilt for the cutter and scallop height of the form, over a surface of a radius that can be set: what the
 * circle model promises beside what the cutter does.
 *
 * @import { State, Stepovers } from '../types.js'
 */
import { length, micron, percent, plain } from '../format.js';
import { t } from '../text/index.js';
import { drawChart } from './chart.js';
import { attribute, h, icon, s, say } from './dom.js';

/** Curves in the order in which they are drawn, with the list of the planner that holds each. */
const CURVES = /** @type {const} */ ([
  ['lateral', 'lateral_mm'],
  ['circle', 'circle_mm'],
  ['lead', 'lead_mm'],
  ['two', 'two_contact_mm'],
]);
const SHAPES = /** @type {const} */ (['plane', 'hollow', 'ridge']);
/** Below this tilt a flat bottom finishes so much at once that all else would be small beside it. */
const STEEP_BELOW = 1;
/** Tilts of the table, degrees. */
const ROWS = 5;

/** @typedef {(typeof CURVES)[number][0]} CurveName */

/**
 * @param {HTMLElement} root
 * @param {{ onClose: () => void, onRadius: (radius: number) => void }} callbacks A radius in millimetres is above 0 for a
 *   hollow, below 0 for a ridge, 0 for a plane.
 */
export function createStepoverChart(root, { onClose, onRadius }) {
  const shape = h(
    'select',
    { name: 'chart.shape', onchange: choose },
    ...SHAPES.map((name) => h('option', { value: name }, t(`chart.shape.${name}`))),
  );
  const radius = h('input', {
    type: 'number',
    name: 'chart.radius',
    min: 0.1,
    step: 5,
    inputmode: 'decimal',
    autocomplete: 'off',
    oninput: choose,
  });
  const radiusRow = h(
    'label',
    { class: 'field number' },
    h('span', {}, t('chart.radius')),
    h('span', { class: 'value' }, radius, h('span', { class: 'unit' }, t('unit.mm'))),
  );
  const about = h('p', { class: 'help' });
  const svg = s('svg', {
    role: 'img',
    'aria-label': t('chart.label'),
    onpointerdown: drag,
    onpointermove: drag,
  });
  const slider = h('input', {
    type: 'range',
    name: 'chart.at',
    min: 0,
    step: 1,
    'aria-label': t('chart.at'),
    oninput: () => look(slider.valueAsNumber),
  });
  const readout = h('output', {});
  const legend = h('dl', { class: 'curves' });
  const notes = h('ul', { class: 'help' });
  const table = h('table', {});
  const empty = h('p', { class: 'help' });
  const frame = h('div', { class: 'frame' }, svg);
  const picture = h(
    'div',
    { class: 'picture' },
    frame,
    h('div', { class: 'at' }, h('span', { 'aria-hidden': 'true' }, t('chart.at')), slider, readout),
    legend,
    notes,
    h('details', {}, h('summary', {}, t('chart.table')), h('div', { class: 'scroll' }, table)),
  );
  const dialog = h(
    'dialog',
    { class: 'chart', 'aria-labelledby': 'chart-title', onclose: onClose },
    h(
      'div',
      { class: 'head' },
      h('h2', { id: 'chart-title' }, t('chart.title')),
      about,
      h(
        'button',
        { type: 'button', class: 'quiet', 'aria-label': t('action.close'), onclick: () => dialog.close() },
        icon('close'),
      ),
    ),
    h(
      'div',
      { class: 'surface' },
      h('label', { class: 'field wide' }, h('span', {}, t('chart.shape')), shape),
      radiusRow,
    ),
    empty,
    picture,
  );
  root.append(dialog);

  /** @type {Stepovers | null} */
  let shown = null;
  /** Where the upright line stands, degrees. */
  let tilt = 0;
  let toTilt = (/** @type {number} */ pixels) => pixels;
  new ResizeObserver(() => draw()).observe(frame);

  function choose() {
    const size = radius.valueAsNumber;
    const isPlane = shape.value === 'plane';
    const isWrong = !isPlane && !(size > 0);
    radiusRow.hidden = isPlane;
    radiusRow.classList.toggle('wrong', isWrong);
    attribute(radius, 'aria-invalid', isWrong ? 'true' : null);
    if (isPlane) onRadius(0);
    else if (!isWrong) onRadius(shape.value === 'ridge' ? -size : size);
  }

  /** @param {PointerEvent} event */
  function drag(event) {
    if (event.buttons === 0 || !shown) return;
    look(nearest(shown.curves[0].tilt_deg, toTilt(event.clientX - svg.getBoundingClientRect().left)));
  }

  /** @param {number} index */
  function look(index) {
    if (!shown) return;
    tilt = shown.curves[0].tilt_deg[index];
    draw();
  }

  function draw() {
    if (!shown || !dialog.open || frame.clientWidth === 0) return;
    const [own, plane] = shown.curves;
    const index = nearest(own.tilt_deg, tilt);
    const lines = CURVES.map(([name, list]) => ({ name, x: own.tilt_deg, y: own[list] }));
    const isCurved = own.radius_mm !== null;
    if (isCurved) lines.unshift({ name: /** @type {any} */ ('plane'), x: plane.tilt_deg, y: plane.lead_mm });
    const dots = lines.flatMap(({ name, x, y }) => {
      const i = nearest(x, tilt);
      const value = y[i];
      return value === null ? [] : [{ name, x: x[i], y: value }];
    });
    const width = frame.clientWidth;
    toTilt = drawChart(svg, {
      width,
      height: Math.min(Math.max(Math.round(0.52 * width), 240), 380),
      x: { most: own.tilt_deg[own.tilt_deg.length - 1], step: 5, label: t('chart.tilt') },
      y: { most: highest(shown), label: t('chart.stepover') },
      lines,
      at: tilt,
      dots,
    });
    slider.max = String(own.tilt_deg.length - 1);
    slider.value = String(index);
    attribute(slider, 'aria-valuetext', degrees(tilt));
    say(readout, degrees(tilt));
    // On a plane and a ridge there are no two contacts, and of some cutters no lateral curve.
    const rows = [...CURVES].reverse().filter(([, list]) => own[list].some((value) => value !== null));
    legend.replaceChildren(
      ...rows.map(([name, list]) => row(name, valueText(name, own[list][index]), excessOf(name, index))),
      ...(isCurved
        ? [row('plane', valueText('plane', plane.lead_mm[nearest(plane.tilt_deg, tilt)]), '')]
        : []),
    );
  }

  /** By how much the circle model promises more than there is. @param {CurveName} name @param {number} index */
  function excessOf(name, index) {
    if (!shown || name !== 'circle') return '';
    const { circle_mm: circle, lead_mm: lead } = shown.curves[0];
    const [promised, true_] = [circle[index], lead[index]];
    if (promised === null || true_ === null) return '';
    return t(promised >= true_ ? 'chart.over' : 'chart.under', {
      share: percentOf(Math.abs(promised / true_ - 1)),
    });
  }

  /** @param {CurveName | 'plane'} name @param {number | null} value */
  function valueText(name, value) {
    if (value !== null) return length(value);
    const matching = shown?.curves[0].matching_deg ?? null;
    const isBelow = matching === null || tilt < matching;
    if (name === 'lead' && isBelow) return t('chart.gouges');
    return name === 'circle' ? t('chart.diverges') : '–';
  }

  /** @param {Stepovers} stepovers */
  function describe({ curves: [own] }) {
    const { widest, matching_deg: matching, radius_mm: size } = own;
    const lines = [
      t('chart.note.circle'),
      size !== null && size > 0 && matching === null && t('chart.note.narrow'),
      size !== null &&
        size > 0 &&
        matching !== null &&
        matching > 0 &&
        t('chart.note.matching', { tilt: degrees(matching) }),
      widest &&
        t('chart.note.widest', {
          width: length(widest.stepover_mm),
          tilt: degrees(widest.lead_deg),
          lift: micron(widest.lift_mm),
        }),
    ];
    notes.replaceChildren(
      ...lines.filter((line) => line).map((line) => h('li', {}, /** @type {string} */ (line))),
    );
    const used = CURVES.filter(([, list]) => own[list].some((value) => value !== null)).reverse();
    const keys = own.tilt_deg.flatMap((deg, i) =>
      deg % ROWS === 0 || deg === matching || deg === widest?.lead_deg ? [i] : [],
    );
    table.replaceChildren(
      h('caption', {}, t('chart.stepover')),
      h(
        'thead',
        {},
        h(
          'tr',
          {},
          h('th', { scope: 'col' }, t('chart.tilt')),
          ...used.map(([name]) => h('th', { scope: 'col' }, t(`chart.curve.${name}`))),
        ),
      ),
      h(
        'tbody',
        {},
        ...keys.map((i) =>
          h(
            'tr',
            {},
            h('th', { scope: 'row' }, degrees(own.tilt_deg[i])),
            ...used.map(([, list]) => h('td', {}, own[list][i]?.toFixed(3) ?? '–')),
          ),
        ),
      ),
    );
  }

  return {
    /** @param {State} state */
    update({ chart, draft }) {
      if (!chart.isOpen) {
        if (dialog.open) dialog.close();
        return;
      }
      const { stepovers } = chart;
      const wasOpen = dialog.open;
      if (!wasOpen) {
        const lead = draft?.spec.strategy?.lead_deg;
        tilt = typeof lead === 'number' ? lead : 0;
        shape.value = chart.radius === 0 ? 'plane' : chart.radius > 0 ? 'hollow' : 'ridge';
        radius.value = String(Math.abs(chart.radius) || 50);
        radiusRow.hidden = chart.radius === 0;
        dialog.showModal();
      }
      empty.hidden = stepovers !== null;
      picture.hidden = stepovers === null;
      say(empty, t(chart.hasFailed ? 'chart.failed' : 'chart.waiting'));
      if (!stepovers || (stepovers === shown && wasOpen)) return;
      shown = stepovers;
      say(
        about,
        t('chart.about', { cutter: cutterText(draft?.spec.cutter), scallop: micron(stepovers.scallop_mm) }),
      );
      describe(stepovers);
      draw();
    },
  };
}

/** @param {CurveName | 'plane'} name @param {string} value @param {string} more */
function row(name, value, more) {
  return h(
    'div',
    { class: name },
    h(
      'dt',
      {},
      s('svg', { viewBox: '0 0 26 8', 'aria-hidden': 'true' }, s('path', { d: 'M0 4h26' })),
      t(`chart.curve.${name}`),
    ),
    h('dd', {}, more && h('small', {}, more), value),
  );
}

/** The end of the upright axis: just above what the cutter finishes. @param {Stepovers} stepovers */
function highest({ curves: [own, plane] }) {
  const steady = [
    { x: own.tilt_deg, y: own.lead_mm },
    { x: own.tilt_deg, y: own.lateral_mm },
    { x: plane.tilt_deg, y: plane.lead_mm },
  ].flatMap(({ x, y }) => y.filter((_, i) => x[i] >= STEEP_BELOW));
  return 1.1 * Math.max(own.widest?.stepover_mm ?? 0, ...steady.map((value) => value ?? 0), 1e-6);
}

/** The index of the number closest to `value` in a rising list. @param {number[]} list @param {number} value */
function nearest(list, value) {
  let best = 0;
  for (let i = 1; i < list.length; i += 1) {
    if (Math.abs(list[i] - value) < Math.abs(list[best] - value)) best = i;
  }
  return best;
}

/** @param {number} value */
const degrees = (value) => `${plain(Number(value.toFixed(2)))}°`;

/** @param {number} share */
const percentOf = (share) => (share < 1 ? percent(share) : `${plain(Number((share * 100).toFixed(0)))} %`);

/** @param {any} cutter */
function cutterText(cutter) {
  if (!cutter) return '';
  const corner = cutter.corner_radius_mm;
  return `⌀ ${plain(cutter.diameter_mm)}${corner > 0 ? `, r ${plain(corner)}` : ''}`;
}
