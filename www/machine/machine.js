/**
 * Wires machines: choice, settings, program, proof, plots and the machine that moves with the playhead.
 *
 * @import { State } from './types.js'
 * @import { State as PageState } from '../types.js'
 */
import './machine.css';
import { compile } from '../compiling.js';
import { bytes } from '../format.js';
import { Cancelled, createPlanner, PlannerError } from '../protocol.js';
import { completed, firstFault, write } from '../spec.js';
import { h, say } from '../view/dom.js';
import { save } from '../view/saving.js';
import { shareAt } from '../view/way.js';
import moduleAddress from '../wasm/machines_bg.wasm?url';
import { createDrawing } from './drawing.js';
import { createFigures } from './figures.js';
import { createForm } from './form.js';
import { OWN, recall, remember } from './keeping.js';
import { createNotes } from './notes.js';
import { createPlots } from './plots.js';
import { createProblem } from './problem.js';
import { createSaving } from './saving.js';
import { t } from './text.js';

/** At the very end the whole path is shown, and the place is not. */
const AT_END = 0.999999;
/** A machine's file is a page of text. */
const LARGEST_FILE = 1e6;
/** Share of the progress that writing has; the rest is the proof's. */
const WRITING = 0.4;
/**
 * @param {{ panel: HTMLElement, drawing: HTMLElement }} roots
 * @param {{ onAt: (at: number) => void }} callbacks
 */
