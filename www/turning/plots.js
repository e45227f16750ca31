/**
 * What an axis does: over one turn, and turn by turn.
 *
 * @import { State, AxisName } from './types.js'
 */
import { plain } from '../format.js';
import { attribute, h, s, say } from '../view/dom.js';
import { t } from './text.js';

const SIZE = { width: 232, height: 128 };
const MARGIN = { top: 14, right: 8, bottom: 26, left: 48 };

/** The axes in the order of the planner's numbers, and their unit. @type {[AxisName, string][]} */
const AXES = [
  ['z', 'mm'],
  ['x', 'mm'],
  ['c', '°'],
];
/** Where an axis' numbers begin, in units of four. @type {Record<AxisName, number>} */
const ORDER = { x: 0, z: 1, c: 2 };
/** Plots over the angle and over the distance from the axis: in the order of the planner's numbers. */
const OVER_ANGLE = ['position', 'velocity', 'acceleration', 'jerk'];
const OVER_RADIUS = ['stroke', 'most-velocity', 'most-acceleration', 'most-jerk'];
const PER = ['', '/s', '/s²', '/s³'];
/** Numbers a point and a turn, and how many of them come before the axes. */
const MOTION = { stride: 13, first: 1 };
const TURNS = { stride: 14, first: 2 };

/**
 * @param {HTMLElement} root
 * @param {{ onRadius: (radius: number) => void, onAxis: (axis: AxisName) => void }} callbacks
 */
export function createPlots(root, { onRadius, onAxis }) {
  const slider = h('input', { type: 'range', min: 0, max: 1, step: 'any', name: 'radius' });
  slider.addEventListener('input', () => onRadius(slider.valueAsNumber));
  const label = h('span', {});
  const buttons = AXES.map(([name]) => {
    const onclick = () => onAxis(name);
    const button = h(
      'button',
      { type: 'button', class: 'small', 'data-axis': name, onclick },
      name.toUpperCase(),
    );
    return { name, button };
  });
  const group = h('div', { class: 'switch', role: 'group' }, ...buttons.map(({ button }) => button));
  attribute(group, 'aria-label', t('plot.axis'));
  root.append(h('div', { class: 'turn' }, group, h('label', {}, label, slider)));
  const angles = OVER_ANGLE.map((id) => createPlot(root, id));
  const radii = OVER_RADIUS.map((id) => createPlot(root, id));
  /** @type {unknown[]} */
  let shown = [];

  return {
    /** @param {State} state */
    update({ outcome, motion, radius, axis }) {
      for (const { name, button } of buttons) attribute(button, 'aria-pressed', String(name === axis));
      if (!outcome || !motion) return;
      slider.min = String(outcome.report.innermost_mm);
      slider.max = String(outcome.report.outermost_mm);
      slider.value = String(radius);
      say(label, t('plot.turn', { radius: radius.toFixed(1) }));
      if (shown[0] === motion && shown[1] === outcome.turns && shown[2] === axis) return;
      shown = [motion, outcome.turns, axis];
      const unit = AXES.find(([name]) => name === axis)?.[1] ?? '';
      const names = { axis: axis.toUpperCase() };
      const limits = Object.values(outcome.report[axis]).map(({ limit }) => limit);
      for (const [k, per] of PER.entries()) {
        const first = 4 * ORDER[axis] + k;
        const limit = k > 0 ? limits[k - 1] : Infinity;
        const angle = column(motion, MOTION, first);
        angles[k]({ ...names, unit: unit + per }, column(motion, MOTION, -1), angle, limit, t('plot.angle'));
        const most = column(outcome.turns, TURNS, first);
        radii[k](
          { ...names, unit: unit + per },
          column(outcome.turns, TURNS, -2),
          most,
          limit,
          t('plot.radius'),
        );
      }
    },
  };
}

/** @param {Float32Array} flat @param {{ stride: number, first: number }} form @param {number} at Seen from the first axis. */
function column(flat, { stride, first }, at) {
  return Array.from({ length: flat.length / stride }, (_, i) => flat[i * stride + first + at]);
}

/** @param {number} v */
const number = (v) => plain(Number(v.toPrecision(3)));

/**
 * A plot whose values can be read off with a pointer.
 *
 * @param {HTMLElement} root
 * @param {string} id
 */
