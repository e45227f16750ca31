/**
 * The result in numbers.
 *
 * @import { State, Report, Verified } from './types.js'
 */
import { count, length, micron, minutes, percent, plain } from '../format.js';
import { h, icon } from '../view/dom.js';
import { prettify, said, t } from './text.js';

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
      const warnings = report.warnings.map((text) => h('p', { class: 'message' }, warning(text)));
      root.replaceChildren(...proof, list(expected(report)), ...warnings);
    },
  };
}

/** A warning begins with its setting: people know it by its name in the form. @param {string} text */
function warning(text) {
  const [, group, field, rest] = text.match(/^(\w+)\.(\w+): (.*)$/s) ?? [];
  if (!group) return said(text);
  const name = t(`field.${group}.${field}`, {}, prettify(field));
  return t('results.warning', { group: t(`group.${group}`), field: name, text: said(rest) });
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
  const { chord_left, chord_dug } = verified;
  if (chord_left && chord_dug) rows.push(['chord', t('results.chord'), between(chord_dug.mm, chord_left.mm)]);
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

/** @param {number} low @param {number} high mm */
const between = (low, high) => `${fine(low)} … ${fine(high)}`;

/** @param {number} value @param {number} [digits] */
const digits = (value, digits = 4) => plain(Number(value.toPrecision(digits)));

/** @param {Report} report @returns {[string, string, string][]} */
function expected(report) {
  const { z, c, strictest, reserve, angle_deg, arc_mm, innermost_mm, outermost_mm, effective_deg } = report;
  const apart = angle_deg === null ? `${digits(arc_mm ?? 0)} mm` : `${digits(angle_deg)}°`;
  const from = innermost_mm > 0 ? `${length(innermost_mm)} … ` : '';
  /** @type {[string, string, string][]} */
  const rows = [
    ['points', t('results.points'), count(report.points)],
    ['turns', t('results.turns'), plain(Number(report.turns.toFixed(1)))],
    ['steps', t('results.steps'), `${digits(report.step_mm)} mm, ${apart}`],
    ['outermost', t('results.outermost'), `${from}${length(outermost_mm)}`],
    ['cusp', t('results.cusp'), fine(report.cusp.mm)],
    ['time', t('results.time'), minutes(report.time_s / 60)],
    ['rpm', t('results.rpm'), `${digits(report.highest_rpm)} rpm`],
    ['acceleration', t('results.acceleration'), `${digits(z.acceleration.value)} mm/s²`],
    ['turning', t('results.turning'), `${digits(c.acceleration.value)} °/s²`],
    [
      'first',
      t('results.first'),
      strictest ? t('results.first.of', { what: said(strictest), reserve: digits(reserve ?? 0, 3) }) : '–',
    ],
  ];
  if (effective_deg) {
    const [clearance, least, most] = effective_deg.map((angle) => plain(Number(angle.toFixed(1))));
    rows.push(['clearance', t('results.clearance'), `${clearance}°`]);
    rows.push(['rake', t('results.rake'), `${least}° … ${most}°`]);
  }
  return rows;
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
