/**
 * What stands at the top right: undo, sharing, opening, language.
 *
 * @import { State } from './types.js'
 */

import { count } from '../format.js';
import { MOST } from '../share/link.js';
import { toClipboard } from '../view/clipboard.js';
import { attribute, h, icon, say } from '../view/dom.js';
import { languageButton } from '../view/language.js';
import { linked } from './link.js';
import { t } from './text.js';

/**
 * @param {HTMLElement} root
 * @param {{ onUndo: () => void, onRedo: () => void, onFiles: (files: File[]) => void }} callbacks
 */
export function createHead(root, { onUndo, onRedo, onFiles }) {
  /** @param {'undo' | 'redo' | 'open'} name @param {() => void} onclick */
  const quiet = (name, onclick) => {
    const title = t(`action.${name}`);
    return h(
      'button',
      { type: 'button', class: 'quiet', name, title, 'aria-label': title, onclick },
      icon(name),
    );
  };
  const picker = h('input', { type: 'file', class: 'hidden', name: 'file', tabindex: -1, multiple: true });
  attribute(picker, 'aria-label', t('action.open'));
  picker.addEventListener('change', () => {
    onFiles([...(picker.files ?? [])]);
    // The same file again is a change too.
    picker.value = '';
  });
  const [undo, redo] = [quiet('undo', onUndo), quiet('redo', onRedo)];
  const link = h('textarea', { readonly: true, rows: 4, name: 'link', 'aria-label': t('share.link') });
  const about = h('p', { 'aria-live': 'polite' });
  const copy = h('button', { type: 'button', class: 'primary', name: 'copy' }, t('share.copy'));
  copy.addEventListener('click', () =>
    toClipboard(link, copy, { copy: t('share.copy'), copied: t('share.copied') }),
  );
  const close = h(
    'button',
    { type: 'button', class: 'quiet', 'aria-label': t('action.close'), onclick: () => dialog.close() },
    icon('close'),
  );
  const dialog = h(
    'dialog',
    { class: 'sheet share', 'aria-labelledby': 'share-title' },
    h('div', { class: 'head' }, h('h2', { id: 'share-title' }, t('share.title')), close),
    about,
    h('div', { class: 'parts' }, link, copy),
  );
  const share = h('button', { type: 'button', name: 'share' }, icon('share'), h('span', {}, t('share.open')));
  attribute(share, 'aria-label', t('share.open'));
  root.append(
    picker,
    undo,
    redo,
    quiet('open', () => picker.click()),
    share,
    languageButton(),
    dialog,
  );
  /** @type {any} */
  let draft = null;

  share.addEventListener('click', async () => {
    if (!draft) return;
    const fragment = await linked(draft);
    const isTooLong = fragment.length > MOST;
    const places = { letters: count(fragment.length), most: count(MOST) };
    say(about, t(isTooLong ? 'share.too_long' : 'share.about', places));
    link.value = isTooLong ? '' : `${location.origin}${location.pathname}${fragment}`;
    link.hidden = copy.hidden = isTooLong;
    dialog.showModal();
    if (!isTooLong) link.select();
  });

  return {
    pickFile: () => picker.click(),

    /** @param {State} state */
    update(state) {
      draft = state.draft;
      undo.disabled = !state.canUndo;
      redo.disabled = !state.canRedo;
      share.disabled = !draft;
    },
  };
}
