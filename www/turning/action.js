/**
 * The button that plans, and while it does, how far it is and the button that stops it.
 *
 * @import { State } from './types.js'
 */
import { h, say } from '../view/dom.js';
import { t } from './text.js';

/**
 * @param {HTMLElement} root
 * @param {{ onPlan: () => void, onCancel: () => void }} callbacks
 */
export function createAction(root, { onPlan, onCancel }) {
  const plan = h('button', { type: 'button', class: 'primary', name: 'plan', onclick: onPlan });
  const bar = h('progress', { max: 1, value: 0, 'aria-label': t('progress.title') });
  const cancel = h('button', { type: 'button', name: 'cancel', onclick: onCancel }, t('action.cancel'));
  const busy = h('div', { class: 'busy' }, h('div', { class: 'status' }, bar), cancel);
  const message = h('p', { class: 'message', role: 'alert' });
  root.append(message, busy, plan);

  return {
    /** @param {State} state */
    update({ job, spec, planned, problem }) {
      busy.hidden = job === null;
      plan.hidden = job !== null;
      plan.disabled = spec === null;
      say(plan, t(planned && spec !== planned ? 'action.replan' : 'action.plan'));
      plan.classList.toggle('done', planned !== null && spec === planned);
      bar.value = job?.fraction ?? 0;
      say(message, problem ? problem.message || problem.code : '');
    },
  };
}
