/**
 * What is cut: an example or a file, and which side of it.
 *
 * @import { State } from '../types.js'
 */
import { bytes as size } from '../format.js';
import { prettify, t } from '../text/index.js';
import { attribute, h, icon, say } from './dom.js';
import { createFileCard } from './file-card.js';
import { glyph } from './glyphs.js';

/** What the file picker offers; the planner decides by content. */
const ENDINGS = '.igs,.iges,.stl,.obj,.csv,.txt,.xyz,.cpt,.cptw,.json';
/**
 * @param {HTMLElement} root
 * @param {{ onPick: (id: string) => void, onFiles: (files: File[]) => void, onSide: () => void,
 *   onRecent: (name: string) => void, onForget: (name: string) => void, limit: number } & import('./file-card.js').FileCallbacks} callbacks
 */
export function createSource(root, { onPick, onFiles, onSide, onRecent, onForget, limit, ...onFile }) {
  const picker = h('input', {
    type: 'file',
    id: 'file',
    class: 'hidden',
    multiple: true,
    accept: ENDINGS,
    tabindex: -1,
    'aria-label': t('action.open'),
    onchange: () => {
      onFiles([...(picker.files ?? [])]);
      picker.value = '';
    },
  });
  const open = h(
    'button',
    { type: 'button', class: 'open', name: 'open', onclick: () => picker.click() },
    icon('open'),
    t('action.open'),
  );
  const gallery = h('div', { class: 'gallery', role: 'group', 'aria-label': t('surface.gallery') });
  const file = h('div', { class: 'file' });
  const card = createFileCard(file, onFile);
  const side = h('span', { class: 'value' });
  const sideRow = h(
    'div',
    { class: 'field side' },
    h('span', {}, t('surface.side')),
    h(
      'span',
      { class: 'value' },
      side,
      h(
        'button',
        { type: 'button', class: 'small', name: 'flip', title: t('surface.side.hint'), onclick: onSide },
        icon('flip'),
        t('action.flip'),
      ),
    ),
  );
  const hint = h('p', { class: 'help' }, t('surface.hint', { limit: size(limit) }));
  const recent = h('div', { class: 'recent', role: 'group', 'aria-label': t('surface.recent') });
  root.append(gallery, h('div', { class: 'opener' }, open, picker), hint, recent, file, sideRow);

  /** @type {unknown} */
  let shownGallery = null;
  /** @type {unknown} */
  let shownRecent = null;

  /** @param {State} state */
  function showRecent({ recent: files }) {
    if (files === shownRecent) return;
    shownRecent = files;
    recent.hidden = files.length === 0;
    recent.replaceChildren(
      h('h3', {}, t('surface.recent')),
      ...files.map(({ name, size: bytes }) => {
        const forget = h(
          'button',
          { type: 'button', class: 'quiet small', onclick: () => onForget(name) },
          icon('close'),
        );
        attribute(forget, 'aria-label', t('surface.forget', { name }));
        return h(
          'div',
          {},
          h(
            'button',
            { type: 'button', class: 'again', onclick: () => onRecent(name) },
            h('span', {}, name),
            h('small', {}, size(bytes)),
          ),
          forget,
        );
      }),
    );
  }

  /** @param {State} state */
  function showGallery(state) {
    if (shownGallery !== state.gallery) {
      shownGallery = state.gallery;
      gallery.replaceChildren(
        ...state.gallery.map(({ id }) =>
          h(
            'button',
            { type: 'button', 'data-id': id, onclick: () => onPick(id), 'aria-pressed': 'false' },
            glyph(id),
            h('strong', {}, t(`gallery.${id}`, {}, prettify(id))),
            h('span', {}, t(`gallery.${id}.about`, {}, '')),
          ),
        ),
      );
    }
    for (const button of gallery.children) {
      const pressed = button instanceof HTMLElement && button.dataset.id === state.draft?.source.id;
      attribute(button, 'aria-pressed', String(pressed));
    }
  }

  return {
    /** @param {State} state */
    update(state) {
      showGallery(state);
      showRecent(state);
      card.update(state);
      sideRow.hidden = !state.draft;
      if (!state.draft) return;
      say(side, t(`surface.side.${state.draft.spec.source.side ?? 'front'}`));
    },

    pickFile: () => picker.click(),

    /** Puts the cursor on the question for the unit. */
    focusUnit() {
      const first = root.querySelector('input[name="source.unit"]');
      if (!(first instanceof HTMLElement)) return false;
      first.focus();
      first.closest('fieldset')?.scrollIntoView({ block: 'center' });
      return true;
    },
  };
}
