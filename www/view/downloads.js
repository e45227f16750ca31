/**
 * Saving: the path in each format, the report, and the job itself.
 *
 * @import { State, Draft } from '../types.js'
 */
import { bytes } from '../format.js';
import { t } from '../text/index.js';
import { h, icon } from './dom.js';

/** @typedef {{ id: string, ending: string, blob: Blob }} Item */

/** @param {HTMLElement} root */
export function createDownloads(root) {
  const list = h('div', { class: 'downloads' });
  root.append(list);
  /** @type {unknown} */
  let shownOutcome;
  /** @type {unknown} */
  let shownDraft;
  /** @type {Draft | null} */
  let last = null;

  return {
    /** Saves the job as it is in the form. */
    saveJob() {
      if (last) save(jobOf(last), `${stem(last)}.job.json`);
    },

    /** @param {State} state */
    update({ outcome, draft, planned }) {
      if (outcome === shownOutcome && draft === shownDraft) return;
      shownOutcome = outcome;
      shownDraft = draft;
      last = draft;
      if (!draft) return;
      const subject = planned ?? draft;
      /** @type {Item[]} */
      const items = [];
      if (outcome?.files) {
        const { apt, nc, csv, report } = outcome.files;
        items.push({ id: 'apt', ending: 'apt', blob: apt });
        if (nc) items.push({ id: 'nc', ending: 'nc', blob: nc });
        items.push({ id: 'csv', ending: 'csv', blob: csv });
        items.push({ id: 'report', ending: 'report.json', blob: report });
      }
      items.push({ id: 'spec', ending: 'job.json', blob: jobOf(draft) });
      list.replaceChildren(...items.map((item) => button(item, subject)));
    },
  };
}

/** The job as a file. @param {Draft} draft */
export function jobOf(draft) {
  return new Blob([`${JSON.stringify(draft.spec, null, 2)}\n`], { type: 'application/json' });
}

/** @param {Item} item @param {Draft} draft */
function button({ id, ending, blob }, draft) {
  return h(
    'button',
    { type: 'button', 'data-save': id, onclick: () => save(blob, `${stem(draft)}.${ending}`) },
    icon('save'),
    h('span', {}, t(`save.${id}`)),
    h('small', {}, t('save.size', { ending, size: bytes(blob.size) })),
  );
}

/** A file name from the job's name: what any system can store. @param {Draft} draft */
export function stem(draft) {
  const name = draft.source.name || draft.spec.name || 'path';
  return name.replace(/\.[^.]*$/, '').replace(/[^\p{L}\p{N}_-]+/gu, '-') || 'path';
}

/** @param {Blob} blob @param {string} name */
export function save(blob, name) {
  const href = URL.createObjectURL(blob);
  h('a', { href, download: name }).click();
  // The browser has taken the blob by then.
  setTimeout(() => URL.revokeObjectURL(href), 10_000);
}
