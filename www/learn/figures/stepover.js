/** Stepover against tilt: what the circle model promises, what is true, and what two passes leave when they are cut. */
import { createFigure, draggable } from '../figure.js';
import { plot } from '../plot.js';
import { t } from '../text.js';
import { cell, contactJob } from './job.js';

/** Degrees a row of the table. */
const ROWS = 5;

/** @param {import('../main.js').Ask} ask */
export function createStepover(ask) {
  const handles = [
    { id: 'tilt', min: 2, max: 60, step: 0.5, value: 15, unit: '°' },
    { id: 'radius', min: -100, max: 100, step: 5, value: 0, unit: ' mm' },
    { id: 'height', min: 10, max: 500, step: 10, value: 100, unit: ' µm' },
  ];
  /** @type {((x: number) => number) | null} */
  let tiltAt = null;
  const made = createFigure('stepover', handles, async ({ tilt, radius, height }, svg) => {
    const spec = contactJob(3, 2, height / 1000);
    const [chart, cut] = await Promise.all([
      ask('stepover', [spec, [radius]]),
      ask('passes', [spec, tilt, radius]),
    ]);
    const [{ tilt_deg: x, circle_mm: circle, lead_mm: lead, lateral_mm: lateral }] = chart.curves;
    const steady = [...lead, ...lateral].filter((value, i) => value !== null && x[i % x.length] >= 2);
    const top = 1.35 * Math.max(...steady, 0.1);
    const scale = plot(svg, {
      x: [0, 60],
      y: [0, top],
      labels: [t('stepover.tilt.axis'), t('stepover.axis')],
      lines: [
        { name: 'lateral', x, y: lateral },
        { name: 'circle', x, y: circle },
        { name: 'exact', x, y: lead },
      ],
      uprights: [{ name: 'at', at: tilt, text: `${tilt}°` }],
      dots: [
        ...(cut.exact_mm === null ? [] : [{ name: 'exact', x: tilt, y: cut.exact_mm }]),
        ...(cut.circle_mm === null ? [] : [{ name: 'circle', x: tilt, y: cut.circle_mm }]),
      ],
    });
    tiltAt = scale.x;
    const micron = (/** @type {number | null} */ mm) => (mm === null ? '–' : (mm * 1000).toFixed(1));
    const said = {
      tilt,
      exact: cell(cut.exact_mm),
      circle: cell(cut.circle_mm),
      exactLeft: micron(cut.exact_scallop_mm),
      circleLeft: micron(cut.circle_scallop_mm),
      height,
    };
    const rows = x.flatMap((/** @type {number} */ deg, /** @type {number} */ i) =>
      deg % ROWS === 0 ? [i] : [],
    );
    return {
      alt: t(cut.exact_mm === null ? 'stepover.gouges' : 'stepover.alt', said),
      caption: t(cut.exact_mm === null ? 'stepover.gouges' : 'stepover.caption', said),
      legend: [
        ['exact', t('stepover.exact')],
        ['circle', t('stepover.circle')],
        ['lateral', t('stepover.lateral')],
      ],
      table: {
        head: [t('stepover.tilt.axis'), t('stepover.exact'), t('stepover.circle'), t('stepover.lateral')],
        rows: rows.map((/** @type {number} */ i) => [
          `${x[i]}°`,
          cell(lead[i]),
          cell(circle[i]),
          cell(lateral[i]),
        ]),
      },
    };
  });
  draggable(made.svg, (x) => tiltAt && made.set('tilt', tiltAt(x)));
  return made;
}