export function createMachine({ panel, drawing }, { onAt }) {
  const planner = createPlanner(
    () => compile(moduleAddress),
    () => new Worker(new URL('./machine-worker.js', import.meta.url), { type: 'module', name: 'machines' }),
  );
  const kept = recall();
  /** @type {State} */
  let state = {
    machines: kept.own ? [kept.own] : [],
    schema: null,
    chosen: kept.chosen ?? 'table_table_ac',
    options: kept.options ?? {},
    job: null,
    problem: null,
    work: null,
    kept: null,
    madeOf: null,
    dialect: '',
    moment: null,
    outcome: null,
    planned: null,
    at: 1,
  };

  const part = (/** @type {string} */ name) => h('div', { class: `machine-${name}` });
  const machine = h('select', {
    name: 'machine.file',
    id: 'machine-file',
    onchange: () => choose(machine.value),
  });
  const file = h('input', {
    type: 'file',
    accept: '.json,application/json',
    class: 'hidden',
    name: 'machine-own',
    tabindex: -1,
    'aria-hidden': 'true',
  });
  file.addEventListener('change', () => file.files?.[0] && openFile(file.files[0]));
  const dialect = part('dialect');
  const more = h('div', { class: 'groups' });
  const action = part('action');
  const problem = h('div', { class: 'machine-problem', role: 'alert' });
  const stale = h('p', { class: 'stale' }, t('stale'));
  const figures = part('result');
  const notes = part('notes');
  const plots = part('plots');
  const saving = h('div', { class: 'downloads' });
  panel.append(
    h(
      'div',
      { class: 'field choice' },
      h('label', { for: 'machine-file' }, t('machine')),
      h('span', { class: 'value' }, machine),
    ),
    h(
      'p',
      { class: 'machine-files' },
      h(
        'button',
        { type: 'button', class: 'small', name: 'machine-open', onclick: () => file.click() },
        t('open.own'),
      ),
      h(
        'button',
        {
          type: 'button',
          class: 'small',
          name: 'machine-save',
          title: t('save.machine.hint'),
          onclick: saveMachine,
        },
        t('save.machine'),
      ),
      file,
    ),
    dialect,
    h('details', {}, h('summary', {}, h('h3', {}, t('settings'))), more),
    action,
    problem,
    stale,
    figures,
    notes,
    plots,
    saving,
  );

  const writeButton = h(
    'button',
    { type: 'button', class: 'primary', name: 'machine-write', onclick: run },
    t('write'),
  );
  const bar = h('progress', { max: 1, value: 0, 'aria-label': t('progress') });
  const phase = h('span', { class: 'phase' });
  const cancel = h('button', { type: 'button', name: 'machine-cancel', onclick: stop }, t('cancel'));
  const busy = h(
    'div',
    { class: 'busy' },
    h('div', { class: 'status' }, h('div', { class: 'words' }, phase), bar),
    cancel,
  );
  action.append(busy, writeButton);

  const form = createForm(
    { dialect, more },
    { onEdit: (path, value) => edit(write(state.options, path, value)) },
  );
  const curves = createPlots(plots, {
    onSeconds: goToSeconds,
    ask: (...args) => ask('bands', [axes(), ...args]),
  });
  /** Each with what it shows: while the machine moves, a moment follows another, and nothing else is drawn. @type {[{ update: (state: State) => void }, (keyof State)[]][]} */
  const views = [
    [{ update: showAction }, ['job', 'work', 'outcome', 'madeOf', 'machines', 'chosen', 'schema']],
    [form, ['schema', 'options', 'problem']],
    [createFigures(figures), ['work', 'kept', 'job']],
    [createNotes(notes, { onMove: goTo }), ['work']],
    [curves, ['work', 'moment']],
    [createDrawing(drawing), ['work', 'moment']],
    [createProblem(problem, { onMove: goTo }), ['problem']],
    [createSaving(saving), ['work', 'planned', 'dialect']],
  ];
  for (const [view] of views) view.update(state);

  /** @param {Partial<State>} change */
  function set(change) {
    const before = state;
    state = { ...state, ...change };
    for (const [view, shown] of views) {
      if (shown.some((name) => before[name] !== state[name])) view.update(state);
    }
  }

  function showAction() {
    const { job, work, outcome, madeOf, machines, chosen } = state;
    const names = machines.map(({ id, name }) =>
      id === OWN ? t('own', { name }) : t(`name.${id}`, {}, name),
    );
    if (
      machine.options.length !== machines.length ||
      names.some((name, k) => machine.options[k].text !== name)
    ) {
      machine.replaceChildren(...machines.map(({ id }, k) => h('option', { value: id }, names[k])));
    }
    machine.value = chosen;
    const hasFocus = document.activeElement;
    busy.hidden = !job;
    writeButton.hidden = job !== null;
    writeButton.disabled = !outcome?.files || state.schema === null;
    say(writeButton, t(work ? 'again' : 'write'));
    if (job) {
      bar.value = job.fraction;
      say(phase, t(`phase.${job.phase}`, {}, job.phase));
    }
    if (hasFocus === writeButton && writeButton.hidden) cancel.focus();
    if (hasFocus === cancel && busy.hidden) writeButton.focus();
    const isPreview = outcome !== null && !outcome.files;
    stale.hidden = !(isPreview || (work !== null && madeOf !== outcome?.path));
    say(stale, t(isPreview ? 'none' : 'stale'));
  }

  /** @param {any} options */
  function edit(options) {
    set({ options, problem: null });
    remember(state);
  }

  /** @param {string} id */
  function choose(id) {
    set({ chosen: id, problem: null });
    remember(state);
  }

  function chosen() {
    return state.machines.find(({ id }) => id === state.chosen) ?? state.machines[0];
  }

  /** @param {File} opened */
  async function openFile(opened) {
    file.value = '';
    try {
      if (opened.size > LARGEST_FILE)
        throw new PlannerError({ code: '', message: `${opened.name}: > ${bytes(LARGEST_FILE)}` });
      const text = await opened.text();
      const name = await ask('name', [text]);
      const others = state.machines.filter(({ id }) => id !== OWN);
      set({ machines: [...others, { id: OWN, name, text }], chosen: OWN, problem: null });
      remember(state);
    } catch (error) {
      fail(error, `${opened.name}: `);
    }
  }

  function saveMachine() {
    const { id, text } = chosen();
    save(new Blob([text], { type: 'application/json' }), `${id}.json`);
  }

  /** @param {string} op @param {any[]} args @param {number} [from] @param {number} [to] */
  function ask(op, args, from = 0, to = 1) {
    return planner.call(op, args, (phaseName, fraction) => {
      if (state.job)
        set({ job: { ...state.job, phase: phaseName, fraction: from + (to - from) * fraction } });
    });
  }

  /** Writes the program and proves it. */
  async function run() {
    const { outcome, planned, options } = state;
    if (!outcome?.files || !planned) return;
    const wrong = state.schema && firstFault(state.schema, state.options)?.field;
    if (wrong) {
      document.getElementById(`machine-${wrong}`)?.closest('details')?.setAttribute('open', '');
      document.getElementById(`machine-${wrong}`)?.focus();
      return;
    }
    const made = { text: chosen().text, options };
    set({ job: { op: 'post', phase: '', fraction: 0 }, problem: null });
    try {
      const work = await post(outcome, made);
      set({ work, kept: null, madeOf: outcome.path, dialect: options.program.dialect, moment: null });
      await showMoment();
      set({ job: { op: 'prove', phase: '', fraction: WRITING } });
      lastMade = { outcome, made };
      // What is cut does not tell how it was planned, which this module need not know.
      const { strategy: _, ...cut } = planned.spec;
      const proof = await ask('prove', [cut, planned.source.bytes], WRITING, 1);
      if (state.work === work) set({ kept: proof });
    } catch (error) {
      fail(error);
      // What cannot be written any more is not kept as if it could.
      if (error instanceof PlannerError && state.job?.op === 'post')
        set({ work: null, kept: null, moment: null });
    }
    set({ job: null });
  }

  /** @type {{ outcome: any, made: { text: string, options: any } } | null} */
  let lastMade = null;

  /** @param {any} outcome @param {{ text: string, options: any }} made */
  function post(outcome, { text, options }) {
    return ask('post', [outcome.files.apt, outcome.files.csv, text, options], 0, WRITING);
  }

  /** Gives up what runs. The worker is gone with what it held: a program that was there is made once more, unseen. */
  async function stop() {
    const again = state.work ? lastMade : null;
    planner.cancel();
    if (!again) return;
    try {
      await post(again.outcome, again.made);
    } catch (error) {
      fail(error);
    }
  }

  /** @param {unknown} error @param {string} [where] */
  function fail(error, where = '') {
    if (error instanceof Cancelled) return;
    const { code, message, field } =
      error instanceof PlannerError ? error : { code: 'page', message: String(error), field: undefined };
    set({ problem: { code, message: `${where}${message}`, field } });
  }

  /** The playhead at the end of a move. @param {number} move */
  function goTo(move) {
    const path = state.outcome?.path;
    if (!path) return;
    onAt(Math.min(shareAt(path, move), AT_END));
  }

  /** @param {number} seconds */
  async function goToSeconds(seconds) {
    onAt(Math.min(await planner.call('share', [seconds]), AT_END));
  }

  function axes() {
    return (state.work?.report.axes ?? []).map((_, k) => k);
  }

  let wanted = -1;
  let isAsking = false;
  /** Asks for the moment of the playhead, one at a time: while it is played only the last one counts. */
  async function showMoment() {
    if (isAsking || !state.work) return;
    isAsking = true;
    try {
      while (wanted !== state.at || !state.moment) {
        wanted = state.at;
        const moment = await planner.call('moment', [wanted]);
        if (!moment) break;
        set({ moment });
      }
    } catch (error) {
      fail(error);
    } finally {
      isAsking = false;
    }
  }

  async function start() {
    try {
      const { schema, machines } = await planner.call('start', []);
      const own = state.machines.filter(({ id }) => id === OWN);
      const all = [...machines, ...own];
      const isThere = all.some(({ id }) => id === state.chosen);
      set({
        schema,
        machines: all,
        chosen: isThere ? state.chosen : all[0].id,
        options: completed(schema, state.options),
      });
    } catch (error) {
      fail(error);
    }
  }
  start();

  return {
    /** @param {PageState} page */
    update({ outcome, planned, at }) {
      if (outcome === state.outcome && planned === state.planned && at === state.at) return;
      const isMoved = at !== state.at;
      set({ outcome, planned, at });
      if (isMoved) showMoment();
    },
  };
}
