/** The potential field, the initial path and the restarts: figure 5 of the paper of 2013, path by path. */
import { css, OVERLAYS, sequentialColor } from '../../view/colors.js';
import { s } from '../../view/dom.js';
import { createFigure } from '../figure.js';
import { t } from '../text.js';
import { cell } from './job.js';

const SIZE = 560;
const MARGIN = 24;
/** Places of the potential a side. */
const ARROWS = 15;

/**
 * A job on a square whose height is a function of x and y from −1 to 1, mm.
 *
 * @param {string} name @param {number} half Of a side, mm. @param {(x: number, y: number) => number} height
 */
export function squareJob(name, half, height) {
  const points = [];
  for (let i = 0; i < 7; i += 1) {
    for (let j = 0; j < 7; j += 1) {
      const [x, y] = [i / 3 - 1, j / 3 - 1];
      points.push([
        Number((half * x).toFixed(4)),
        Number((half * y).toFixed(4)),
        Number(height(x, y).toFixed(4)),
      ]);
    }
  }
  const knots = [0, 0, 0, 0, 0.25, 0.5, 0.75, 1, 1, 1, 1];
  return {
    version: 1,
    name,
    source: { kind: 'nurbs', degrees: [3, 3], knots_u: knots, knots_v: knots, points_mm: points },
    cutter: { kind: 'bull_nose', diameter_mm: 12, corner_radius_mm: 2, height_mm: 50 },
    strategy: { kind: 'flow', rule: 'matched', least_lead_deg: 4 },
    tolerance: { scallop_mm: 0.015 },
  };
}

/** Three hollows and three crests around the middle: the widest strips turn all over it. */
export const monkeySaddle = () => squareJob('Monkey saddle', 25, (x, y) => 2.4 * (x * x * x - 3 * x * y * y));

/** @param {import('../main.js').Ask} ask */
export function createRestarts(ask) {
  const handles = [
    { id: 'shown', min: 0, max: 100, step: 1, value: 100, unit: ' %' },
    { id: 'threshold', min: 0.7, max: 0.99, step: 0.01, value: 0.9, unit: '' },
  ];
  /** What was computed last, and for which threshold. @type {{ threshold: number, field: any, found: any } | null} */
  let kept = null;
  return createFigure('restarts', handles, async ({ shown, threshold }, svg, tell) => {
    if (kept?.threshold !== threshold) {
      const spec = monkeySaddle();
      await ask('surface', [1, spec, null]);
      const field =
        kept?.field ?? (await ask('domain', [new Float32Array(), ARROWS], (_, f) => tell(0.4 * f)));
      const found = await ask('restarts', [spec, threshold], (_, f) => tell(0.4 + 0.6 * f));
      kept = { threshold, field, found };
    }
    const { field, found } = kept;
    draw(svg, field, found, shown / 100);
    const paths = found.families.flatMap((/** @type {any} */ family, /** @type {number} */ k) =>
      family.paths.map((/** @type {any} */ path, /** @type {number} */ i) => ({
        ...path,
        family: k + 1,
        isInitial: i === 0,
      })),
    );
    const length = paths.reduce(
      (/** @type {number} */ sum, /** @type {any} */ path) => sum + path.length_mm,
      0,
    );
    const said = {
      families: found.families.length,
      paths: paths.length,
      threshold,
      length: length.toFixed(0),
      left: (100 * found.left).toFixed(1),
    };
    return {
      alt: t('restarts.alt', said),
      caption: t('restarts.caption', said),
      table: {
        head: [
          t('restarts.family'),
          t('restarts.kind'),
          t('restarts.length'),
          t('restarts.average'),
          t('restarts.efficiency'),
        ],
        rows: paths.map((/** @type {any} */ path) => [
          path.family,
          t(path.isInitial ? 'restarts.initial' : 'restarts.neighbour'),
          cell(path.length_mm, 1),
          cell(path.average_mm, 2),
          cell(path.efficiency),
        ]),
      },
    };
  });
}

/** @param {SVGSVGElement} svg @param {{ potential: Float32Array, ends: Float64Array }} field @param {any} found @param {number} share Of the paths, in their order. */
function draw(svg, { potential, ends: [u0, u1, v0, v1] }, found, share) {
  const room = SIZE - 2 * MARGIN;
  const at = (/** @type {number} */ u, /** @type {number} */ v) => [
    MARGIN + ((u - u0) / (u1 - u0)) * room,
    SIZE - MARGIN - ((v - v0) / (v1 - v0)) * room,
  ];
  const widths = [];
  for (let i = 4; i < potential.length; i += 6) widths.push(potential[i]);
  const [low, high] = [Math.min(...widths), Math.max(...widths)];
  const arrows = widths.map((width, k) => {
    const [u, v, du, dv] = potential.subarray(6 * k, 6 * k + 4);
    const [x, y] = at(u, v);
    const [dx, dy] = [du / (u1 - u0), -dv / (v1 - v0)];
    const half = (0.4 * room) / (ARROWS * (Math.hypot(dx, dy) || 1));
    const d = `M${(x - dx * half).toFixed(1)} ${(y - dy * half).toFixed(1)}L${(x + dx * half).toFixed(1)} ${(y + dy * half).toFixed(1)}`;
    return s('path', {
      class: 'arrow',
      d,
      stroke: css(sequentialColor((2 * (width - low)) / (high - low || 1) - 1)),
    });
  });
  const paths = found.families.flatMap((/** @type {any} */ family, /** @type {number} */ k) =>
    family.paths.map((/** @type {any} */ path, /** @type {number} */ i) => {
      const d = path.uv
        .map(([u, v]) =>
          at(u, v)
            .map((x) => x.toFixed(1))
            .join(' '),
        )
        .join('L');
      return s('path', {
        class: i === 0 ? 'initial' : 'neighbour',
        d: `M${d}`,
        stroke: OVERLAYS[k % OVERLAYS.length],
      });
    }),
  );
  svg.setAttribute('viewBox', `0 0 ${SIZE} ${SIZE}`);
  svg.replaceChildren(
    s('rect', { class: 'frame', x: MARGIN, y: MARGIN, width: room, height: room }),
    ...arrows,
    ...paths.slice(0, Math.round(share * paths.length)),
    s('text', { class: 'name', x: SIZE - MARGIN, y: SIZE - 6, 'text-anchor': 'end' }, 'u'),
    s('text', { class: 'name', x: 4, y: MARGIN + 4 }, 'v'),
  );
}
