/**
 * What the planner is asked for: the path and its proof when somebody wants them, and pictures whenever what they show
 * has changed.
 *
 * @import { State, Draft, Spec, Problem, Outcome } from './types.js'
 */
import { Cancelled } from './protocol.js';
import { chosen, firstProblem, write } from './spec.js';

/** Of larger files only the chosen face is drawn: each face is read from the file anew. */
const MOST_FACES = 40;
const MOST_FACE_BYTES = 8e6;

/** A path that is there within this time is shown together with its surface: drawing the surface alone would delay it. */
const TOGETHER_MS = 1500;

/** Share of the progress bar that planning has; the rest is the proof's. */
const PLANNING = 0.6;

/** Stands in for the shape where only the cutter matters. */
const ANY_SHAPE = { kind: 'plane', size_mm: [1, 1] };

/**
 * @typedef {{ source: any, bytes: unknown, done: boolean }} Pictured What the picture in the state was made from.
 * @typedef {{ bytes: unknown, key: string, failed: Set<number>, busy: boolean }} Drawn The same for the faces.
 */

/**
 * @param {ReturnType<import('./protocol.js').createPlanner>} planner
 * @param {ReturnType<import('./state.js').createState>} state
 * @param {{ onProblem: (problem: Problem) => void, onError: (error: unknown) => void,
 *   onProven: (draft: Draft, outcome: Outcome) => void }} callbacks
 */
