/**
 * Wires the turning page: settings, plan, proof, picture, plots and the paper's comparisons.
 *
 * @import { State } from './types.js'
 * @import { Group } from '../types.js'
 */
import { Cancelled, createPlanner, PlannerError } from '../protocol.js';
import { withVariant, write } from '../spec.js';
import { h } from '../view/dom.js';
import moduleAddress from '../wasm/turning_bg.wasm?url';
import { createAction } from './action.js';
import { createCompare, variants } from './compare.js';
import { createFigures } from './figures.js';
import { createForm } from './form.js';
import { createPicture } from './picture.js';
import { createPlots } from './plots.js';
import { createSaving } from './saving.js';
import { t } from './text.js';

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

const planner = createPlanner(
  compile,
  () => new Worker(new URL('./worker.js', import.meta.url), { type: 'module', name: 'turning' }),
);

/** @type {State} */
let state = {
  schema: null,
  spec: null,
  outcome: null,
  planned: null,
  motion: null,
  radius: 0,
  job: null,
  problem: null,
  view: 'map',
  path: true,
  range: 'own',
  compared: [],
};

for (const element of document.querySelectorAll('[data-text]')) {
  element.textContent = t(element.getAttribute('data-text') ?? '');
}
place('modes').append(
  h('a', { href: './index.html' }, t('mode.milling')),
  h('a', { href: './turning.html', 'aria-current': 'page' }, t('mode.turning')),
);

const views = [
  createForm(place('settings'), {
    onEdit: (path, value) => edit(write(state.spec, path, value)),
    onVariant: (/** @type {Group} */ group, kind) => edit(withVariant(state.spec, group, kind)),
  }),
  createAction(place('action'), { onPlan: plan, onCancel: () => planner.cancel() }),
  createCompare(place('compare'), { onChoose: choose, onRun: compare }),
  createPicture(place('picture'), { onShow: (shown) => set(shown) }),
  createPlots(place('plots'), { onRadius: (radius) => turn(radius) }),
  createFigures(place('results')),
  createSaving(place('save')),
];

/** @param {Partial<State>} change */
function set(change) {
  state = { ...state, ...change };
  for (const view of views) view.update(state);
}

/** @param {any} spec */
function edit(spec) {
  set({ spec, problem: null });
}

/** @param {string} guide @param {string} points */
function choose(guide, points) {
  if (!state.schema) return;
  edit(variants(state.schema, state.spec, guide, points));
  plan();
}

/** @param {string} op @param {any[]} args */
function ask(op, args) {
  return planner.call(op, args, (_, fraction) => set({ job: { op, fraction } }));
}

/** Runs `work`, and shows what goes wrong where it belongs. @param {() => Promise<void>} work */
async function guarded(work) {
  try {
    await work();
  } catch (error) {
    if (error instanceof PlannerError) {
      set({ problem: { code: error.code, message: error.message, field: error.field } });
    } else if (!(error instanceof Cancelled)) throw error;
  }
  set({ job: null });
}

function plan() {
  planner.cancel();
  return guarded(async () => {
    const spec = state.spec;
    set({ job: { op: 'plan', fraction: 0 }, problem: null });
    const outcome = await ask('plan', [spec]);
    const radius = outcome.report.outermost_mm;
    set({ outcome, planned: spec, radius, motion: await planner.call('motion', [radius]) });
    set({ job: { op: 'prove', fraction: 0 } });
    const { report, residues, file } = await ask('prove', []);
    set({ outcome: { ...outcome, report, residues, files: { ...outcome.files, report: file } } });
  });
}

/** @param {number} radius */
async function turn(radius) {
  set({ radius });
  try {
    const motion = await planner.call('motion', [radius]);
    if (state.radius === radius && motion.length > 0) set({ motion });
  } catch (error) {
    if (!(error instanceof Cancelled)) throw error;
  }
}

function compare() {
  return guarded(async () => {
    const { schema, spec } = state;
    if (!schema) return;
    set({ compared: [], problem: null });
    for (const guide of ['spiral', 'circles']) {
      for (const points of ['angle', 'arc']) {
        const report = await ask('compare', [variants(schema, spec, guide, points)]);
        set({ compared: [...state.compared, { guide, points, report }] });
      }
    }
  });
}

guarded(async () => {
  const { schema, spec } = await planner.call('start', []);
  set({ schema, spec });
  await plan();
}).finally(() => {
  document.documentElement.dataset.ready = '';
});
