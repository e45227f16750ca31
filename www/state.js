/** @import { State, Draft } from './types.js' */

/** Edits of one field within this time are one step of undo: a number is typed digit by digit. */
const ONE_EDIT_MS = 1200;
const LONGEST_HISTORY = 200;

/** @returns {State} */
function empty() {
  return {
    schema: null,
    gallery: [],
    draft: null,
    canUndo: false,
    canRedo: false,
    picture: null,
    faces: new Map(),
    outline: null,
    outcome: null,
    planned: null,
    job: null,
    problem: null,
    chart: { isOpen: false, radius: 50, stepovers: null, hasFailed: false },
    layers: {
      passes: true,
      links: true,
      rapids: true,
      tint: 'excess',
      zones: true,
      side: false,
      cutter: true,
    },
    at: 1,
    dragging: false,
    picking: null,
    runs: [],
    comparison: null,
    unfit: [],
    removal: null,
    removing: null,
    picked: null,
    range: null,
    isFlat: false,
    domain: null,
    recent: [],
  };
}

/**
 * The page's one state. Listeners run once after a burst of changes, before the next frame is drawn.
 *
 * @param {(state: State) => void} listener
 */
export function createState(listener) {
  let state = empty();
  /** @type {Draft[]} */
  let past = [];
  /** @type {Draft[]} */
  let future = [];
  let lastEdit = { what: '', time: 0 };
  let scheduled = false;

  /** @param {Partial<State>} change */
  function set(change) {
    state = { ...state, ...change };
    if (scheduled) return;
    scheduled = true;
    queueMicrotask(() => {
      scheduled = false;
      listener(state);
    });
  }

  /** @param {Draft | null} draft */
  function show(draft) {
    set({ draft, canUndo: past.length > 0, canRedo: future.length > 0, problem: null });
  }

  return {
    get: () => state,
    set,

    /**
     * Replaces the draft and keeps the one before for undo.
     *
     * @param {Draft} draft
     * @param {string} what The same text for edits that belong to one step; '' for a step of its own.
     */
    edit(draft, what) {
      const now = performance.now();
      const sameStep = what !== '' && what === lastEdit.what && now - lastEdit.time < ONE_EDIT_MS;
      if (state.draft && !sameStep) past = [...past.slice(1 - LONGEST_HISTORY), state.draft];
      lastEdit = { what, time: now };
      future = [];
      show(draft);
    },

    undo() {
      const draft = past.pop();
      if (!draft || !state.draft) return;
      future.push(state.draft);
      lastEdit.what = '';
      show(draft);
    },

    redo() {
      const draft = future.pop();
      if (!draft || !state.draft) return;
      past.push(state.draft);
      lastEdit.what = '';
      show(draft);
    },
  };
}
