/**
 * The lathe that a job is for, from the file that describes it: its limits become those of the job, and the path must stay within
 * its travels.
 *
 * @import { Lathe, State } from './types.js'
 */
import { attribute, h, icon, say } from '../view/dom.js';
import { t } from './text.js';

const KEY = 'lathe';

/** The lathe that was open when the page was last used. @returns {Lathe | null} */
export function recall() {
  try {
    const { name, text } = JSON.parse(localStorage.getItem(KEY) ?? '{}');
    return typeof name === 'string' && typeof text === 'string' ? { name, text } : null;
  } catch {
    return null;
  }
}

/** @param {Lathe | null} lathe */
export function remember(lathe) {
  try {
    if (lathe) localStorage.setItem(KEY, JSON.stringify(lathe));
    else localStorage.removeItem(KEY);
  } catch {
    // Where nothing may be stored it is opened anew.
  }
}

/** The name of the machine that a JSON text describes; `null` if it describes none. @param {string} text @returns {string | null} */
export function nameOf(text) {
  try {
    const { axes, name } = JSON.parse(text);
    return Array.isArray(axes) ? String(name) : null;
  } catch {
    return null;
  }
}

/** What is wrong with a lathe's file, with the name that the file itself has for the place. @param {string} field @param {string} message */
export const inFile = (field, message) => `${field}: ${message.replace(`${field}: `, '')}`;

/** @param {{ onPick: () => void, onForget: () => void }} callbacks */
export function createLathe({ onPick, onForget }) {
  const name = h('strong', {});
  const forget = h(
    'button',
    { type: 'button', class: 'quiet', name: 'lathe-forget', title: t('lathe.forget'), onclick: onForget },
    icon('close'),
  );
  attribute(forget, 'aria-label', t('lathe.forget'));
  const shown = h('p', { class: 'lathe-name' }, name, forget);
  const open = h(
    'button',
    { type: 'button', class: 'small', name: 'lathe', onclick: onPick },
    t('lathe.open'),
  );
  const element = h('div', { class: 'lathe' }, shown, open, h('p', { class: 'help' }, t('lathe.about')));

  return {
    element,

    /** @param {State} state */
    update({ lathe }) {
      shown.hidden = lathe === null;
      say(name, lathe?.name ?? '');
    },
  };
}
