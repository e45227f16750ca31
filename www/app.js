/**
 * Wires the views to the state and the state to the planner.
 *
 * @import { Draft, Problem, Spec, State, Group } from './types.js'
 */

import { createComparing } from './comparing.js';
import { compile } from './compiling.js';
import { createExploring } from './exploring.js';
import { createForm } from './form.js';
import { createKeeping, recentFiles } from './keeping.js';
import { createMachines } from './machine/open.js';
import { keepOffline, update } from './offline.js';
import { createOpener, LARGEST_FILE } from './opening.js';
import { Cancelled, createPlanner, PlannerError } from './protocol.js';
import { createSession } from './session.js';
import { BadLink, isLink, opened } from './share/link.js';
import { completed, read, withFittingVariants, withVariant, write } from './spec.js';
import { createState } from './state.js';
import { t } from './text/index.js';
import { isInch, switchUnit } from './units.js';
import { createAction } from './view/action.js';
import { createStepoverChart } from './view/chart-stepover.js';
import { createContact } from './view/contact.js';
import { attribute, h, icon, place } from './view/dom.js';
import { createDomain } from './view/domain.js';
import { createDownloads } from './view/downloads.js';
import { acceptDrops } from './view/drops.js';
import { createKeys } from './view/keys.js';
import { languageButton } from './view/language.js';
import { createLegend } from './view/legend.js';
import { createNotice } from './view/notice.js';
import { createPicked } from './view/picked.js';
import { createPlayback } from './view/playback.js';
import { createResults } from './view/results.js';
import { createRuns } from './view/runs.js';
import { printSheet } from './view/setup-sheet.js';
import { createShare } from './view/share.js';
import { createSource } from './view/source.js';
import { createTools } from './view/tools.js';
import moduleAddress from './wasm/stepover_bg.wasm?url';

const planner = createPlanner(() => compile(moduleAddress));
const state = createState(render);
const session = createSession(planner, state, {
  onProblem: complain,
  onError: fail,
  onProven: (draft, outcome) => !isEmbedded && comparing.keep(draft, outcome),
});
const comparing = createComparing(state, { onError: fail });
const exploring = createExploring(state, { onError: fail });
const open = createOpener(planner, state, {
  onDraft: load,
  onComplaint: (message) => show({ code: '', message }),
  onSurface: async (name, bytes) => {
    await recentFiles.keep(name, bytes);
    showRecent();
  },
  onError: fail,
});
/** @type {ReturnType<typeof import('./view/canvas3d.js').createCanvas3d> | null} */
let canvas = null;
let isDrawn = false;
/** In a frame of another page there is the picture alone. */
const isEmbedded = new URLSearchParams(location.search).has('embed');
document.documentElement.classList.toggle('embedded', isEmbedded);

const undo = h(
  'button',
  { type: 'button', class: 'quiet', name: 'undo', onclick: () => state.undo() },
  icon('undo'),
);
const redo = h(
  'button',
  { type: 'button', class: 'quiet', name: 'redo', onclick: () => state.redo() },
  icon('redo'),
);
attribute(undo, 'aria-label', t('action.undo'));
attribute(redo, 'aria-label', t('action.redo'));
undo.title = t('action.undo');
redo.title = t('action.redo');
place('history').append(undo, redo);
createShare(place('history'), () => state.get());
const keys = createKeys(document.body);
const help = h('button', { type: 'button', class: 'quiet', name: 'keys', onclick: keys.show }, '?');
attribute(help, 'aria-label', t('keys.title'));
help.title = t('keys.title');
document.documentElement.lang = t('locale');
const unit = h(
  'button',
  { type: 'button', class: 'quiet', name: 'unit', title: t('action.unit.hint'), onclick: switchUnit },
  t(isInch ? 'action.unit.mm' : 'action.unit'),
);
place('history').append(unit, languageButton(), help);
const renew = h(
  'button',
  { type: 'button', class: 'small', name: 'update', onclick: update },
  t('action.update'),
);
renew.hidden = true;
place('history').prepend(renew);
const keeping = createKeeping({ onFull: () => show({ code: 'full', message: '' }) });