function createPlot(root, id) {
  const svg = s('svg', { viewBox: `0 0 ${SIZE.width} ${SIZE.height}`, role: 'img' });
  const caption = h('span', {});
  const reading = h('output', {});
  root.append(h('figure', { 'data-plot': id }, h('figcaption', {}, caption, reading), svg));
  /** What is drawn, and how a pointer finds it. @type {{ x: number[], y: number[], at: (share: number) => number, dot: (i: number) => SVGElement } | null} */
  let drawn = null;
  /** @type {SVGElement | null} */
  let dot = null;

  function leave() {
    dot?.remove();
    say(reading, '');
  }
  svg.addEventListener('pointerleave', leave);
  svg.addEventListener('pointermove', ({ clientX }) => {
    if (!drawn || drawn.x.length === 0) return;
    const { left, width } = svg.getBoundingClientRect();
    const wanted = drawn.at(((clientX - left) / width) * SIZE.width);
    const { x, y } = drawn;
    const i = x.reduce((best, v, k) => (Math.abs(v - wanted) < Math.abs(x[best] - wanted) ? k : best), 0);
    leave();
    dot = drawn.dot(i);
    svg.append(dot);
    say(reading, `${number(x[i])}: ${number(y[i])}`);
  });

  /** @param {Record<string, string>} places @param {number[]} x @param {number[]} y @param {number} limit @param {string} over */
  return (places, x, y, limit, over) => {
    say(caption, t(`plot.${id}`, places));
    attribute(svg, 'aria-label', t(`plot.${id}`, places));
    leave();
    drawn = draw(svg, x, y, limit, over);
  };
}

/** Below this share of the range of a plot, what is left of rounding is no motion. */
const NOTHING = 1e-9;

/** @param {SVGSVGElement} svg @param {number[]} x @param {number[]} y @param {number} limit @param {string} over */
function draw(svg, x, y, limit, over) {
  const [left, right] = [Math.min(...x), Math.max(...x)];
  const size = Math.max(...y.map(Math.abs));
  const flat = size < NOTHING;
  const low = flat ? 0 : Math.min(0, ...y);
  const high = flat ? 1 : Math.max(0, ...y);
  const [wide, tall] = [SIZE.width - MARGIN.left - MARGIN.right, SIZE.height - MARGIN.top - MARGIN.bottom];
  const px = (/** @type {number} */ v) => MARGIN.left + ((v - left) / (right - left || 1)) * wide;
  const py = (/** @type {number} */ v) => MARGIN.top + ((high - v) / (high - low || 1)) * tall;
  const points = x.map((v, i) => `${px(v).toFixed(1)},${py(y[i]).toFixed(1)}`).join(' ');
  const mark = (/** @type {number} */ v) =>
    s('text', { x: MARGIN.left - 6, y: py(v) + 4, 'text-anchor': 'end' }, number(v));
  const foot = SIZE.height - MARGIN.bottom + 14;
  // A limit that the axis comes near to is drawn where it is.
  const near = [limit, -limit].filter((v) => v <= 1.02 * high && v >= 1.02 * low);
  svg.replaceChildren(
    s('path', { class: 'axis', d: `M${MARGIN.left} ${py(0)}h${wide}` }),
    s('path', { class: 'grid', d: `M${MARGIN.left} ${py(high)}h${wide}M${MARGIN.left} ${py(low)}h${wide}` }),
    ...near.map((v) => s('path', { class: 'limit', d: `M${MARGIN.left} ${py(v)}h${wide}` })),
    s('polyline', { points }),
    ...(flat ? [0] : [low, high]).filter((v, i, all) => i === 0 || v !== all[0]).map(mark),
    s('text', { x: MARGIN.left, y: foot }, number(left)),
    s('text', { x: SIZE.width - MARGIN.right, y: foot, 'text-anchor': 'end' }, number(right)),
    s('text', { class: 'name', x: MARGIN.left + wide / 2, y: foot, 'text-anchor': 'middle' }, over),
  );
  return {
    x,
    y,
    at: (/** @type {number} */ place) => left + ((place - MARGIN.left) / wide) * (right - left),
    dot: (/** @type {number} */ i) => s('circle', { cx: px(x[i]), cy: py(y[i]), r: 3 }),
  };
}
