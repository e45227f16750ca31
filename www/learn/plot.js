/** Lines over two axes of any range. */
import { plain } from '../format.js';
import { s } from '../view/dom.js';
import { niceTicks } from '../view/ticks.js';

/** Units of the drawing: about as many as pixels, so that numbers can be read on a phone too. */
export const WIDTH = matchMedia('(width < 700px)').matches ? 380 : 640;
const MARGIN = { top: 30, right: 14, bottom: 44, left: 52 };

/**
 * @typedef {{ name: string, x: number[], y: (number | null)[] }} Line A gap where `y` is null; `name` is its class.
 * @typedef {{ x: [number, number], y: [number, number], labels: [string, string], lines: Line[], height?: number,
 *   bands?: { name: string, from: number, to: number }[], uprights?: { name: string, at: number, text: string }[],
 *   dots?: { name: string, x: number, y: number, text?: string }[] }} Drawing
 * A band lies between two values of y.
 */

/**
 * Fills `svg`; returns what turns pixels of the drawing into values of x and y.
 *
 * @param {SVGSVGElement} svg
 * @param {Drawing} drawing
 */
export function plot(svg, { x, y, labels, lines, height = 320, bands = [], uprights = [], dots = [] }) {
  const [wide, tall] = [WIDTH - MARGIN.left - MARGIN.right, height - MARGIN.top - MARGIN.bottom];
  const px = (/** @type {number} */ v) => MARGIN.left + ((v - x[0]) / (x[1] - x[0])) * wide;
  const py = (/** @type {number} */ v) => MARGIN.top + ((y[1] - v) / (y[1] - y[0])) * tall;
  const fix = (/** @type {number} */ v) => v.toFixed(2);
  svg.setAttribute('viewBox', `0 0 ${WIDTH} ${height}`);
  svg.replaceChildren(
    ...bands.map(({ name, from, to }) =>
      s('rect', { class: name, x: MARGIN.left, y: fix(py(to)), width: wide, height: fix(py(from) - py(to)) }),
    ),
    ...niceTicks(x, wide / 80).flatMap((v) => [
      s('path', { class: v === 0 ? 'axis' : 'grid', d: `M${fix(px(v))} ${MARGIN.top}v${tall}` }),
      s('text', { x: fix(px(v)), y: MARGIN.top + tall + 18, 'text-anchor': 'middle' }, plain(v)),
    ]),
    ...niceTicks(y, tall / 48).flatMap((v) => [
      s('path', { class: v === 0 ? 'axis' : 'grid', d: `M${MARGIN.left} ${fix(py(v))}h${wide}` }),
      s('text', { x: MARGIN.left - 8, y: fix(py(v) + 4), 'text-anchor': 'end' }, plain(v)),
    ]),
    s('text', { class: 'name', x: WIDTH - MARGIN.right, y: height - 6, 'text-anchor': 'end' }, labels[0]),
    s('text', { class: 'name', x: 4, y: 14 }, labels[1]),
    s(
      'svg',
      {
        x: MARGIN.left,
        y: MARGIN.top,
        width: wide,
        height: tall,
        viewBox: `${MARGIN.left} ${MARGIN.top} ${wide} ${tall}`,
      },
      ...lines.map((line) => s('path', { class: `line ${line.name}`, d: way(line, px, py) })),
      ...uprights.flatMap(({ name, at, text }) => [
        s('path', { class: `upright ${name}`, d: `M${fix(px(at))} ${MARGIN.top}v${tall}` }),
        s('text', { class: name, x: fix(px(at) + 5), y: MARGIN.top + 14 }, text),
      ]),
    ),
    ...dots
      .filter((dot) => dot.y <= y[1] && dot.y >= y[0])
      .flatMap((dot) => [
        s('circle', { class: `dot ${dot.name}`, cx: fix(px(dot.x)), cy: fix(py(dot.y)), r: 5 }),
        s('text', { x: fix(px(dot.x)), y: fix(py(dot.y) - 10), 'text-anchor': 'middle' }, dot.text ?? ''),
      ]),
  );
  return {
    x: (/** @type {number} */ pixel) => x[0] + ((pixel - MARGIN.left) / wide) * (x[1] - x[0]),
    y: (/** @type {number} */ pixel) => y[1] - ((pixel - MARGIN.top) / tall) * (y[1] - y[0]),
  };
}

/** @param {Line} line @param {(v: number) => number} px @param {(v: number) => number} py */
function way({ x, y }, px, py) {
  let isDown = false;
  let d = '';
  for (let i = 0; i < x.length; i += 1) {
    const value = y[i];
    if (value !== null) d += `${isDown ? 'L' : 'M'}${px(x[i]).toFixed(2)} ${py(value).toFixed(2)}`;
    isDown = value !== null;
  }
  return d;
}
