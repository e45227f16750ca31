/** The sheet of keyboard shortcuts, which `?` opens. */
import { t } from '../text/index.js';
import { h, icon } from './dom.js';

/** Keys, and the id of what they do. @type {[string, string][]} */
const KEYS = [
  ['Ctrl Enter', 'action.plan'],
  ['Ctrl Z', 'action.undo'],
  ['Ctrl Shift Z', 'action.redo'],
  ['Ctrl S', 'keys.save'],
  ['Ctrl O', 'action.open'],
  ['Space', 'keys.play'],
  [', .', 'keys.step'],
  ['← → ↑ ↓', 'keys.turn'],
  ['+ −', 'keys.zoom'],
  ['1 2 3 4 0', 'keys.views'],
  ['O', 'keys.parallel'],
  ['U', 'keys.flat'],
  ['?', 'keys.title'],
];

/** @param {HTMLElement} root */
export function createKeys(root) {
  const rows = KEYS.map(([keys, id]) =>
    h('div', {}, h('dt', {}, ...keys.split(' ').map((key) => h('kbd', {}, key))), h('dd', {}, t(id))),
  );
  const dialog = h(
    'dialog',
    { class: 'sheet keys', 'aria-labelledby': 'keys-title' },
    h(
      'div',
      { class: 'head' },
      h('h2', { id: 'keys-title' }, t('keys.title')),
      h(
        'button',
        { type: 'button', class: 'quiet', 'aria-label': t('action.close'), onclick: () => dialog.close() },
        icon('close'),
      ),
    ),
    h('dl', {}, ...rows),
  );
  root.append(dialog);
  return { show: () => !dialog.open && dialog.showModal() };
}
