/** @import { State } from './types.js' */
import { createHistory } from '../history.js';
import { recall } from './lathe.js';

/** @returns {State} */
function empty() {
  return {
    schema: null,
    draft: null,
    canUndo: false,
    canRedo: false,
    outcome: null,
    planned: null,
    motion: null,
    radius: 0,
    axis: 'z',
    job: null,
    problem: null,
    view: 'map',
    path: true,
    range: 'own',
    compared: [],
    dragging: false,
    lathe: recall(),
  };
}

/** The turning page's one state. @param {(state: State) => void} listener */
export const createState = (listener) => createHistory(empty(), listener);
