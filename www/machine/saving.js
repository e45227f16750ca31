/**
 * Saving: the program, what it reads back as, and its figures.
 *
 * @import { State } from './types.js'
 */
import { bytes } from '../format.js';
import { h, icon } from '../view/dom.js';
import { stem } from '../view/downloads.js';
import { save } from '../view/saving.js';
import { t } from './text.js';

/** @type {Record<string, string>} */
const ENDINGS = {
  linuxcnc: 'ngc',
  grbl: 'nc',
  fanuc: 'nc',
  fanuc_tip: 'nc',
  haas: 'nc',
  siemens: 'mpf',
  siemens_vector: 'mpf',
  heidenhain: 'h',
};

/** @param {HTMLElement} root */
export function createSaving(root) {
  /** @type {unknown} */
  let saved;

  return {
    /** @param {State} state */
    update({ work, planned, dialect }) {
      root.hidden = !work;
      if (!work || !planned || saved === work) return;
      saved = work;
      const name = stem(planned);
      const items = /** @type {const} */ ([
        ['program', ENDINGS[dialect] ?? 'nc'],
        ['back', 'read-back.apt'],
        ['report', 'machine.json'],
      ]);
      root.replaceChildren(
        ...items.map(([id, ending]) =>
          h(
            'button',
            {
              type: 'button',
              'data-machine-save': id,
              onclick: () => save(work.files[id], `${name}.${ending}`),
            },
            icon('save'),
            h('span', {}, t(`save.${id}`)),
            h('small', {}, `.${ending}, ${bytes(work.files[id].size)}`),
          ),
        ),
      );
    },
  };
}
