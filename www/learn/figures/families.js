/** Iso-parametric against field paths on the same surface, with the floor. */
import { css, divergingColor } from '../../view/colors.js';
import { s } from '../../view/dom.js';
import { KIND, STRIDE } from '../../view/way.js';
import { createFigure } from '../figure.js';
import { WIDTH } from '../plot.js';
import { t } from '../text.js';
import { squareJob } from './restarts.js';

const [WIDE, TALL] = [WIDTH, 0.5 * WIDTH + 10];

/** The job of the comparison, with one strategy. @param {object} strategy */
export const compared = (strategy) => ({
  ...squareJob('Saddle', 20, (x, y) => 6 * x * y),
  cutter: { kind: 'bull_nose', diameter_mm: 10, corner_radius_mm: 2, height_mm: 50 },
  strategy: { rule: 'fixed', lead_deg: 5, ...strategy },
  tolerance: { scallop_mm: 0.02 },
  verify: { spacing_mm: 2 },
});

/** @type {[string, object][]} */
const STRATEGIES = [
  ['u', { kind: 'iso_parametric', along: 'u' }],
  ['v', { kind: 'iso_parametric', along: 'v' }],
  ['flow', { kind: 'flow' }],
];

/** @param {import('../main.js').Ask} ask */
export function createFamilies(ask) {
  return createFigure('families', [], async (_, svg, tell) => {
    const floor = await ask('floor', [compared(STRATEGIES[2][1]), null], (_, f) => tell(0.1 * f));
    const found = [];
    for (const [k, [name, strategy]] of STRATEGIES.entries()) {
      const at = (/** @type {number} */ share) => tell(0.1 + (0.9 * (k + share)) / STRATEGIES.length);
      const planned = await ask('plan', [compared(strategy), null], (_, f) => at(0.7 * f));
      const { report } = await ask('prove', [], (_, f) => at(0.7 + 0.3 * f));
      found.push({ name, planned, report });
    }
    const best = found.reduce((a, b) => (a.report.length.cut_mm <= b.report.length.cut_mm ? a : b));
    const worst = found
      .slice(0, 2)
      .reduce((a, b) => (a.report.length.cut_mm <= b.report.length.cut_mm ? a : b));
    const flow = found[2];
    svg.setAttribute('viewBox', `0 0 ${WIDE} ${TALL}`);
    svg.replaceChildren(...[worst, flow].flatMap((one, k) => draw(one, k)));
    const mm = (/** @type {number} */ x) => x.toFixed(0);
    const said = {
      floor: mm(floor),
      iso: mm(worst.report.length.cut_mm),
      along: worst.name,
      flow: mm(flow.report.length.cut_mm),
      less: (100 * (1 - flow.report.length.cut_mm / worst.report.length.cut_mm)).toFixed(1),
      above: (100 * (best.report.length.cut_mm / floor - 1)).toFixed(0),
    };
    return {
      alt: t('families.alt', said),
      caption: t('families.caption', said),
      table: {
        head: ['passes', 'length', 'share', 'count', 'time', 'excess'].map((id) => t(`families.${id}`)),
        rows: found.map(({ name, report }) => [
          t(`families.${name}`),
          mm(report.length.cut_mm),
          (report.length.cut_mm / floor).toFixed(3),
          report.passes,
          report.time_min.toFixed(2),
          (1000 * (report.verified?.largest_excess_mm ?? 0)).toFixed(1),
        ]),
      },
    };
  });
}

/** Passes as they are seen from above. @param {{ name: string, planned: any }} one @param {number} place */
function draw({ name, planned: { contacts, path } }, place) {
  const xs = contacts.filter((/** @type {number} */ _, /** @type {number} */ i) => i % 3 === 0);
  const ys = contacts.filter((/** @type {number} */ _, /** @type {number} */ i) => i % 3 === 1);
  const isCut = (/** @type {unknown} */ _, /** @type {number} */ i) => path[i * STRIDE + KIND] === 0;
  const [x0, x1] = ends(xs.filter(isCut));
  const [y0, y1] = ends(ys.filter(isCut));
  const size = TALL - 30;
  const scale = (size - 16) / Math.max(x1 - x0, y1 - y0);
  const left = 10 + place * (WIDE / 2);
  let d = '';
  for (let i = 1; i < xs.length; i += 1) {
    if (path[i * STRIDE + KIND] !== 0) continue;
    const at = (/** @type {number} */ k) =>
      `${(left + (xs[k] - x0) * scale).toFixed(1)} ${(26 + (y1 - ys[k]) * scale).toFixed(1)}`;
    d += i === 1 || path[(i - 1) * STRIDE + KIND] !== 0 ? `M${at(i - 1)}L${at(i)}` : `L${at(i)}`;
  }
  return [
    s('text', { class: 'name', x: left, y: 16 }, t(`families.${name}`)),
    s('path', { class: 'passes', d, stroke: css(divergingColor(place ? 0.7 : -0.7)) }),
  ];
}

/** @param {Float32Array} list */
const ends = (list) => [Math.min(...list), Math.max(...list)];