const source = createSource(place('source'), {
  onPick: pick,
  onFiles: open,
  onRecent: openAgain,
  onForget: async (name) => {
    await recentFiles.forget(name);
    showRecent();
  },
  onFace: (index) => editSource('face', index),
  onUnit: (unit) => editSource('unit', unit),
  onScale: (scale) => editSource('scale', scale),
  onSide: () => editSource('side', state.get().draft?.spec.source.side === 'back' ? 'front' : 'back'),
  limit: LARGEST_FILE,
});
const form = createForm(place('settings'), {
  onEdit: editField,
  onVariant: editVariant,
  onChart: () => editChart({ isOpen: true }),
  onPicking: (path) => state.set({ picking: state.get().picking === path ? null : path }),
});
const domain = createDomain(place('domain'));
const downloads = createDownloads(place('save'), {
  onDrawing: exploring.drawing,
  onPicture: () => canvas?.copy() ?? null,
  onDomain: domain.drawing,
  onSheet: () => printSheet(state.get(), canvas?.copy() ?? null),
});
const playback = createPlayback(place('scrub'), { onAt: (at) => state.set({ at }) });
const tools = createTools(
  { views: place('views'), layers: place('layers') },
  {
    onView: (view) => canvas?.look(view),
    onParallel: (isParallel) => canvas?.project(isParallel),
    onFlat: (isFlat) => state.set({ isFlat }),
    onLayers: (layers) => {
      // A range belongs to what it is the range of.
      const range = layers.tint === state.get().layers.tint ? state.get().range : null;
      state.set({ layers, range });
    },
  },
);
const views = [
  playback,
  tools,
  source,
  form,
  createAction(place('action'), { onPlan: session.plan, onCancel: session.cancel }),
  createNotice(place('notice'), { onClose: () => state.set({ problem: null }) }),
  createResults(place('results')),
  createContact(place('contact')),
  downloads,
  createMachines(
    { panel: place('machine-panel'), drawing: place('machine-drawing') },
    { onAt: (at) => state.set({ at }) },
  ),
  createLegend(place('legend'), { onRange: (range) => state.set({ range }) }),
  createPicked(place('picked'), { onClose: () => state.set({ picked: null }) }),
  createRuns(place('runs'), {
    onCompare: comparing.run,
    onCancel: comparing.cancel,
    onLay: comparing.lay,
    onTake: (draft) => state.edit(draft, ''),
    onClear: comparing.clear,
  }),
  domain,
  createStepoverChart(place('chart'), {
    onClose: () => editChart({ isOpen: false }),
    onRadius: (radius) => editChart({ radius }),
  }),
];

/** @param {State} now */
function render(now) {
  for (const view of views) view.update(now);
  canvas?.update(now);
  undo.disabled = !now.canUndo;
  redo.disabled = !now.canRedo;
  document.body.classList.toggle('dragging', now.dragging);
  // What is not filled yet is not shown either: it would only move.
  const isFilled = now.draft !== null || now.problem !== null;
  attribute(document.documentElement, 'data-filled', isFilled ? '' : null);
  if (now.outcome || now.problem) document.documentElement.dataset.planned = '';
  // Ready is when there is something to look at, or word of why not.
  if (isDrawn && (now.outcome || now.problem)) document.documentElement.dataset.ready = '';
  attribute(document.documentElement, 'data-job', now.job?.op ?? null);
  session.refresh(now);
  exploring.refresh(now);
  // What is looked at in a course page is nobody's work.
  if (!isEmbedded) keeping.update(now.draft);
}

/** @param {Spec} spec @param {string} what */
function editSpec(spec, what) {
  const { draft } = state.get();
  if (draft) state.edit({ ...draft, spec }, what);
}

/** @param {Partial<import('./types.js').Chart>} change */
function editChart(change) {
  state.set({ chart: { ...state.get().chart, ...change } });
}

