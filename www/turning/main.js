/**
 * Wires the turning page: settings, plan, proof, picture, plots, the paper's comparisons, and what keeps the work.
 *
 * @import { State } from './types.js'
 * @import { Field, Group, Problem } from '../types.js'
 */
import { compile } from '../compiling.js';
import { createKeeping } from '../keeping.js';
import { keepOffline } from '../offline.js';
import { Cancelled, createPlanner, PlannerError } from '../protocol.js';
import { BadLink } from '../share/link.js';
import { fault, firstFault, withVariant, write } from '../spec.js';
import { attribute, h, place } from '../view/dom.js';
import { acceptDrops } from '../view/drops.js';
import moduleAddress from '../wasm/turning_bg.wasm?url';
import { createAction } from './action.js';
import { createCompare, variants } from './compare.js';
import { createFigures } from './figures.js';
import { createForm } from './form.js';
import { createHead } from './head.js';
import { createLathe, inFile, remember } from './lathe.js';
import { isLink, opened } from './link.js';
import { createOpener } from './opening.js';
import { createPicture } from './picture.js';
import { createPlots } from './plots.js';
import { createSaving } from './saving.js';
import { createState } from './state.js';
import { said, t } from './text.js';

const planner = createPlanner(
  () => compile(moduleAddress),
  () => new Worker(new URL('./worker.js', import.meta.url), { type: 'module', name: 'turning' }),
);
const state = createState(render);
const keeping = createKeeping(
  { onFull: () => complain({ code: '', message: t('error.full') }) },
  'stepover-turning',
);
const open = createOpener(planner, state.get, {
  onSpec: load,
  onLathe: hold,
  onComplaint: (message) => complain({ code: '', message }),
  onError: fail,
});

document.documentElement.lang = t('locale');
document.title = t('title');
for (const element of document.querySelectorAll('[data-text]')) {
  element.textContent = t(element.getAttribute('data-text') ?? '');
}
place('modes').append(
  h('a', { href: './index.html' }, t('mode.milling')),
  h('a', { href: './turning.html', 'aria-current': 'page' }, t('mode.turning')),
);
place('drop').append(h('strong', {}, t('drop')), h('span', {}, t('drop.hint')));

const head = createHead(place('history'), { onUndo: state.undo, onRedo: state.redo, onFiles: open });
const lathe = createLathe({ onPick: head.pickFile, onForget: () => hold(null) });
const form = createForm(place('settings'), {
  above: { limits: lathe.element },
  onEdit: (path, value) => state.edit(write(state.get().draft, path, value), path),
  onVariant: (/** @type {Group} */ group, kind) =>
    state.edit(withVariant(state.get().draft, group, kind), ''),
  onPick: head.pickFile,
});
const saving = createSaving(place('save'));
const views = [
  head,
  form,
  lathe,
  createAction(place('action'), { onPlan: plan, onCancel: () => planner.cancel() }),
  createCompare(place('compare'), { onChoose: choose, onRun: compare }),
  createPicture(place('picture'), { onShow: (shown) => state.set(shown) }),
  createPlots(place('plots'), { onRadius: turn, onAxis: (axis) => state.set({ axis }) }),
  createFigures(place('results')),
  saving,
];

/** @param {State} now */
function render(now) {
  for (const view of views) view.update(now);
  document.body.classList.toggle('dragging', now.dragging);
  attribute(document.documentElement, 'data-job', now.job?.op ?? null);
  keeping.update(now.draft);
}

/** Makes another specification the one that is worked on, and plans it. @param {any} spec */
function load(spec) {
  planner.cancel();
  state.edit(spec, '');
  return plan();
}

/** Makes paths stay within the travels of a lathe, or of none. @param {import('./types.js').Lathe | null} lathe */
function hold(lathe) {
  remember(lathe);
  state.set({ lathe });
}

/** @param {string} guide @param {string} points */
function choose(guide, points) {
  const { schema, draft } = state.get();
  if (!schema) return;
  state.edit(variants(schema, draft, guide, points), '');
  plan();
}

/** Says what is wrong: at its field if there is one. @param {Problem} problem */
function complain(problem) {
  state.set({ problem: { ...problem, message: said(problem.message) } });
  if (problem.field) form.focus(problem.field);
}

/** @param {unknown} error */
function fail(error) {
  if (error instanceof Cancelled) return;
  if (!(error instanceof PlannerError)) throw error;
  const { code, message, field } = error;
  // What is wrong with a lathe's file has no field here: its own name for it is said.
  const text = field?.startsWith('axes.') ? inFile(field, message) : message;
  complain({ code, message: t(`error.${code}`, { message: text }, text), field });
}

