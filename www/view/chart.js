/** Lines over two axes, drawn as large as there is room. */
import { plain } from '../format.js';
import { s } from './dom.js';
import { niceTicks, ticks } from './ticks.js';

const MARGIN = { top: 30, right: 14, bottom: 42, left: 44 };
/** Room that a number on an axis wants, in pixels. */
const TICK = { x: 64, y: 44 };

/**
 * @typedef {{ name: string, x: number[], y: (number | null)[] }} Line A gap where `y` is null; `name` is its class.
 * @typedef {{ width: number, height: number, x: { most: number, step: number, label: string },
 *   y: { most: number, label: string }, lines: Line[], at: number,
 *   dots: { name: string, x: number, y: number }[] }} Drawing
 * `at` is where the upright line stands, in units of x.
 */

/**
 * Fills `svg`; returns which x belongs to a distance from its left edge, in pixels.
 *
 * @param {SVGSVGElement} svg
 * @param {Drawing} drawing
 */
export function drawChart(svg, { width, height, x, y, lines, at, dots }) {
  const inner = { width: width - MARGIN.left - MARGIN.right, height: height - MARGIN.top - MARGIN.bottom };
  const left = (/** @type {number} */ value) => (value / x.most) * inner.width;
  const top = (/** @type {number} */ value) => inner.height - (value / y.most) * inner.height;
  const path = (/** @type {Line} */ line) => {
    let isDown = false;
    let d = '';
    for (let i = 0; i < line.x.length; i += 1) {
      const value = line.y[i];
      if (value !== null) {
        d += `${isDown ? 'L' : 'M'}${left(line.x[i]).toFixed(2)} ${top(value).toFixed(2)}`;
      }
      isDown = value !== null;
    }
    return s('path', { class: line.name, d });
  };
  const upright = left(at).toFixed(2);
  svg.setAttribute('viewBox', `0 0 ${width} ${height}`);
  svg.setAttribute('width', String(width));
  svg.setAttribute('height', String(height));
  svg.replaceChildren(
    s(
      'g',
      { class: 'grid', transform: `translate(${MARGIN.left} ${MARGIN.top})` },
      ...niceTicks([0, y.most], inner.height / TICK.y).flatMap((value) => [
        s('path', { class: value === 0 ? 'axis' : null, d: `M0 ${top(value).toFixed(2)}H${inner.width}` }),
        s('text', { x: -8, y: top(value) + 4, 'text-anchor': 'end' }, plain(value)),
      ]),
      ...ticks([0, x.most], x.step * Math.ceil(x.most / x.step / (inner.width / TICK.x))).flatMap((value) => [
        s('path', { class: value === 0 ? 'axis' : null, d: `M${left(value).toFixed(2)} 0v${inner.height}` }),
        s('text', { x: left(value), y: inner.height + 18, 'text-anchor': 'middle' }, plain(value)),
      ]),
      s('text', { class: 'name', x: 8 - MARGIN.left, y: -14 }, y.label),
      s(
        'text',
        { class: 'name', x: inner.width, y: inner.height + MARGIN.bottom - 6, 'text-anchor': 'end' },
        x.label,
      ),
    ),
    // A picture within the picture cuts off what rises above it.
    s(
      'svg',
      { x: MARGIN.left, y: MARGIN.top, width: inner.width, height: inner.height },
      s('path', { class: 'at', d: `M${upright} 0v${inner.height}` }),
      ...lines.map(path),
    ),
    s(
      'g',
      { transform: `translate(${MARGIN.left} ${MARGIN.top})` },
      ...dots
        .filter((dot) => dot.y <= y.most)
        .map((dot) => s('circle', { class: dot.name, cx: left(dot.x), cy: top(dot.y), r: 4.5 })),
    ),
  );
  return (/** @type {number} */ pixels) =>
    Math.min(Math.max((pixels - MARGIN.left) / inner.width, 0), 1) * x.most;
}
