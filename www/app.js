/**
 * Wires the views to the state and the state to the planner.
 *
 * @import { Draft, Problem, Source, Spec, State, Group } from './types.js'
 */

import { createForm } from './form.js';
import { bytes as size } from './format.js';
import { Cancelled, createPlanner, PlannerError } from './protocol.js';
import { firstProblem, withFittingVariants, withVariant, write } from './spec.js';
import { createState } from './state.js';
import { t } from './text/index.js';
import { createAction } from './view/action.js';
import { attribute, h, icon } from './view/dom.js';
import { createDownloads } from './view/downloads.js';
import { createLegend } from './view/legend.js';
import { createNotice } from './view/notice.js';
import { createResults } from './view/results.js';
import { createSource } from './view/source.js';
import { createTools } from './view/tools.js';
import moduleAddress from './wasm/stepover_bg.wasm?url';

/** Larger files than this do not fit the planner's memory together with what is computed from them. */
const LARGEST_FILE = 128e6;
/** Of larger files only the chosen face is drawn: each face is read from the file anew. */
const MOST_FACES = 40;
const MOST_FACE_BYTES = 8e6;

/** @param {string} id */
function place(id) {
  const element = document.getElementById(id);
  if (!element) throw new Error(`no element #${id}`);
  return element;
}

async function compile() {
  const response = await fetch(moduleAddress);
  if (!response.ok) throw new Error(`${response.status} ${response.statusText}`);
  // A host that does not know the type of WebAssembly is no reason to fail.
  const known = response.headers.get('content-type')?.startsWith('application/wasm');
  return known ? WebAssembly.compileStreaming(response) : WebAssembly.compile(await response.arrayBuffer());
}

const planner = createPlanner(compile);
const state = createState(render);
/** @type {{ update: (state: State) => void, look: (view: string) => void } | null} */
let canvas = null;

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

const source = createSource(place('source'), {
  onPick: pick,
  onFiles: open,
  onFace: (index) => editSource('face', index),
  onUnit: (unit) => editSource('unit', unit),
  onSide: () => editSource('side', state.get().draft?.spec.source.side === 'back' ? 'front' : 'back'),
  limit: LARGEST_FILE,
});
const form = createForm(place('settings'), { onEdit: editField, onVariant: editVariant });
const views = [
  source,
  form,
  createAction(place('action'), { onPlan: plan, onCancel: () => planner.cancel() }),
  createNotice(place('notice'), { onClose: () => state.set({ problem: null }) }),
  createResults(place('results')),
  createDownloads(place('save')),
  createLegend(place('legend')),
  createTools(
    { views: place('views'), layers: place('layers'), scrub: place('scrub') },
    {
      onView: (view) => canvas?.look(view),
      onLayers: (layers) => state.set({ layers }),
      onAt: (at) => state.set({ at }),
    },
  ),
];

/** @type {{ bytes: unknown, key: string, failed: Set<number>, busy: boolean }} */
let drawn = { bytes: undefined, key: '', failed: new Set(), busy: false };

/** What the picture in the state was made from. @type {{ source: any, bytes: any } | null} */
let pictured = null;

/** @param {State} now */
function render(now) {
  for (const view of views) view.update(now);
  canvas?.update(now);
  undo.disabled = !now.canUndo;
  redo.disabled = !now.canRedo;
  document.body.classList.toggle('dragging', now.dragging);
  attribute(document.documentElement, 'data-job', now.job?.op ?? null);
  if (now.job?.op !== 'plan') refreshPicture(now);
  refreshFaces(now);
}

/** @param {Spec} spec @param {string} what */
function editSpec(spec, what) {
  const { draft } = state.get();
  if (draft) state.edit({ ...draft, spec }, what);
}

/** @param {string} path @param {any} value */
function editField(path, value) {
  const { draft } = state.get();
  if (draft) editSpec(write(draft.spec, path, value), path);
}

/** @param {Group} group @param {string} kind */
function editVariant(group, kind) {
  const { draft } = state.get();
  if (draft) editSpec(withVariant(draft.spec, group, kind), '');
}

/** @param {string} name @param {any} value */
function editSource(name, value) {
  const { draft, schema, layers } = state.get();
  if (!draft || !schema) return;
  const spec = write(draft.spec, `source.${name}`, value);
  state.edit(withFittingVariants(schema, { ...draft, spec }), '');
  // Whoever turns the side wants to see it.
  if (name === 'side') state.set({ layers: { ...layers, side: true } });
}

