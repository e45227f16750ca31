/**
 * The button that plans, and while it does, how far it is and the button that stops it.
 *
 * @import { State } from '../types.js'
 */
import { t } from '../text/index.js';
import { h, say } from './dom.js';

/**
 * @param {HTMLElement} root
 * @param {{ onPlan: () => void, onCancel: () => void }} callbacks
 */
export function createAction(root, { onPlan, onCancel }) {
  const plan = h(
    'button',
    { type: 'button', class: 'primary', name: 'plan', onclick: onPlan },
    t('action.plan'),
  );
  const bar = h('progress', { max: 1, value: 0, 'aria-label': t('progress.title') });
  const phase = h('span', { class: 'phase' });
  const share = h('span', { class: 'share' });
  const cancel = h('button', { type: 'button', name: 'cancel', onclick: onCancel }, t('action.cancel'));
  const busy = h(
    'div',
    { class: 'busy' },
    h('div', { class: 'status' }, h('div', { class: 'words' }, phase, share), bar),
    cancel,
  );
  root.append(busy, plan);

  return {
    /** @param {State} state */
    update({ job, draft, planned, outcome }) {
      const planning = job?.op === 'plan';
      const hadFocus = document.activeElement;
      busy.hidden = !planning;
      // Whoever changes a setting meanwhile need not wait for what is out of date.
      plan.hidden = planning && job.draft === draft;
      plan.disabled = !draft;
      say(plan, t((outcome || planning) && draft !== planned ? 'action.replan' : 'action.plan'));
      plan.classList.toggle('done', outcome !== null && draft === planned);
      // Between jobs too: the next one must not begin where the last one ended.
      bar.value = planning ? job.fraction : 0;
      if (planning) {
        say(phase, job.phase ? t(`phase.${job.phase}`, {}, job.phase) : t('progress.start'));
        say(share, `${Math.floor(job.fraction * 100)} %`);
      }
      // The keyboard stays where the eye is when one button takes the other's place.
      if (hadFocus === plan && plan.hidden) cancel.focus();
      if (hadFocus === cancel && busy.hidden) plan.focus();
    },
  };
}
