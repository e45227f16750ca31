/** A lens on X, Z and C: spiral and circles, equal angles and equal arcs, and what they leave. */
import { compile } from '../../compiling.js';
import { createPlanner } from '../../protocol.js';
import { withVariant, write } from '../../spec.js';
import { css, divergingColor } from '../../view/colors.js';
import { s } from '../../view/dom.js';
import address from '../../wasm/turning_bg.wasm?url';
import { createFigure } from '../figure.js';
import { WIDTH } from '../plot.js';
import { t } from '../text.js';
import { cell } from './job.js';

const SIZE = 170;
/** Maps in a row. */
const ACROSS = WIDTH < 500 ? 2 : 4;
/** mm, where the colours end. */
const MOST = 0.02;
/** Rays and rings that are drawn of each map. */
const DRAWN = [60, 16];

export function createTurning() {
  /** @type {ReturnType<typeof createPlanner> | null} */
  let planner = null;
  const handles = [
    { id: 'step', min: 0.5, max: 3, step: 0.5, value: 1, unit: ' mm' },
    { id: 'angle', min: 2, max: 10, step: 1, value: 5, unit: '°' },
  ];
  return createFigure('turning', handles, async ({ step, angle }, svg, tell) => {
    planner ??= createPlanner(
      () => compile(address),
      () => new Worker(new URL('../../turning/worker.js', import.meta.url), { type: 'module', name: 'lens' }),
    );
    const { schema, spec } = await planner.call('start', []);
    const group = (/** @type {string} */ path) =>
      schema.groups.find((/** @type {any} */ g) => g.path === path);
    const found = [];
    for (const [k, [guide, points]] of [
      ['spiral', 'angle'],
      ['spiral', 'arc'],
      ['circles', 'angle'],
      ['circles', 'arc'],
    ].entries()) {
      let job = withVariant(withVariant(spec, group('guide'), guide), group('points'), points);
      job = write(job, 'speed.pace', points === 'arc' ? 'surface_speed' : 'c_speed');
      job = write(job, 'guide.step_mm', step);
      // Whatever is left between the points is what this is about.
      job = write(job, 'tolerance.chord_mm', 1);
      job = write(job, 'tolerance.residue_mm', 1);
      if (points === 'angle') job = write(job, 'points.angle_deg', angle);
      // Arcs as long as the angle gives at the rim's half.
      else job = write(job, 'points.arc_mm', Number((15 * (angle * Math.PI)) / 180).toFixed(2) * 1);
      const planned = await planner.call('plan', [job], (_, f) => tell((k + 0.6 * f) / 4));
      const { report, residues } = await planner.call('prove', [], (_, f) => tell((k + 0.6 + 0.4 * f) / 4));
      found.push({ name: `${guide}.${points}`, report, residues, farthest: planned.farthest });
    }
    svg.setAttribute('viewBox', `0 0 ${ACROSS * SIZE} ${(4 / ACROSS) * (SIZE + 24)}`);
    svg.replaceChildren(...found.flatMap(draw));
    const micron = (/** @type {number} */ mm) => (1000 * mm).toFixed(1);
    const worst = found.reduce((a, b) =>
      (a.report.verified.residue?.mm ?? 0) >= (b.report.verified.residue?.mm ?? 0) ? a : b,
    );
    const said = {
      name: t(`turning.${worst.name}`),
      most: micron(worst.report.verified.residue?.mm ?? 0),
      step,
      angle,
    };
    return {
      alt: t('turning.alt', said),
      caption: t('turning.caption', said),
      table: {
        head: ['path', 'points', 'time', 'over', 'under', 'acceleration'].map((id) =>
          t(`turning.head.${id}`),
        ),
        rows: found.map(({ name, report }) => [
          t(`turning.${name}`),
          report.points,
          report.time_s.toFixed(1),
          micron(report.verified.residue?.mm ?? 0),
          micron(report.verified.overcut?.mm ?? 0),
          cell(report.c.acceleration.value, 0),
        ]),
      },
    };
  });
}

/** @param {{ name: string, residues: any, farthest: number }} one @param {number} place */
function draw({ name, residues }, place) {
  const [rays, rings] = DRAWN;
  const middle = [(place % ACROSS) * SIZE + SIZE / 2, Math.floor(place / ACROSS) * (SIZE + 24) + SIZE / 2];
  const radius = SIZE / 2 - 8;
  const cells = [];
  for (let ray = 0; ray < rays; ray += 1) {
    for (let ring = 0; ring < rings; ring += 1) {
      // The worst of what the cell stands for.
      let value = Number.NaN;
      for (let i = Math.floor((ray * residues.rays) / rays); i < ((ray + 1) * residues.rays) / rays; i += 1) {
        for (
          let j = Math.floor((ring * residues.rings) / rings);
          j < ((ring + 1) * residues.rings) / rings;
          j += 1
        ) {
          const here = residues.values[i * residues.rings + j];
          if (Number.isFinite(here) && !(Math.abs(here) <= Math.abs(value))) value = here;
        }
      }
      if (Number.isNaN(value)) continue;
      const at = (/** @type {number} */ r, /** @type {number} */ a) => {
        const [reach, turn] = [(radius * r) / rings, (2 * Math.PI * a) / rays];
        return `${(middle[0] + reach * Math.cos(turn)).toFixed(1)} ${(middle[1] - reach * Math.sin(turn)).toFixed(1)}`;
      };
      const d = `M${at(ring, ray)}L${at(ring + 1, ray)}L${at(ring + 1, ray + 1)}L${at(ring, ray + 1)}Z`;
      cells.push(s('path', { d, fill: css(divergingColor(value / MOST)) }));
    }
  }
  return [
    ...cells,
    s(
      'text',
      { class: 'name', x: middle[0], y: middle[1] + SIZE / 2 + 12, 'text-anchor': 'middle' },
      t(`turning.${name}`),
    ),
  ];
}
