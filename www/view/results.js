/**
 * The figures of a planned path.
 *
 * @import { State, Outcome, Report, Verified } from '../types.js'
 */
import * as format from '../format.js';
import { has, prettify, t } from '../text/index.js';
import { createDistribution } from './distribution.js';
import { attribute, h, icon } from './dom.js';
import { createHistogram } from './histogram.js';

/** @param {HTMLElement} root */
export function createResults(root) {
  const stale = h('p', { class: 'stale' }, t('results.stale'));
  const preview = h('p', { class: 'preview' }, t('results.preview'));
  const body = h('div', { class: 'figures' });
  const empty = h('p', { class: 'help' }, t('results.empty'));
  root.append(stale, preview, empty, body);
  /** @type {Outcome | null} */
  let shown = null;
  let wasProving = false;

  return {
    /** @param {State} state */
    update({ outcome, draft, planned, job }) {
      empty.hidden = outcome !== null;
      body.hidden = outcome === null;
      preview.hidden = !outcome?.isPreview;
      stale.hidden = outcome === null || draft === planned;
      root.classList.toggle('old', !stale.hidden);
      const isProving = job?.op === 'plan' && job.draft === planned;
      if (outcome && (outcome !== shown || isProving !== wasProving)) {
        body.replaceChildren(...figures(outcome, planned?.spec.tolerance?.chord_mm ?? 0, isProving));
      }
      wasProving = isProving;
      shown = outcome;
    },
  };
}

/** @param {Outcome} outcome @param {number} chord The deepest gouge that was allowed, millimetres. @param {boolean} isProving */
function figures({ report, seconds, proofSeconds, isPreview, histogram }, chord, isProving) {
  const { area_mm2: missed, unseen_mm2: unseen } = report.unreachable;
  const reached = report.area_mm2 > 0 ? Math.max(0, 1 - missed / report.area_mm2) : 1;
  return [
    h(
      'dl',
      { class: 'headline' },
      pair(t('results.length'), format.length(report.length.cut_mm), 'cut'),
      pair(t('results.passes'), format.count(report.passes), 'passes'),
      pair(t('results.machining'), format.minutes(report.time_min), 'time'),
    ),
    proof(report, chord, isProving, histogram ?? null),
    table(t('results.surface'), [
      ['reached', t('results.reached'), format.percent(reached)],
      ['unreachable', t('results.unreachable'), format.area(missed)],
      ...(unseen > 0 ? [row('unseen', t('results.unseen'), format.area(unseen))] : []),
      ['area', t('results.area'), format.area(report.area_mm2)],
    ]),
    table(t('results.path'), [
      [
        'strategy',
        t('results.strategy'),
        t(`kind.strategy.${report.strategy}`, {}, prettify(report.strategy)),
      ],
      ['links', t('results.links'), format.length(report.length.link_mm)],
      ['rapids', t('results.rapids'), format.length(report.length.rapid_mm)],
      ['points', t('results.points'), format.count(report.points)],
      ...(isPreview ? [] : [row('computed', t('results.computed'), format.seconds(seconds))]),
      ...(proofSeconds === null ? [] : [row('proved', t('results.proved'), format.seconds(proofSeconds))]),
    ]),
    report.warnings.length > 0 &&
      h(
        'div',
        { class: 'warnings' },
        h('h3', {}, t('results.warnings')),
        h('ul', {}, ...report.warnings.map((warning) => h('li', {}, warning))),
      ),
  ].filter((node) => node !== false);
}

