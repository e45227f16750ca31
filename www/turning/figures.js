/**
 * The result in numbers.
 *
 * @import { State, Report, Verified } from './types.js'
 */
import { count, length, micron, minutes, percent, plain } from '../format.js';
import { h, icon } from '../view/dom.js';
import { t } from './text.js';

/** @param {HTMLElement} root */
export function createFigures(root) {
  /** @type {unknown} */
  let shown;
  let wasProving = false;

  return {
    /** @param {State} state */
    update({ outcome, planned, job }) {
      const isProving = job !== null;
      if (shown === outcome && wasProving === isProving) return;
      shown = outcome;
      wasProving = isProving;
      if (!outcome) {
        root.replaceChildren(h('p', {}, t('results.none')));
        return;
      }
      const { report } = outcome;
      const { verified } = report;
      const proof = verified
        ? [verdict(verified, planned), list(proven(verified))]
        : [h('p', {}, isProving ? t('results.proving') : '')];
      const warnings = report.warnings.map((text) => h('p', { class: 'message' }, text));
      root.replaceChildren(...proof, list(expected(report)), ...warnings);
    },
  };
}

/** @param {Verified} verified @param {any} spec */
function verdict({ residue, overcut, uncut }, { tolerance }) {
  // A nanometre is what the program rounds to.
  const low = -tolerance.chord_mm - 1e-6;
  const isGood = residue && overcut && residue.mm <= tolerance.residue_mm && overcut.mm >= low && uncut === 0;
  return h(
    'p',
    { class: `verdict ${isGood ? 'good' : 'bad'}` },
    icon(isGood ? 'good' : 'bad'),
    t(isGood ? 'results.good' : 'results.bad'),
  );
}

/** @param {Verified} verified @returns {[string, string, string][]} Id, name and value. */
function proven(verified) {
  const { residue, overcut, bands, sagittas, uncut } = verified;
  /** @type {[string, string, string][]} */
  const rows = [
    ['residue', t('results.residue'), residue ? fine(residue.mm) : '–'],
    ['overcut', t('results.overcut'), overcut ? fine(overcut.mm) : '–'],
    ['pv', t('results.pv'), fine(verified.peak_to_valley_mm)],
    ['rms', t('results.rms'), fine(verified.rms_mm)],
  ];
  for (const { limit_mm, within } of bands) {
    rows.push([`within-${limit_mm}`, t('results.within', { limit: plain(limit_mm) }), percent(within)]);
  }
  if (uncut > 0) rows.push(['uncut', t('results.uncut'), percent(uncut)]);
  for (const { direction_deg, cut_mm, nominal_mm } of sagittas) {
    const value = t('results.sagitta.of', { cut: cut_mm.toFixed(4), nominal: nominal_mm.toFixed(4) });
    rows.push([`sagitta-${Math.round(direction_deg)}`, sagittaName(direction_deg), value]);
  }
  return rows;
}

/** @param {number} degrees */
const sagittaName = (degrees) => t('results.sagitta', { angle: plain(Math.round(degrees)) });

/** Micrometres with nanometres where they matter. @param {number} mm */
function fine(mm) {
  return Math.abs(mm) < 0.001 ? `${plain(Number((mm * 1000).toFixed(3)))} µm` : micron(mm);
}

/** @param {Report} report @returns {[string, string, string][]} */
function expected(report) {
  const { z, strictest, reserve } = report;
  return [
    ['points', t('results.points'), count(report.points)],
    ['turns', t('results.turns'), plain(Number(report.turns.toFixed(1)))],
    ['outermost', t('results.outermost'), length(report.outermost_mm)],
    ['cusp', t('results.cusp'), fine(report.cusp.mm)],
    ['chord', t('results.chord'), `${fine(report.chord_dug.mm)} … ${fine(report.chord_left.mm)}`],
    ['time', t('results.time'), minutes(report.time_s / 60)],
    ['rpm', t('results.rpm'), `${plain(Number(report.highest_rpm.toPrecision(4)))} rpm`],
    [
      'acceleration',
      t('results.acceleration'),
      `${plain(Number(z.acceleration.value.toPrecision(4)))} mm/s²`,
    ],
    [
      'first',
      t('results.first'),
      strictest ? `${strictest}, × ${plain(Number((reserve ?? 0).toPrecision(3)))}` : '–',
    ],
  ];
}

/** @param {[string, string, string][]} rows */
function list(rows) {
  return h(
    'dl',
    { class: 'figures' },
    ...rows.map(([id, name, value]) =>
      h('div', { 'data-figure': id }, h('dt', {}, name), h('dd', {}, value)),
    ),
  );
}
