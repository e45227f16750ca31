/**
 * The sheet that goes to the machine: one page, printed.
 *
 * @import { State } from '../types.js'
 */
import * as format from '../format.js';
import { prettify, t } from '../text/index.js';
import { h } from './dom.js';
import { nameOf } from './runs.js';

/** Fills the sheet and hands it to the printer. @param {State} state @param {HTMLCanvasElement | null} picture */
export function printSheet(state, picture) {
  const root = document.getElementById('sheet');
  if (!root || !state.outcome || !state.planned) return;
  root.replaceChildren(...sheet(state, picture));
  print();
}

/** @param {State} state @param {HTMLCanvasElement | null} picture */
function sheet({ outcome, planned, picture: shape }, picture) {
  if (!outcome || !planned) return [];
  const { spec, source } = planned;
  const { report, files } = outcome;
  const { verified } = report;
  const cutter = Object.entries(spec.cutter).filter(([name]) => name !== 'kind');
  const of = (/** @type {string} */ group, /** @type {[string, any][]} */ values) =>
    values.map(([name, value]) => row(t(`field.${group}.${name}`, {}, prettify(name)), shownAs(name, value)));
  const box = shape ? bounds(shape.positions) : null;
  return [
    h(
      'header',
      {},
      h('h1', {}, spec.name || source.name),
      h('p', {}, t('sheet.title'), ' · ', new Date().toLocaleDateString(t('locale'))),
    ),
    picture,
    h(
      'div',
      { class: 'columns' },
      part(t('sheet.part'), [
        row(t('sheet.source'), source.name || spec.name),
        row(t('surface.side'), t(`surface.side.${spec.source.side ?? 'front'}`)),
        ...(box
          ? ['x', 'y', 'z'].map((axis, k) =>
              row(axis.toUpperCase(), `${format.length(box.low[k])} … ${format.length(box.high[k])}`),
            )
          : []),
        row(t('sheet.zero'), t('sheet.zero.of')),
      ]),
      part(t('group.cutter'), [
        row(t('kind.cutter'), t(`kind.cutter.${spec.cutter.kind}`, {}, prettify(spec.cutter.kind))),
        ...of('cutter', cutter),
        row(t('sheet.number'), 'T1'),
      ]),
      part(t('group.strategy'), [
        row(t('kind.strategy'), nameOf(planned)),
        row(t('results.passes'), format.count(report.passes)),
        row(t('results.length'), format.length(report.length.cut_mm)),
        row(t('results.machining'), format.minutes(report.time_min)),
      ]),
      part(t('group.feeds'), of('feeds', Object.entries(spec.feeds))),
      part(t('group.tolerance'), of('tolerance', Object.entries(spec.tolerance))),
      part(t('results.proof'), [
        row(
          t('results.excess'),
          verified?.largest_excess_mm == null ? '–' : format.micron(verified.largest_excess_mm),
        ),
        row(
          t('results.gouge'),
          verified?.largest_gouge_mm == null ? '–' : format.micron(verified.largest_gouge_mm),
        ),
        row(t('results.within'), verified ? format.percent(verified.share_within) : t('results.proof.none')),
        row(t('results.unreachable'), format.area(report.unreachable.area_mm2)),
      ]),
    ),
    h('p', { class: 'warnings' }, ...report.warnings.map((warning) => h('span', {}, warning))),
    h('p', { class: 'sign' }, t('sheet.program'), ' ', files?.nc ? t('sheet.three') : t('sheet.five')),
    h('p', { class: 'sign' }, `${t('sheet.checked')} ______________`),
  ].filter((node) => node !== null);
}

/** @param {string} name @param {[string, string][]} rows */
const part = (name, rows) =>
  h(
    'section',
    {},
    h('h2', {}, name),
    h('dl', {}, ...rows.map(([term, value]) => h('div', {}, h('dt', {}, term), h('dd', {}, value)))),
  );

/** @param {string} name @param {string} value @returns {[string, string]} */
const row = (name, value) => [name, value];

/** A setting with the unit that its name tells. @param {string} name @param {any} value */
function shownAs(name, value) {
  if (typeof value !== 'number') return String(value);
  if (name.endsWith('_mm_per_min')) return format.feed(value);
  if (name.endsWith('_mm')) return value < 0.1 ? format.micron(value) : format.length(value);
  if (name.endsWith('_deg')) return format.degrees(value);
  return name.endsWith('_rpm') ? `${format.count(value)} ${t('unit.1/min')}` : format.plain(value);
}

/** @param {Float32Array} positions */
function bounds(positions) {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < positions.length; i += 1) {
    low[i % 3] = Math.min(low[i % 3], positions[i]);
    high[i % 3] = Math.max(high[i % 3], positions[i]);
  }
  return { low, high };
}
