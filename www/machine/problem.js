/**
 * Why there is no program, and the way to the place where it is so.
 *
 * @import { State } from './types.js'
 * @import { Problem } from '../types.js'
 */
import { read } from '../spec.js';
import { h } from '../view/dom.js';
import { t } from './text.js';

/**
 * @param {HTMLElement} root
 * @param {{ onMove: (move: number) => void }} callbacks
 */
export function createProblem(root, { onMove }) {
  /** @type {Problem | null} */
  let told = null;

  return {
    /** @param {State} state */
    update({ problem, options, outcome }) {
      if (told === problem) return;
      told = problem;
      root.replaceChildren();
      if (!problem) return;
      const { field, message } = problem;
      // A setting says by itself what is wrong with it; a machine's file has none here.
      const name = field && read(options, field) === undefined ? `${field}: ` : '';
      root.append(h('p', { class: 'message' }, `${name}${message}`));
      // Motion that cannot be names its move.
      const move = /^move (\d+)/.exec(message);
      if (!move || !outcome) return;
      const show = () => onMove(Number(move[1]));
      root.append(
        h('button', { type: 'button', class: 'small', name: 'machine-place', onclick: show }, t('place')),
      );
    },
  };
}
