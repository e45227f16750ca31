/**
 * Where machines begin: what they need is loaded when somebody asks for it.
 *
 * @import { State } from '../types.js'
 */
import { t } from '../text/index.js';
import { h } from '../view/dom.js';

/**
 * @param {{ panel: HTMLElement, drawing: HTMLElement }} roots
 * @param {{ onAt: (at: number) => void }} callbacks
 */
export function createMachines({ panel, drawing }, { onAt }) {
  /** @type {ReturnType<typeof import('./machine.js').createMachine> | null} */
  let machine = null;
  /** @type {State | null} */
  let last = null;
  const open = h('button', { type: 'button', name: 'machine', onclick: load }, t('machine.open'));
  const about = h('p', { class: 'help' }, t('machine.about'));
  panel.append(open, about);
  drawing.hidden = true;

  async function load() {
    open.disabled = true;
    try {
      const { createMachine } = await import('./machine.js');
      panel.replaceChildren();
      machine = createMachine({ panel, drawing }, { onAt });
      if (last) machine.update(last);
    } catch {
      open.disabled = false;
      about.textContent = t('machine.failed');
    }
  }

  return {
    /** @param {State} state */
    update(state) {
      last = state;
      machine?.update(state);
    },
  };
}