/** @param {string} path @param {any} value */
function editField(path, value) {
  const { draft } = state.get();
  // Another choice may hide the field that points are picked for.
  if (path !== state.get().picking) state.set({ picking: null });
  if (draft) editSpec(write(draft.spec, path, value), path);
}

/** Appends a point of the surface, mm, to the field that points are picked for. @param {number[]} point */
function appendPoint(point) {
  const { draft, picking } = state.get();
  if (!draft || !picking) return;
  // A micrometre: nobody clicks more exactly.
  const rounded = point.map((x) => Math.round(x * 1e3) / 1e3);
  editSpec(write(draft.spec, picking, [...(read(draft.spec, picking) ?? []), rounded]), '');
}

/** @param {Group} group @param {string} kind */
function editVariant(group, kind) {
  state.set({ picking: null });
  const { draft } = state.get();
  if (draft) editSpec(withVariant(draft.spec, group, kind), '');
}

/** @param {string} name @param {any} value */
function editSource(name, value) {
  const { draft, schema, layers } = state.get();
  if (!draft || !schema) return;
  const spec = write(draft.spec, `source.${name}`, value);
  // Factors are typed digit by digit: one step of undo.
  const what = name === 'scale' ? 'source.scale' : '';
  state.edit(withFittingVariants(schema, { ...draft, spec }), what);
  // Whoever turns the side wants to see it.
  if (name === 'side') state.set({ layers: { ...layers, side: true } });
}

/** Shows an item of the gallery and plans it. @param {string} id */
function pick(id) {
  const item = state.get().gallery.find((g) => g.id === id);
  if (!item) return;
  load({ spec: item.spec, source: { id, name: item.spec.name || id, bytes: null, info: null } });
  return session.plan();
}

/** Makes another draft the one that is worked on; what was computed belongs to the one before. @param {Draft} draft */
function load(draft) {
  const { schema } = state.get();
  session.cancel();
  state.edit(schema ? withFittingVariants(schema, draft) : draft, '');
  state.set({
    outcome: null,
    planned: null,
    picture: null,
    job: null,
    at: 1,
    picking: null,
    picked: null,
    range: null,
  });
}

async function showRecent() {
  const files = await recentFiles.all();
  state.set({ recent: files.map(({ name, file }) => ({ name, size: file.size })) });
}

/** @param {string} name */
async function openAgain(name) {
  const found = (await recentFiles.all()).find((kept) => kept.name === name);
  if (found) open([new File([found.file], name)]);
}

/** @param {unknown} error */
function fail(error) {
  if (error instanceof Cancelled) return;
  const { code, message, field } =
    error instanceof PlannerError ? error : { code: 'page', message: String(error), field: undefined };
  // The field's name is said by where the message stands.
  const text = field && message.startsWith(`${field}: `) ? message.slice(field.length + 2) : message;
  show({ code, message: text, field });
}

/** Says what keeps a plan from starting. @param {Problem} problem */
function complain({ code, message, field }) {
  if (code === 'job_file') show({ code: '', message: t('error.job_file', { name: message }) });
  else show({ code, message: code === 'unit' ? t('fault.unit') : '', field });
}

/** Opens the link in the address; whether there was one that could be opened. */
async function openLink() {
  const fragment = location.hash;
  const { schema } = state.get();
  if (!isLink(fragment) || !schema) return false;
  try {
    const shared = await opened(fragment);
    if (shared.spec.version !== schema.version) throw new BadLink('new');
    load({
      spec: completed(schema, shared.spec),
      source: { id: null, name: shared.name, bytes: null, info: null },
    });
    const { draft } = state.get();
    state.set({ outcome: shared.outcome, planned: draft, picture: shared.outcome?.picture ?? null });
    document.title = `${shared.name} – ${t('title')}`;
    if (!shared.isPreview) session.plan();
    return true;
  } catch (error) {
    if (!(error instanceof BadLink)) throw error;
    show({ code: '', message: t(`error.link.${error.code}`) });
    return false;
  } finally {
    // From here on the work is kept in this browser. An embedded picture may be loaded again.
    if (!isEmbedded) history.replaceState(null, '', location.pathname + location.search);
  }
}

