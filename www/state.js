/** @import { State } from './types.js' */
import { createHistory } from './history.js';

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
export const createState = (listener) => createHistory(empty(), listener);
