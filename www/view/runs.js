/**
 * What was planned so far, in one table; each row can be laid over the picture or taken up again.
 *
 * @import { Draft, Run, State } from '../types.js'
 */
import { runsOf } from '../comparing.js';
import * as format from '../format.js';
import { plain } from '../format.js';
import { prettify, t } from '../text/index.js';
import { OVERLAYS } from './colors.js';
import { h, say } from './dom.js';

/** Figures by which the table can be ordered, each with how it is read and told. @type {[string, (run: Run) => number, (value: number) => string][]} */
const COLUMNS = [
  ['length', ({ report }) => report.length.cut_mm, format.length],
  [
    'floor',
    ({ report, floor }) => (floor ? report.length.cut_mm / floor : NaN),
    (x) => `× ${plain(Number(x.toFixed(3)))}`,
  ],
  ['passes', ({ report }) => report.passes, format.count],
  ['time', ({ report }) => report.time_min, format.minutes],
  ['excess', ({ report }) => report.verified?.largest_excess_mm ?? NaN, format.micron],
  ['gouge', ({ report }) => report.verified?.largest_gouge_mm ?? NaN, format.micron],
];

/** Those of which less is better; excess only has to keep within its limit. */
const RANKED = new Set(['length', 'floor', 'passes', 'time']);

/**
 * @param {HTMLElement} root
 * @param {{ onCompare: () => void, onCancel: () => void, onLay: (id: number) => void, onTake: (draft: Draft) => void,
 *   onClear: () => void }} callbacks
 */
export function createRuns(root, { onCompare, onCancel, onLay, onTake, onClear }) {
  const compare = h('button', { type: 'button', name: 'compare', onclick: onCompare }, t('runs.compare'));
  const bar = h('progress', { max: 1, value: 0, 'aria-label': t('progress.title') });
  const phase = h('span', { class: 'phase' });
  const cancel = h(
    'button',
    { type: 'button', class: 'small', name: 'stop-comparing', onclick: onCancel },
    t('action.cancel'),
  );
  const busy = h('div', { class: 'busy' }, h('div', { class: 'status' }, phase, bar), cancel);
  const clear = h(
    'button',
    { type: 'button', class: 'small', name: 'clear-runs', onclick: onClear },
    t('runs.clear'),
  );
  // Roles are named because the layout is no table's, for which some browsers take them away.
  const table = h('table', { class: 'runs', role: 'table', 'aria-label': t('runs.title') });
  const floor = h('p', { class: 'help' });
  root.append(h('p', { class: 'help' }, t('runs.about')), compare, busy, table, floor, clear);
  const unfit = h('ul', { class: 'help' });
  root.append(unfit);
  let by = 'length';
  /** @type {unknown[]} */
  let shown = [];
  /** @type {State | null} */
  let last = null;

  /** @param {string} name */
  function order(name) {
    by = name;
    shown = [];
    if (last) fill(last);
  }

  /** @param {State} state */
  function fill(state) {
    const runs = runsOf(state);
    const [, read] = COLUMNS.find(([name]) => name === by) ?? COLUMNS[0];
    const rank = (/** @type {Run} */ run) => (Number.isFinite(read(run)) ? read(run) : Infinity);
    const sorted = [...runs].sort((a, b) => rank(a) - rank(b));
    const used = COLUMNS.filter(([name]) => name !== 'floor' || runs.some((run) => run.floor));
    const best = used.map(([, value]) => Math.min(...runs.map(value).filter(Number.isFinite)));
    const least = runs.find((run) => run.floor)?.floor;
    say(floor, least ? t('runs.floor.note', { length: format.length(least) }) : '');
    floor.hidden = !least;
    table.hidden = clear.hidden = runs.length === 0;
    unfit.replaceChildren(
      ...state.unfit.map(({ name, message }) =>
        h('li', {}, `${prettify(name.replaceAll('-', '_'))}: ${message}`),
      ),
    );
    table.replaceChildren(
      h('caption', {}, t('runs.caption')),
      h(
        'thead',
        { role: 'rowgroup' },
        h(
          'tr',
          { role: 'row' },
          h('th', { scope: 'col', role: 'columnheader' }, t('runs.strategy')),
          ...used.map(([name]) =>
            h(
              'th',
              { scope: 'col', role: 'columnheader', 'aria-sort': name === by ? 'ascending' : null },
              h('button', { type: 'button', onclick: () => order(name) }, t(`runs.${name}`)),
            ),
          ),
        ),
      ),
      h('tbody', { role: 'rowgroup' }, ...sorted.map((run) => row(run, used, best, state))),
    );
  }

  /** @param {Run} run @param {typeof COLUMNS} used @param {number[]} best @param {State} state */
  function row(run, used, best, state) {
    const laid = runsOf(state).filter(({ isLaid }) => isLaid);
    const lay = h('input', {
      type: 'checkbox',
      'aria-label': t('runs.lay', { name: nameOf(run.draft) }),
      onchange: () => onLay(run.id),
    });
    lay.checked = run.isLaid;
    const swatch = h('i', { 'aria-hidden': 'true' });
    if (run.isLaid) swatch.style.background = OVERLAYS[laid.indexOf(run) % OVERLAYS.length];
    const take = h(
      'button',
      { type: 'button', class: 'name', title: t('runs.take'), onclick: () => onTake(run.draft) },
      nameOf(run.draft),
    );
    const isShown = state.planned?.spec === run.draft.spec;
    return h(
      'tr',
      { role: 'row', class: isShown ? 'shown' : null },
      h('th', { scope: 'row', role: 'rowheader' }, h('label', { class: 'lay' }, lay, swatch), take),
      ...used.map(([name, value, told], k) => {
        const number = value(run);
        const isBest = RANKED.has(name) && number === best[k] && runsOf(state).length > 1;
        return h(
          'td',
          { role: 'cell', class: isBest ? 'best' : null },
          Number.isFinite(number) ? told(number) : '–',
        );
      }),
    );
  }

  return {
    /** @param {State} state */
    update(state) {
      last = state;
      const { comparison, runs, draft, planned, unfit: failed } = state;
      busy.hidden = comparison === null;
      compare.hidden = comparison !== null;
      compare.disabled = !draft;
      bar.value = comparison?.fraction ?? 0;
      say(phase, comparison ? t('runs.at', { name: prettify(comparison.name.replaceAll('-', '_')) }) : '');
      const now = [runs, failed, draft?.spec.source, draft?.source.bytes, planned];
      if (now.every((part, i) => part === shown[i]) && shown.length > 0) return;
      shown = now;
      fill(state);
    },
  };
}

/** A job's strategy in a few words. @param {Draft} draft */
export function nameOf({ spec: { strategy } }) {
  const words = [t(`kind.strategy.${strategy.kind}`, {}, prettify(strategy.kind))];
  if (strategy.kind === 'iso_parametric') words.push(strategy.along);
  if (strategy.kind === 'iso_planar' || strategy.kind === 'raster')
    words.push(`${plain(strategy.angle_deg)}°`);
  if (strategy.kind === 'constant_scallop')
    words.push(t(`choice.${strategy.start}`, {}, prettify(strategy.start)));
  if (strategy.kind === 'flow' && strategy.families === 'several') words.push(t('choice.several'));
  if (strategy.kind === 'potential_field') words.push(`${plain(strategy.least_efficiency_percent)} %`);
  if (strategy.rule && strategy.rule !== 'fixed') words.push(t(`choice.${strategy.rule}`));
  else if (strategy.rule) words.push(`λ ${plain(strategy.lead_deg)}°`);
  return words.join(' · ');
}
