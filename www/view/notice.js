/**
 * What went wrong, where it cannot be said at a field.
 *
 * @import { State } from '../types.js'
 */
import { t } from '../text/index.js';
import { h, icon, say } from './dom.js';

/**
 * @param {HTMLElement} root
 * @param {{ onClose: () => void }} callbacks
 */
export function createNotice(root, { onClose }) {
  const text = h('p', {});
  const title = h('strong', {});
  const close = h('button', {
    type: 'button',
    class: 'quiet',
    'aria-label': t('action.close'),
    onclick: onClose,
  });
  close.append(icon('close'));
  const box = h('div', { class: 'notice', role: 'alert' }, h('div', {}, title, text), close);
  root.append(box);

  return {
    /** @param {State} state */
    update({ problem }) {
      const message = problem
        ? t(`error.${problem.code}`, { message: problem.message }, problem.message)
        : '';
      box.hidden = message === '';
      say(title, t(problem?.code === 'unit' ? 'error.title.unit' : 'error.title'));
      say(text, message);
    },
  };
}
