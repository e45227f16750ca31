/**
 * Saving: the program, the motion in other forms, the report, and the job itself.
 *
 * @import { State } from './types.js'
 */
import { bytes } from '../format.js';
import { h, icon } from '../view/dom.js';
import { save } from '../view/saving.js';
import { t } from './text.js';

/** @param {HTMLElement} root */
export function createSaving(root) {
  const list = h('div', { class: 'downloads' });
  root.append(list);
  /** @type {unknown[]} */
  let shown = [];

  let saveJob = () => {};

  return {
    /** Saves the job that is edited. */
    saveJob: () => saveJob(),

    /** @param {State} state */
    update({ outcome, draft: spec }) {
      if (shown[0] === outcome && shown[1] === spec) return;
      shown = [outcome, spec];
      if (!spec) return;
      const job = new Blob([`${JSON.stringify({ job: 'turning', ...spec }, null, 2)}\n`], {
        type: 'application/json',
      });
      /** @type {[string, string, Blob][]} */
      const items = outcome
        ? [
            ['program', outcome.extension, outcome.files.program],
            ['csv', 'csv', outcome.files.csv],
            ['turns', 'turns.csv', outcome.files.turns],
            ['apt', 'apt', outcome.files.apt],
            ['report', 'report.json', outcome.files.report],
          ]
        : [];
      items.push(['spec', 'job.json', job]);
      const name = String(spec.name || 'lens').replace(/[^\p{L}\p{N}_-]+/gu, '-');
      saveJob = () => save(job, `${name}.job.json`);
      list.replaceChildren(...items.map(([id, ending, blob]) => button(id, blob, `${name}.${ending}`)));
    },
  };
}

/** @param {string} id @param {Blob} blob @param {string} name */
function button(id, blob, name) {
  return h(
    'button',
    { type: 'button', 'data-save': id, onclick: () => save(blob, name) },
    icon('save'),
    h('span', {}, t(`save.${id}`)),
    h('small', {}, `${name.split('.').slice(1).join('.')}, ${bytes(blob.size)}`),
  );
}