/** Shows an item of the gallery and plans it. @param {string} id */
function pick(id) {
  const item = state.get().gallery.find((g) => g.id === id);
  if (!item) return;
  load({ spec: item.spec, source: { id, name: item.spec.name || id, bytes: null, info: null } });
  return plan();
}

/** Makes another draft the one that is worked on; what was computed belongs to the one before. @param {Draft} draft */
function load(draft) {
  const { schema } = state.get();
  planner.cancel();
  state.edit(schema ? withFittingVariants(schema, draft) : draft, '');
  state.set({ outcome: null, planned: null, picture: null, job: null, at: 1 });
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

/** Says what is wrong: at its field if there is one. @param {Problem} problem */
function show(problem) {
  state.set({ problem });
  queueMicrotask(() => {
    if (!problem.field) return;
    if (problem.field === 'source.unit') source.focusUnit();
    else form.focus(problem.field);
  });
}

/** @param {string} id @param {Record<string, string>} places */
function complain(id, places) {
  show({ code: '', message: t(id, places) });
}

/** Opens a surface file, a saved job, or both. @param {File[]} files */
async function open(files) {
  const tooBig = files.find((file) => file.size > LARGEST_FILE);
  if (tooBig) {
    complain('error.too_big', { name: tooBig.name, size: size(tooBig.size), limit: size(LARGEST_FILE) });
    return;
  }
  try {
    const jobs = await Promise.all(files.map(readJob));
    const job = jobs.find((spec) => spec !== null) ?? null;
    // Whatever is no job is a surface: the planner says if it is not.
    const surface = files.find((_, i) => jobs[i] === null);
    if (surface) await openSurface(surface, job);
    else if (job) openJob(job, files[jobs.indexOf(job)].name);
  } catch (error) {
    fail(error);
  } finally {
    if (state.get().job?.op === 'inspect') state.set({ job: null });
  }
}

/** The job in a file, completed by the settings in force; `null` if it holds none. @param {File} file @returns {Promise<Spec | null>} */
async function readJob(file) {
  if (!file.name.toLowerCase().endsWith('.json')) return null;
  try {
    const spec = JSON.parse(await file.text());
    const { schema, draft } = state.get();
    const known = typeof spec?.source?.kind === 'string' && spec.version === (schema?.version ?? 1);
    return known && draft ? { ...draft.spec, ...spec } : null;
  } catch {
    return null;
  }
}

/** @param {Spec} spec @param {string} name */
function openJob(spec, name) {
  const { draft } = state.get();
  if (spec.source.kind !== 'file') load({ spec, source: { id: null, name, bytes: null, info: null } });
  else if (draft?.source.bytes && draft.source.name === spec.source.path)
    load({ spec, source: draft.source });
  else complain('error.job_file', { name: String(spec.source.path) });
}

/** @param {File} file @param {Spec | null} job */
async function openSurface(file, job) {
  const bytes = new Uint8Array(await file.arrayBuffer());
  state.set({ job: { op: 'inspect', phase: '', fraction: 0 }, problem: null });
  planner.cancel();
  const info = await planner.call('inspect', [file.name, bytes]);
  const { draft } = state.get();
  if (!draft) return;
  if (info.faces.length === 0) {
    complain('error.no_face', { name: file.name });
    return;
  }
  const fresh = { kind: 'file', path: file.name, face: info.faces[0].index, unit: info.unit, side: 'front' };
  /** @type {Source} */
  const opened = { id: null, name: file.name, bytes, info };
  const spec = job ?? { ...draft.spec, name: file.name.replace(/\.[^.]*$/, '') };
  const from = job?.source.kind === 'file' ? { ...fresh, ...job.source, path: file.name } : fresh;
  load({ spec: { ...spec, source: from }, source: opened });
}

/** Draws the surface again when what it is made from changed. @param {State} now */
async function refreshPicture({ draft, outcome, planned }) {
  if (!draft) return;
  const isPlanned = outcome !== null && planned !== null && sameSurface(planned, draft);
  const key = { source: draft.spec.source, bytes: draft.source.bytes };
  const isPictured = pictured !== null && pictured.source === key.source && pictured.bytes === key.bytes;
  if (isPlanned || isPictured) return;
  pictured = key;
  try {
    const picture = await planner.call('preview', [withUnit(draft.spec), key.bytes]);
    if (pictured !== key) return;
    // The path of another surface, or of its other side, has no place on this one.
    state.set({ picture, outcome: null, planned: null });
  } catch (error) {
    if (error instanceof Cancelled) pictured = null;
    else fail(error);
  }
}

/**
 * Draws the other faces of a file, one after another, whenever the planner has nothing else to do.
 *
 * @param {State} now
 */
async function refreshFaces({ draft, job, faces, picture }) {
  const info = draft?.source.info;
  const bytes = draft?.source.bytes;
  const wanted = info && bytes && info.faces.length <= MOST_FACES && bytes.length <= MOST_FACE_BYTES;
  const key = wanted && info.faces.length > 1 ? `${draft.spec.source.unit} ${draft.spec.source.side}` : '';
  if (drawn.bytes !== bytes || drawn.key !== key) {
    drawn = { bytes, key, failed: new Set(), busy: false };
    if (faces.size > 0) state.set({ faces: new Map() });
    return;
  }
  if (!key || !draft || !info || job || !picture || drawn.busy) return;
  const next = info.faces.find(({ index }) => !faces.has(index) && !drawn.failed.has(index));
  if (!next) return;
  const mine = drawn;
  mine.busy = true;
  try {
    const made = await planner.call('preview', [
      write(withUnit(draft.spec), 'source.face', next.index),
      bytes,
    ]);
    if (drawn === mine) state.set({ faces: new Map([...state.get().faces, [next.index, made]]) });
  } catch (error) {
    if (!(error instanceof Cancelled)) mine.failed.add(next.index);
  } finally {
    mine.busy = false;
    if (drawn === mine) render(state.get());
  }
}

/** @param {Draft} a @param {Draft} b */
function sameSurface(a, b) {
  return a.spec.source === b.spec.source && a.source.bytes === b.source.bytes;
}

/** Until the unit is known the surface is drawn as if it were in millimetres. @param {Spec} spec */
function withUnit(spec) {
  return spec.source.kind === 'file' && !spec.source.unit ? write(spec, 'source.unit', 'mm') : spec;
}

async function plan() {
  const { draft, schema } = state.get();
  if (!draft || !schema) return;
  const problem = firstProblem(schema, draft);
  if (problem) {
    show({ ...problem, message: problem.code === 'unit' ? t('fault.unit') : '' });
    return;
  }
  planner.cancel();
  // A new surface is seen before its path is there.
  refreshPicture(state.get());
  const job = { op: 'plan', phase: '', fraction: 0 };
  state.set({ job, problem: null });
  let current = job;
  try {
    const outcome = await planner.call('plan', [draft.spec, draft.source.bytes], (phase, fraction) => {
      if (state.get().job !== current) return;
      current = { op: 'plan', phase, fraction };
      state.set({ job: current });
    });
    pictured = null;
    state.set({ outcome, planned: draft, picture: outcome.picture, at: 1 });
  } catch (error) {
    fail(error);
  } finally {
    // A newer plan may be under way already.
    if (state.get().job === current) state.set({ job: null });
  }
}

/** Dropping anywhere opens; leaving a child of the page is not leaving the page. */
function acceptDrops() {
  let depth = 0;
  const carriesFiles = (/** @type {DragEvent} */ event) =>
    event.dataTransfer?.types.includes('Files') ?? false;
  const count = (/** @type {number} */ next) => {
    depth = Math.max(next, 0);
    if (state.get().dragging !== depth > 0) state.set({ dragging: depth > 0 });
  };
  addEventListener('dragenter', (event) => carriesFiles(event) && count(depth + 1));
  addEventListener('dragleave', (event) => carriesFiles(event) && count(depth - 1));
  addEventListener('dragover', (event) => event.preventDefault());
  addEventListener('drop', (event) => {
    event.preventDefault();
    count(0);
    const files = [...(event.dataTransfer?.files ?? [])];
    if (files.length > 0) open(files);
  });
}

function acceptKeys() {
  addEventListener('keydown', (event) => {
    if (!(event.ctrlKey || event.metaKey) || event.altKey) return;
    const key = event.key.toLowerCase();
    const act =
      key === 'enter'
        ? plan
        : key === 'z' && !event.shiftKey
          ? state.undo
          : key === 'y' || key === 'z'
            ? state.redo
            : null;
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
  acceptDrops();
  acceptKeys();
  // The picture's code is the largest part of the page: the planner is at work while it loads.
  const drawing = import('./view/canvas3d.js')
    .then(({ createCanvas3d }) => {
      canvas = createCanvas3d(place('canvas'), { onFace: (index) => editSource('face', index) });
      canvas.update(state.get());
    })
    .catch(() => place('canvas').append(h('p', { class: 'help' }, t('canvas.none'))));
  try {
    const { schema, gallery } = await planner.call('start', []);
    state.set({ schema, gallery });
    if (gallery.length > 0) await pick(gallery[0].id);
  } catch (error) {
    fail(error);
  }
  await drawing;
  document.documentElement.dataset.ready = '';
}

start();
