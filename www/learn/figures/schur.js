/** Why the Schur complement and not the section: widths by yaw over a twisted surface. */
import { createFigure } from '../figure.js';
import { plot } from '../plot.js';
import { t } from '../text.js';
import { cell, contactJob } from './job.js';

/** Degrees a row of the table. */
const ROWS = 5;

/** @param {import('../main.js').Ask} ask */
export function createSchur(ask) {
  const handles = [
    { id: 'lead', min: 4, max: 30, step: 1, value: 8, unit: '°' },
    { id: 'torsion', min: -12, max: 12, step: 1, value: 6, unit: ' /m' },
    { id: 'across', min: -20, max: 10, step: 1, value: 5, unit: ' /m' },
  ];
  return createFigure('schur', handles, async ({ lead, torsion, across }, svg) => {
    const found = await ask('widths', [contactJob(9.5, 3, 0.01), lead, [0, torsion / 1000, across / 1000]]);
    const { yaw_deg: x, exact_mm: exact, schur_mm: schur, section_mm: section } = found;
    const all = [...exact, ...schur, ...section].filter((value) => value !== null && value < 20);
    plot(svg, {
      x: [-45, 45],
      y: [0, 1.1 * Math.max(...all, 1)],
      labels: [t('schur.yaw'), t('schur.width')],
      lines: [
        { name: 'circle', x, y: section },
        { name: 'lateral', x, y: schur },
        { name: 'exact', x, y: exact },
      ],
    });
    const off = x.map((/** @type {number} */ _, /** @type {number} */ i) => {
      const [a, b] = [section[i], exact[i]];
      return a === null || b === null ? 0 : Math.abs(a / b - 1);
    });
    const worst = off.indexOf(Math.max(...off));
    const mine = x.map((/** @type {number} */ _, /** @type {number} */ i) =>
      schur[i] === null || exact[i] === null ? 0 : Math.abs(schur[i] / exact[i] - 1),
    );
    const percent = (/** @type {number} */ share) => (100 * share).toFixed(share < 0.1 ? 1 : 0);
    const said = { section: percent(off[worst]), yaw: x[worst], schur: percent(Math.max(...mine)) };
    const rows = x.flatMap((/** @type {number} */ yaw, /** @type {number} */ i) =>
      yaw % ROWS === 0 ? [i] : [],
    );
    return {
      alt: t('schur.alt', said),
      caption: t('schur.caption', said),
      legend: [
        ['exact', t('schur.exact')],
        ['lateral', t('schur.schur')],
        ['circle', t('schur.section')],
      ],
      table: {
        head: [t('schur.yaw'), t('schur.exact'), t('schur.schur'), t('schur.section')],
        rows: rows.map((/** @type {number} */ i) => [
          `${x[i]}°`,
          cell(exact[i]),
          cell(schur[i]),
          cell(section[i]),
        ]),
      },
    };
  });
}
