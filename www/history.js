/** Edits of one field within this time are one step of undo: a number is typed digit by digit. */
const ONE_EDIT_MS = 1200;
const LONGEST_HISTORY = 200;

/**
 * A page's one state, with undo of what a person edits. Listeners run once after a burst of changes, before the next frame is
 * drawn.
 *
 * @template D
 * @template {{ draft: D | null, canUndo: boolean, canRedo: boolean, problem: any }} S
 * @param {S} start
 * @param {(state: S) => void} listener
 */
export function createHistory(start, listener) {
  let state = start;
  /** @type {D[]} */
  let past = [];
  /** @type {D[]} */
  let future = [];
  let lastEdit = { what: '', time: 0 };
  let scheduled = false;

  /** @param {Partial<S>} change */
  function set(change) {
    state = { ...state, ...change };
    if (scheduled) return;
    scheduled = true;
    queueMicrotask(() => {
      scheduled = false;
      listener(state);
    });
  }

  /** @param {D | null} draft */
  function show(draft) {
    const change = { draft, canUndo: past.length > 0, canRedo: future.length > 0, problem: null };
    set(/** @type {Partial<S>} */ (change));
  }

  return {
    get: () => state,
    set,

    /**
     * Replaces the draft and keeps the one before for undo.
     *
     * @param {D} draft
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
