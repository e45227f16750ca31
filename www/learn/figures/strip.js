/** The strip between P_a and P_b: the section at the contact, its band of tolerance to be dragged. */
import { createFigure, draggable } from '../figure.js';
import { plot } from '../plot.js';
import { t } from '../text.js';
import { cell, contactJob, some } from './job.js';

/** @param {import('../main.js').Ask} ask */
export function createStrip(ask) {
  const handles = [
    { id: 'height', min: 1, max: 60, step: 1, value: 10, unit: ' µm' },
    { id: 'lead', min: 2, max: 40, step: 0.5, value: 8, unit: '°' },
    { id: 'yaw', min: -40, max: 40, step: 1, value: 0, unit: '°' },
    { id: 'across', min: -30, max: 20, step: 1, value: 5, unit: ' /m' },
    { id: 'torsion', min: -15, max: 15, step: 1, value: 0, unit: ' /m' },
  ];
  /** @type {((y: number) => number) | null} */
  let heightAt = null;
  const made = createFigure('strip', handles, async ({ height, lead, yaw, across, torsion }, svg) => {
    const h = height / 1000;
    const surface = [0, torsion / 1000, across / 1000];
    const found = await ask('section', [contactJob(9.5, 3, h), [lead, yaw], surface, 6]);
    const [y, z] = [0, 1].map((k) =>
      found.envelope_mm.map((/** @type {number[]} */ p) => (k === 0 ? p[0] : p[1] * 1000)),
    );
    const top = 80;
    const scale = plot(svg, {
      x: [-6, 6],
      y: [-12, top],
      labels: [t('axis.side'), t('strip.over')],
      bands: [
        { name: 'part', from: -12, to: 0 },
        { name: 'band', from: 0, to: height },
      ],
      lines: [{ name: 'exact', x: y, y: z }],
      dots: found.halves_mm
        ? [
            { name: 'end', x: found.halves_mm[0], y: height, text: 'Pa' },
            { name: 'end', x: -found.halves_mm[1], y: height, text: 'Pb' },
          ]
        : [],
    });
    heightAt = scale.y;
    const width = found.halves_mm ? found.halves_mm[0] + found.halves_mm[1] : null;
    const said = {
      width: cell(width),
      left: cell(found.halves_mm?.[0]),
      right: cell(found.halves_mm?.[1]),
      second: cell(found.second_order_mm),
      height,
    };
    return {
      alt: t(width === null ? 'strip.gouges' : 'strip.alt', said),
      caption: t(width === null ? 'strip.gouges' : 'strip.caption', said),
      legend: [['exact', t('strip.envelope')]],
      table: {
        head: [t('axis.side'), t('strip.over')],
        rows: some(y.length, 20).map((i) => [cell(y[i], 2), cell(z[i], 2)]),
      },
    };
  });
  draggable(made.svg, (_, y) => heightAt && made.set('height', heightAt(y)));
  return made;
}
