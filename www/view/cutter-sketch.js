/** A small drawing of the cutter with its measures. */
import { plain } from '../format.js';
import { s } from './dom.js';
import { pairs } from './outline.js';

const WIDTH = 260;
const HEIGHT = 116;
const MARGIN = 22;

export function createCutterSketch() {
  const element = s('svg', {
    class: 'sketch',
    viewBox: `0 0 ${WIDTH} ${HEIGHT}`,
    'aria-hidden': 'true',
  });

  /** @type {{ outline: Float32Array | null }} */
  let drawn = { outline: null };

  return {
    element,

    /** @param {any} cutter @param {Float32Array | null} outline */
    update(cutter, outline) {
      if (drawn.outline === outline) return;
      drawn = { outline };
      if (!outline) {
        element.replaceChildren();
        return;
      }
      const points = pairs(outline);
      const widest = Math.max(...points.map(([radius]) => radius));
      // Tall cutters are cut off: the corner is what matters.
      const tall = Math.min(points[points.length - 1][1], 2.2 * widest);
      const scale = Math.min((WIDTH - 5 * MARGIN) / (2 * widest), (HEIGHT - 2 * MARGIN) / tall);
      const bottom = HEIGHT - MARGIN;
      const middle = WIDTH / 2;
      const shown = points.filter(([, z]) => z <= tall);
      const last = points[points.length - 1];
      if (shown.length < points.length) {
        const from = shown[shown.length - 1];
        const share = (tall - from[1]) / (last[1] - from[1] || 1);
        shown.push([from[0] + (last[0] - from[0]) * share, tall]);
      }
      const at = (/** @type {number} */ x, /** @type {number} */ z) =>
        `${(middle + x * scale).toFixed(2)} ${(bottom - z * scale).toFixed(2)}`;
      const right = shown.map(([radius, z]) => at(radius, z));
      const left = shown.map(([radius, z]) => at(-radius, z)).reverse();
      const top = bottom - tall * scale;
      const half = widest * scale;
      element.replaceChildren(
        s('path', { class: 'body', d: `M${[...left, ...right].join('L')}` }),
        s('path', { class: 'axis', d: `M${middle} ${top - 8}V${bottom + 8}` }),
        s('path', { class: 'measure', d: arrows(middle - half, middle + half, top - 10) }),
        s('text', { x: middle + half + 6, y: top - 6 }, `⌀ ${plain(cutter.diameter_mm)}`),
        ...corner(cutter, at, points),
      );
    },
  };
}

/** @param {any} cutter @param {(x: number, z: number) => string} at @param {[number, number][]} points */
function corner(cutter, at, points) {
  const radius = cutter.kind === 'ball' ? cutter.diameter_mm / 2 : cutter.corner_radius_mm;
  if (!(radius > 0)) return [];
  const [x, z] = points[Math.floor((points.length - 1) / 2)];
  const [cx, cy] = at(x, z).split(' ').map(Number);
  return [
    s('path', { class: 'measure', d: `M${cx} ${cy}l14 8h10` }),
    s('text', { x: cx + 28, y: cy + 12 }, `r ${plain(radius)}`),
  ];
}

/** @param {number} from @param {number} to @param {number} y */
function arrows(from, to, y) {
  return `M${from} ${y}H${to}M${from} ${y - 4}v8M${to} ${y - 4}v8`;
}