export function createSession(planner, state, { onProblem, onError, onProven }) {
  /** What plans the strategies that the first module only names. @type {ReturnType<import('./protocol.js').createPlanner> | null} */
  let second = null;
  /** @type {Pictured} */
  let pictured = { source: null, bytes: null, done: false };
  /** @type {Drawn} */
  let drawn = { bytes: undefined, key: '', failed: new Set(), busy: false };
  /** @type {any} */
  let outlined = null;
  /** What the curves of the chart were asked for with. */
  let charted = { cutter: /** @type {any} */ (null), tolerance: /** @type {any} */ (null), radius: 0 };
  /** A picture that waits for its path, and the timer that ends the waiting. */
  let waiting = { picture: /** @type {any} */ (null), timer: 0 };

  /** Draws the surface again when what it is made from changed. @param {State} now */
  async function refreshPicture({ draft }) {
    // Of a file that did not travel there is nothing to draw but the preview.
    if (!draft || (draft.spec.source.kind === 'file' && !draft.source.bytes)) return;
    const key = { source: draft.spec.source, bytes: draft.source.bytes, done: false };
    if (pictured.source === key.source && pictured.bytes === key.bytes) return;
    pictured = key;
    try {
      const picture = await planner.call('preview', [shapeOf(draft.spec), key.bytes]);
      if (pictured !== key) return;
      key.done = true;
      waiting.picture = picture;
      if (!waiting.timer) showWaiting();
    } catch (error) {
      if (!(error instanceof Cancelled)) onError(error);
      else if (pictured === key) pictured = { source: null, bytes: null, done: false };
    }
  }

  function showWaiting() {
    const { picture, timer } = waiting;
    clearTimeout(timer);
    waiting = { picture: null, timer: 0 };
    // The path of another surface, or of its other side, has no place on this one.
    // What came by link stays on show until its path is there.
    if (picture && state.get().outcome?.isPreview) state.set({ picture });
    else if (picture) state.set({ picture, outcome: null, planned: null });
  }

  /** Draws the cutter of the form. @param {State} now */
  async function refreshOutline({ draft }) {
    const cutter = draft?.spec.cutter;
    if (!draft || outlined === cutter) return;
    outlined = cutter;
    try {
      // With the cutter alone: what is wrong elsewhere does not concern its drawing.
      const spec = { version: draft.spec.version, source: ANY_SHAPE, cutter };
      const outline = await planner.call('outline', [spec]);
      if (outlined === cutter) state.set({ outline });
    } catch (error) {
      if (error instanceof Cancelled) outlined = null;
      else if (outlined === cutter) state.set({ outline: null });
    }
  }

  /** Computes stepover against tilt while somebody looks at it. @param {State} now */
  async function refreshChart({ draft, chart }) {
    if (!draft || !chart.isOpen) return;
    const { version, cutter, tolerance } = draft.spec;
    const { radius } = chart;
    if (charted.cutter === cutter && charted.tolerance === tolerance && charted.radius === radius) return;
    const mine = { cutter, tolerance, radius };
    charted = mine;
    try {
      const spec = { version, source: ANY_SHAPE, cutter, tolerance };
      const stepovers = await planner.call('stepover', [spec, [radius, 0]]);
      if (charted === mine) state.set({ chart: { ...state.get().chart, stepovers, hasFailed: false } });
    } catch (error) {
      if (charted !== mine) return;
      if (error instanceof Cancelled) charted = { cutter: null, tolerance: null, radius: 0 };
      else state.set({ chart: { ...state.get().chart, stepovers: null, hasFailed: true } });
    }
  }

  /** Draws the other faces of a file, one after another. @param {State} now */
  async function refreshFaces({ draft, faces }) {
    const info = draft?.source.info;
    const bytes = draft?.source.bytes;
    const wanted = info && bytes && info.faces.length <= MOST_FACES && bytes.length <= MOST_FACE_BYTES;
    const key = wanted && info.faces.length > 1 ? `${draft.spec.source.unit} ${draft.spec.source.side}` : '';
    if (drawn.bytes !== bytes || drawn.key !== key) {
      drawn = { bytes, key, failed: new Set(), busy: false };
      if (faces.size > 0) state.set({ faces: new Map() });
      return;
    }
    if (!key || !draft || !info || !pictured.done || drawn.busy) return;
    const next = info.faces.find(({ index }) => !faces.has(index) && !drawn.failed.has(index));
    if (!next) return;
    const mine = drawn;
    mine.busy = true;
    try {
      const spec = write(shapeOf(draft.spec), 'source.face', next.index);
      const made = await planner.call('preview', [spec, bytes]);
      if (drawn === mine) state.set({ faces: new Map([...state.get().faces, [next.index, made]]) });
    } catch (error) {
      // A face that cannot be drawn says so when it is chosen.
      if (!(error instanceof Cancelled)) mine.failed.add(next.index);
    } finally {
      mine.busy = false;
      if (drawn === mine) state.set({});
    }
  }

  /** @param {Draft} draft */
  async function plannerOf({ spec }) {
    const needs = state.get().schema?.groups.some((group) => chosen(group, spec)?.second);
    if (!needs) return planner;
    const asked = state.get().job;
    if (!second) {
      const { createStudyPlanner } = await import('./study/planner.js');
      // Two may have waited for it.
      second ??= createStudyPlanner('strategies');
    }
    // Somebody may have given up meanwhile.
    if (state.get().job !== asked) throw new Cancelled();
    return second;
  }

  function cancel() {
    planner.cancel();
    second?.cancel();
  }

  /** @param {Draft} draft @param {(from: number, to: number) => (phase: string, fraction: number) => void} stage */
  async function planAndProve(draft, stage) {
    const planner = await plannerOf(draft);
    /** @type {Outcome} */
    const planned = await planner.call('plan', [draft.spec, draft.source.bytes], stage(0, PLANNING));
    showWaiting();
    state.set({ outcome: planned, planned: draft, at: 1 });
    const proved = await planner.call('prove', [], stage(PLANNING, 1));
    if (state.get().outcome !== planned) return;
    const outcome = { ...planned, ...proved, files: planned.files && { ...planned.files, ...proved.files } };
    state.set({ outcome, picture: outcome.picture ?? state.get().picture });
    onProven(draft, outcome);
  }

  return {
    /** Gives up what is being planned. */
    cancel() {
      cancel();
      // What has no request under way yet would go on.
      state.set({ job: null });
    },

    /** Keeps the pictures up with the state. @param {State} now */
    refresh(now) {
      // While it plans, the planner has no time for pictures.
      if (now.job?.op === 'plan') return;
      refreshPicture(now);
      refreshOutline(now);
      refreshChart(now);
      refreshFaces(now);
    },

    async plan() {
      const { draft, schema } = state.get();
      if (!draft || !schema) return;
      const problem = firstProblem(schema, draft);
      if (draft.spec.source.kind === 'file' && !draft.source.bytes) {
        onProblem({ code: 'job_file', message: draft.source.name });
        return;
      }
      if (problem) {
        onProblem(problem);
        return;
      }
      cancel();
      if (!pictured.done) pictured = { source: null, bytes: null, done: false };
      let job = { op: 'plan', phase: '', fraction: 0, draft };
      state.set({ job, problem: null });
      // A new surface is seen before its path is there, if that takes its time.
      clearTimeout(waiting.timer);
      waiting.timer = setTimeout(showWaiting, TOGETHER_MS);
      refreshPicture(state.get());
      refreshOutline(state.get());
      try {
        await planAndProve(draft, (from, to) => (phase, fraction) => {
          if (state.get().job !== job) return;
          // A step without a name of its own belongs to the one before.
          job = { ...job, phase: phase || job.phase, fraction: from + (to - from) * fraction };
          state.set({ job });
        });
      } catch (error) {
        onError(error);
      } finally {
        // A newer plan may be under way already.
        if (state.get().job === job) {
          showWaiting();
          state.set({ job: null });
        }
      }
    },
  };
}

/**
 * What is needed to draw the surface: the first module need not know how it is cut. Until the unit is known it is drawn as if it were in
 * millimetres.
 *
 * @param {Spec} spec @returns {Spec}
 */
function shapeOf({ version, name, source }) {
  const spec = { version, name, source };
  return source.kind === 'file' && !source.unit ? write(spec, 'source.unit', 'mm') : spec;
}