/** @param {Report} report @param {number} chord @param {boolean} isProving @param {Float32Array | null} histogram */
function proof({ verified, scallop_mm }, chord, isProving, histogram) {
  const title = h('h3', {}, t('results.proof'));
  if (!verified) {
    const text = t(isProving ? 'results.proof.running' : 'results.proof.none');
    return h(
      'section',
      { class: isProving ? 'proof running' : 'proof' },
      title,
      h('p', { class: 'help' }, text),
    );
  }
  const [id, limit] = verdict(verified, scallop_mm, chord);
  return h(
    'section',
    { class: 'proof' },
    title,
    h(
      'p',
      { class: id === 'good' ? 'verdict good' : 'verdict bad' },
      icon(id === 'good' ? 'good' : 'bad'),
      t(`results.proof.${id}`, { limit }),
    ),
    verified.largest_excess_mm !== null && createDistribution(verified, scallop_mm),
    histogram && histogram.length > 0 && createHistogram(histogram, scallop_mm),
    list(proofRows(verified)),
  );
}

/** Half of the last digit shown, mm. */
const ROUNDING = 0.00005;

/**
 * What the proof comes to, and the limit concerned.
 *
 * @param {Verified} v
 * @param {number} scallop
 * @param {number} chord
 * @returns {[string, string]}
 */
function verdict(v, scallop, chord) {
  // What a sample met is there: the sampling error is only about what none met. Rounding is not told as a miss.
  const over = (/** @type {number} */ value, /** @type {number} */ limit) => value > limit + ROUNDING;
  if (v.largest_excess_mm === null || v.uncut_area_mm2 > 0) return ['uncut', format.area(v.uncut_area_mm2)];
  if (over(-(v.largest_gouge_mm ?? 0), chord)) return ['deep', format.micron(chord)];
  if (over(v.largest_excess_mm, scallop)) return ['high', format.micron(scallop)];
  return ['good', format.micron(scallop)];
}

/** @param {Verified} v @returns {[string, string, string][]} */
function proofRows(v) {
  const micron = (/** @type {number | null} */ mm) =>
    mm === null ? t('results.unknown') : format.micron(mm);
  const blur = v.sampling_error_mm;
  /** @type {[string, string, string][]} */
  const rows = [
    ['excess', t('results.excess'), micron(v.largest_excess_mm)],
    ['gouge', t('results.gouge'), micron(v.largest_gouge_mm)],
    ['error', t('results.error'), blur === null ? t('results.unknown') : `± ${format.micron(blur)}`],
    ['within', t('results.within'), format.percent(v.share_within)],
    ['samples', t('results.samples'), format.count(v.samples)],
  ];
  if (v.uncut_area_mm2 > 0) rows.push(['uncut', t('results.uncut'), format.area(v.uncut_area_mm2)]);
  if (v.excluded_area_mm2 > 0)
    rows.push(['excluded', t('results.excluded'), format.area(v.excluded_area_mm2)]);
  if (v.excluded_gouge_mm < 0)
    rows.push(['excluded-gouge', t('results.excludedGouge'), format.micron(v.excluded_gouge_mm)]);
  return rows;
}

/** @param {string} id @param {string} name @param {string} value @returns {[string, string, string]} */
const row = (id, name, value) => [id, name, value];

/** @param {string} title @param {[string, string, string][]} rows */
function table(title, rows) {
  return h('section', {}, h('h3', {}, title), list(rows));
}

/** @param {[string, string, string][]} rows */
function list(rows) {
  return h('dl', {}, ...rows.map(([id, name, value]) => pair(name, value, id)));
}

/** A figure; what it means is told on request. @param {string} name @param {string} value @param {string} id */
function pair(name, value, id) {
  const meaning = `why.${id}`;
  if (!has(meaning)) return h('div', { 'data-figure': id }, h('dt', {}, name), h('dd', {}, value));
  const why = h('p', { class: 'help why', id: `why-${id}` }, t(meaning));
  why.hidden = true;
  const ask = h(
    'button',
    {
      type: 'button',
      class: 'ask',
      'aria-expanded': 'false',
      'aria-controls': why.id,
      onclick: () => {
        why.hidden = !why.hidden;
        attribute(ask, 'aria-expanded', String(!why.hidden));
      },
    },
    name,
  );
  return h(
    'div',
    { 'data-figure': id },
    h('dt', {}, ask),
    h('dd', {}, value),
    h('dd', { class: 'meaning' }, why),
  );
}
