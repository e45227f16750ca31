/** Effective radius: the profile of a leaning cutter and the circle that touches it. */
import { createFigure } from '../figure.js';
import { plot } from '../plot.js';
import { t } from '../text.js';
import { cell, contactJob, some } from './job.js';

/** @param {import('../main.js').Ask} ask */
export function createTilt(ask) {
  const handles = [
    { id: 'lead', min: 1, max: 60, step: 1, value: 15, unit: '°' },
    { id: 'center', min: 0.5, max: 12, step: 0.5, value: 3, unit: ' mm' },
    { id: 'corner', min: 0.5, max: 6, step: 0.5, value: 2, unit: ' mm' },
  ];
  return createFigure('tilt', handles, async ({ lead, center, corner }, svg) => {
    const spec = contactJob(center, corner, 0.01);
    const reach = 0.98 * (center + corner);
    const found = await ask('section', [spec, [lead, 0], [0, 0, 0], reach]);
    const radius = found.effective_radius_mm;
    const [y, z] = [0, 1].map((k) => found.envelope_mm.map((/** @type {number[]} */ p) => p[k]));
    // The circle is drawn as far as it rises no higher than the picture.
    const circle = y.map((/** @type {number} */ at) =>
      Math.abs(at) < radius ? radius - Math.sqrt(radius * radius - at * at) : null,
    );
    const top = Math.max(...z) * 1.05;
    plot(svg, {
      x: [-reach, reach],
      y: [-0.06 * top, top],
      labels: [t('axis.side'), t('axis.height')],
      lines: [
        { name: 'circle', x: y, y: circle },
        { name: 'exact', x: y, y: z },
      ],
    });
    const rows = some(y.length, 16);
    return {
      alt: t('tilt.alt', { lead, radius: cell(radius, 2) }),
      caption: t('tilt.caption', { lead, radius: cell(radius, 2), corner }),
      legend: [
        ['exact', t('tilt.exact')],
        ['circle', t('tilt.circle')],
      ],
      table: {
        head: [t('axis.side'), t('tilt.exact'), t('tilt.circle')],
        rows: rows.map((i) => [cell(y[i], 2), cell(z[i]), cell(circle[i])]),
      },
    };
  });
}
