/**
 * What Z does: over one turn, and turn by turn.
 *
 * @import { State } from './types.js'
 */
import { plain } from '../format.js';
import { h, s, say } from '../view/dom.js';
import { t } from './text.js';

const SIZE = { width: 300, height: 132 };
const MARGIN = { top: 20, right: 10, bottom: 28, left: 50 };

/** Name of each plot, its unit, which of the numbers of a point it shows, and over which of them. */
const OVER_ANGLE = /** @type {const} */ ([
  ['z', 'mm', 2],
  ['velocity', 'mm/s', 3],
  ['acceleration', 'mm/s²', 4],
]);
const OVER_RADIUS = /** @type {const} */ ([
  ['stroke', 'mm', 2],
  ['peak', 'mm/s²', 4],
  ['jerk', 'mm/s³', 5],
]);

/**
 * @param {HTMLElement} root
 * @param {{ onRadius: (radius: number) => void }} callbacks
 */
export function createPlots(root, { onRadius }) {
  const slider = h('input', { type: 'range', min: 0, max: 1, step: 'any', name: 'radius' });
  slider.addEventListener('input', () => onRadius(slider.valueAsNumber));
  const label = h('span', {});
  /** @param {string} id @param {string} unit @param {string} over */
  const plot = (id, unit, over) => {
    const svg = s('svg', { viewBox: `0 0 ${SIZE.width} ${SIZE.height}`, role: 'img' });
    const title = `${t(`plot.${id}`)}, ${unit}`;
    svg.setAttribute('aria-label', title);
    root.append(h('figure', { 'data-plot': id }, h('figcaption', {}, title), svg));
    return (/** @type {number[]} */ x, /** @type {number[]} */ y) => draw(svg, x, y, over);
  };
  const angles = OVER_ANGLE.map(([id, unit]) => plot(id, unit, t('plot.angle')));
  const radii = OVER_RADIUS.map(([id, unit]) => plot(id, unit, t('plot.radius')));
  root.append(h('label', { class: 'turn' }, label, slider));
  /** @type {unknown[]} */
  let shown = [];

  return {
    /** @param {State} state */
    update({ outcome, motion, radius }) {
      if (outcome) {
        slider.max = String(outcome.report.outermost_mm);
        slider.value = String(radius);
        say(label, t('plot.turn', { radius: radius.toFixed(1) }));
      }
      if (shown[0] !== motion && motion) {
        const x = column(motion, 5, 0);
        for (const [i, [, , at]] of OVER_ANGLE.entries()) angles[i](x, column(motion, 5, at));
      }
      if (shown[1] !== outcome?.turns && outcome) {
        const x = column(outcome.turns, 6, 0);
        for (const [i, [, , at]] of OVER_RADIUS.entries()) radii[i](x, column(outcome.turns, 6, at));
      }
      shown = [motion, outcome?.turns];
    },
  };
}

/** @param {Float32Array} flat @param {number} stride @param {number} at */
function column(flat, stride, at) {
  return Array.from({ length: flat.length / stride }, (_, i) => flat[i * stride + at]);
}

/** @param {SVGSVGElement} svg @param {number[]} x @param {number[]} y @param {string} over */
function draw(svg, x, y, over) {
  const [left, right] = [Math.min(...x), Math.max(...x)];
  const low = Math.min(0, ...y);
  const high = Math.max(0, ...y);
  const [wide, tall] = [SIZE.width - MARGIN.left - MARGIN.right, SIZE.height - MARGIN.top - MARGIN.bottom];
  const px = (/** @type {number} */ v) => MARGIN.left + ((v - left) / (right - left || 1)) * wide;
  const py = (/** @type {number} */ v) => MARGIN.top + ((high - v) / (high - low || 1)) * tall;
  const points = x.map((v, i) => `${px(v).toFixed(1)},${py(y[i]).toFixed(1)}`).join(' ');
  const number = (/** @type {number} */ v) => plain(Number(v.toPrecision(3)));
  const mark = (/** @type {number} */ v) =>
    s('text', { x: MARGIN.left - 6, y: py(v) + 4, 'text-anchor': 'end' }, number(v));
  const foot = SIZE.height - MARGIN.bottom + 14;
  svg.replaceChildren(
    s('path', { class: 'axis', d: `M${MARGIN.left} ${py(0)}h${wide}` }),
    s('path', { class: 'grid', d: `M${MARGIN.left} ${py(high)}h${wide}M${MARGIN.left} ${py(low)}h${wide}` }),
    s('polyline', { points }),
    ...[low, high].filter((v, i, all) => i === 0 || v !== all[0]).map(mark),
    s('text', { x: MARGIN.left, y: foot }, number(left)),
    s('text', { x: SIZE.width - MARGIN.right, y: foot, 'text-anchor': 'end' }, number(right)),
    s('text', { class: 'name', x: MARGIN.left + wide / 2, y: foot, 'text-anchor': 'middle' }, over),
  );
}