/** @param {string} op @param {any[]} args @param {(fraction: number) => number} [whole] */
function ask(op, args, whole = (fraction) => fraction) {
  return planner.call(op, args, (phase, fraction) =>
    state.set({ job: { op, phase, fraction: whole(fraction) } }),
  );
}

/** Runs `work`, and shows what goes wrong where it belongs. @param {() => Promise<void>} work */
async function guarded(work) {
  try {
    await work();
  } catch (error) {
    fail(error);
  }
  state.set({ job: null });
}

/** Of the progress bar, what planning has; the rest is the proof's. */
const PLANNING = 0.35;

function plan() {
  const { schema, draft } = state.get();
  const faultOf = (/** @type {Field} */ field, /** @type {any} */ value) =>
    field.type === 'points' ? null : fault(field, value);
  const wrong = schema && firstFault(schema, draft, faultOf);
  if (wrong) return complain(wrong);
  planner.cancel();
  return guarded(async () => {
    const { draft, lathe } = state.get();
    state.set({ job: { op: 'plan', phase: '', fraction: 0 }, problem: null });
    const outcome = await ask('plan', [draft, lathe?.text], (fraction) => PLANNING * fraction);
    const radius = outcome.report.outermost_mm;
    const motion = await planner.call('motion', [draft, radius]);
    state.set({ outcome, planned: draft, radius, motion });
    const whole = (/** @type {number} */ fraction) => PLANNING + (1 - PLANNING) * fraction;
    state.set({ job: { op: 'prove', phase: '', fraction: PLANNING } });
    const { report, residues, file } = await ask('prove', [], whole);
    state.set({ outcome: { ...outcome, report, residues, files: { ...outcome.files, report: file } } });
  });
}

/** @param {number} radius */
async function turn(radius) {
  state.set({ radius });
  try {
    const motion = await planner.call('motion', [state.get().planned, radius]);
    if (state.get().radius === radius) state.set({ motion });
  } catch (error) {
    fail(error);
  }
}

function compare() {
  return guarded(async () => {
    const { schema, draft } = state.get();
    if (!schema) return;
    state.set({ compared: [], problem: null });
    const all = ['spiral', 'circles'].flatMap((guide) =>
      ['angle', 'arc'].map((points) => ({ guide, points })),
    );
    for (const [i, { guide, points }] of all.entries()) {
      const spec = variants(schema, draft, guide, points);
      const report = await ask('compare', [spec], (fraction) => (i + fraction) / all.length);
      state.set({ compared: [...state.get().compared, { guide, points, report }] });
    }
  });
}

/** The job of the link in the address; `null` if there is none that can be opened. */
async function fromLink() {
  const fragment = location.hash;
  if (!isLink(fragment)) return null;
  try {
    return await planner.call('complete', [JSON.stringify(await opened(fragment))]);
  } catch (error) {
    if (error instanceof BadLink) complain({ code: '', message: t(`error.link.${error.code}`) });
    else fail(error);
    return null;
  } finally {
    // From here on the work is kept in this browser.
    history.replaceState(null, '', location.pathname + location.search);
  }
}

/** What keys do, with Ctrl or ⌘. @type {Record<string, () => void>} */
const SHORTCUTS = {
  enter: plan,
  z: state.undo,
  'shift z': state.redo,
  y: state.redo,
  s: saving.saveJob,
  o: head.pickFile,
};

function acceptKeys() {
  addEventListener('keydown', (event) => {
    if (event.altKey || !(event.ctrlKey || event.metaKey)) return;
    const act = SHORTCUTS[(event.shiftKey ? 'shift ' : '') + event.key.toLowerCase()];
    if (!act) return;
    event.preventDefault();
    act();
  });
}

/** What was worked on last, in the settings of this planner; `null` if it knows them no more. */
async function restored() {
  const kept = await keeping.restore();
  if (!kept) return null;
  try {
    return await planner.call('complete', [JSON.stringify(kept)]);
  } catch {
    return null;
  }
}

async function start() {
  acceptKeys();
  acceptDrops({ onFiles: open, onDragging: (dragging) => state.set({ dragging }) });
  try {
    const { schema, spec } = await planner.call('start', []);
    state.set({ schema });
    const linked = await fromLink();
    const { problem } = state.get();
    state.edit(linked ?? (await restored()) ?? spec, '');
    await plan();
    // A broken link is told of, and work goes on where it was.
    if (problem) state.set({ problem });
  } catch (error) {
    fail(error);
  }
  addEventListener('hashchange', async () => {
    const spec = await fromLink();
    if (spec) load(spec);
  });
  document.documentElement.dataset.ready = '';
  keepOffline();
}

start();
