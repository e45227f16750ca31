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
  const phase = h('span', { class: 'phase' });
  const share = h('span', { class: 'share' });
  const cancel = h('button', { type: 'button', name: 'cancel', onclick: onCancel }, t('action.cancel'));
  const words = h('div', { class: 'words' }, phase, share);
  const busy = h('div', { class: 'busy' }, h('div', { class: 'status' }, words, bar), cancel);
  const message = h('p', { class: 'message', role: 'alert' });
  root.append(message, busy, plan);

  return {
    /** @param {State} state */
    update({ job, draft, planned, problem }) {
      const hadFocus = document.activeElement;
      busy.hidden = job === null;
      plan.hidden = job !== null;
      plan.disabled = draft === null;
      say(plan, t(planned && draft !== planned ? 'action.replan' : 'action.plan'));
      plan.classList.toggle('done', planned !== null && draft === planned);
      bar.value = job?.fraction ?? 0;
      say(phase, job ? t(`phase.${job.phase}`, {}, t(`phase.${job.op}`)) : '');
      say(share, job ? `${Math.floor(job.fraction * 100)} %` : '');
      // What is wrong with a field is said at the field.
      say(message, problem?.message ?? '');
      // The keyboard stays where the eye is when one button takes the other's place.
      if (hadFocus === plan && plan.hidden) cancel.focus();
      if (hadFocus === cancel && busy.hidden) plan.focus();
    },
  };
}
