/**
 * What is worth knowing of a program; each note leads to its place on the path.
 *
 * @import { State, Note } from './types.js'
 */
import { percent, plain } from '../format.js';
import { h } from '../view/dom.js';
import { t } from './text.js';

/**
 * @param {HTMLElement} root
 * @param {{ onMove: (move: number) => void }} callbacks
 */
export function createNotes(root, { onMove }) {
  /** @type {unknown} */
  let shown;

  return {
    /** @param {State} state */
    update({ work }) {
      root.hidden = !work;
      if (!work || work === shown) return;
      shown = work;
      const { notes } = work.report;
      const list = notes.map((note) =>
        h(
          'li',
          {},
          h(
            'button',
            {
              type: 'button',
              class: 'note',
              'data-matter': note.matter,
              title: t('place'),
              onclick: () => onMove(note.first),
            },
            h('span', {}, words(note)),
            h('small', {}, t(note.first === note.last ? 'note.move' : 'note.moves', note)),
          ),
        ),
      );
      root.replaceChildren(
        h('h3', {}, t('notes.title')),
        list.length > 0 ? h('ul', {}, ...list) : h('p', { class: 'help' }, t('notes.none')),
      );
    },
  };
}

/** @param {Note} note */
function words(note) {
  const number = (/** @type {number | undefined} */ x, digits = 2) => plain(Number((x ?? 0).toFixed(digits)));
  const degrees = (/** @type {number | undefined} */ x, digits = 2) => `${number(x, digits)}°`;
  return t(
    `note.${note.matter}`,
    {
      axis: note.axis ?? '',
      share: percent(note.share ?? 0),
      degrees: degrees(note.degrees, 0),
      left: note.unit === '°' ? degrees(note.left, 3) : `${number(note.left, 3)} mm`,
      lead: degrees(note.lead),
      needed: degrees(note.needed),
    },
    note.text,
  );
}