/** Says what is wrong: at its field if there is one. @param {Problem} problem */
function show(problem) {
  state.set({ problem });
  queueMicrotask(() => {
    if (!problem.field) return;
    if (problem.field === 'source.unit') source.focusUnit();
    else form.focus(problem.field);
  });
}

/** What keys do, by their names; with Ctrl or ⌘ where that is part of the name. @type {Record<string, () => void>} */
const SHORTCUTS = {
  'ctrl enter': () => session.plan(),
  'ctrl z': () => state.undo(),
  'ctrl shift z': () => state.redo(),
  'ctrl y': () => state.redo(),
  'ctrl s': () => downloads.saveJob(),
  'ctrl o': () => source.pickFile(),
  1: () => canvas?.look('top'),
  2: () => canvas?.look('front'),
  3: () => canvas?.look('right'),
  4: () => canvas?.look('iso'),
  0: () => canvas?.look('fit'),
  o: () => tools.switchLens(),
  u: () => state.set({ isFlat: !state.get().isFlat }),
  ' ': () => playback.toggle(),
  ',': () => playback.step(-1),
  '.': () => playback.step(1),
  '?': () => keys.show(),
};

function acceptKeys() {
  addEventListener('keydown', (event) => {
    if (event.altKey) return;
    const { target } = event;
    const isCommand = event.ctrlKey || event.metaKey;
    // Elsewhere a letter is a letter, and the space bar presses what has the focus.
    const isTyping =
      target instanceof Element && target.closest('input, select, textarea, button, summary, a, dialog');
    if (!isCommand && isTyping) return;
    const shift = isCommand && event.shiftKey ? 'shift ' : '';
    const act = SHORTCUTS[(isCommand ? 'ctrl ' : '') + shift + event.key.toLowerCase()];
    if (!act) return;
    event.preventDefault();
    act();
  });
}

async function start() {
  for (const element of document.querySelectorAll('[data-text]')) {
    element.textContent = t(/** @type {HTMLElement} */ (element).dataset.text ?? '');
  }
  attribute(place('views'), 'aria-label', t('canvas.views'));
  attribute(place('layers'), 'aria-label', t('canvas.layers'));
  place('drop').append(h('strong', {}, t('surface.drop')), h('span', {}, t('surface.drop.hint')));
  acceptDrops({ onFiles: open, onDragging: (dragging) => state.set({ dragging }) });
  acceptKeys();
  // The picture's code is the largest part of the page: the planner is at work while it loads.
  const drawing = import('./view/canvas3d.js')
    .then(({ createCanvas3d }) => {
      canvas = createCanvas3d(place('canvas'), {
        onFace: (index) => editSource('face', index),
        onAt: (at) => state.set({ at }),
        onPoint: appendPoint,
        onPick: exploring.pick,
      });
      canvas.update(state.get());
    })
    .catch(() => place('canvas').append(h('p', { class: 'help' }, t('canvas.none'))));
  try {
    const { schema, gallery } = await planner.call('start', []);
    state.set({ schema, gallery });
    addEventListener('hashchange', () => openLink().catch(fail));
    if (!(await openLink())) {
      // A broken link is told of, and work goes on where it was.
      const { problem } = state.get();
      const kept = isEmbedded ? null : await keeping.restore();
      if (kept) {
        load({ ...kept, spec: completed(schema, kept.spec) });
        session.plan();
      } else if (gallery.length > 0) pick(gallery[0].id);
      if (problem) show(problem);
    }
  } catch (error) {
    fail(error);
  }
  await drawing;
  isDrawn = true;
  state.set({});
  showRecent();
  // Last: what it loads once more must not delay what somebody waits for.
  keepOffline(() => {
    renew.hidden = false;
  });
}

start();
