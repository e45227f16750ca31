/**
 * What is chosen is kept in the browser: machine, settings, and a machine's own file.
 *
 * @import { Machine, State } from './types.js'
 *
 * @typedef {{ chosen?: string, options?: any, own?: Machine }} Kept
 */
const KEY = 'machine';
/** The id of a machine from a file of its own. */
export const OWN = 'own';

/** What was chosen when the page was last used. */
export function recall() {
  try {
    const found = JSON.parse(localStorage.getItem(KEY) ?? '{}');
    if (typeof found === 'object' && found !== null) return /** @type {Kept} */ (found);
  } catch {
    // What cannot be read is as if it were not there.
  }
  return /** @type {Kept} */ ({});
}

/** @param {State} state */
export function remember({ chosen, options, machines }) {
  const own = machines.find(({ id }) => id === OWN);
  try {
    localStorage.setItem(KEY, JSON.stringify({ chosen, options, own }));
  } catch {
    // Where nothing may be stored it is chosen anew.
  }
}
