/**
 * Saving: the path in each format, the report, pictures, the sheet for the machine, and the job itself with its surface.
 *
 * @import { State, Draft } from '../types.js'
 */
import { bytes } from '../format.js';
import { t } from '../text/index.js';
import { h, icon } from './dom.js';
import { save } from './saving.js';

/** @typedef {{ id: string, ending: string, size: number, make: () => Blob }} Item */

/**
 * @param {HTMLElement} root
 * @param {{ onDrawing: (apt: Blob) => Promise<string>, onPicture: () => HTMLCanvasElement | null,
 *   onDomain: () => string | null, onSheet: () => void }} callbacks Drawings are SVG texts.
 */
export function createDownloads(root, { onDrawing, onPicture, onDomain, onSheet }) {
  const list = h('div', { class: 'downloads' });
  const drawings = h('div', { class: 'downloads more' });
  root.append(list, drawings);
  /** Is made when it is wanted. @type {[string, string, () => Promise<Blob | null>][]} */
  const made = [
    [
      'plan',
      'plan.svg',
      async () => (outcome?.files ? svg(await onDrawing(outcome.files.apt)) || null : null),
    ],
    ['domain', 'parameters.svg', async () => svg(onDomain()) || null],
    ['png', 'png', async () => png(onPicture())],
  ];
  const makers = made.map(([id, ending, make]) =>
    h(
      'button',
      {
        type: 'button',
        class: 'small',
        'data-save': id,
        onclick: async () => {
          const blob = await make();
          if (blob && last) save(blob, `${stem(last)}.${ending}`);
        },
      },
      t(`save.${id}`),
    ),
  );
  const sheet = h(
    'button',
    { type: 'button', class: 'small', 'data-save': 'sheet', onclick: onSheet },
    t('save.sheet'),
  );
  drawings.append(...makers, sheet);
  /** @type {State['outcome']} */
  let outcome = null;
  /** @type {unknown} */
  let shownOutcome;
  /** @type {unknown} */
  let shownDraft;
  /** @type {Draft | null} */
  let last = null;

  return {
    /** Saves the job as it is in the form. */
    saveJob() {
      if (last) save(projectOf(last), `${stem(last)}.job.json`);
    },

    /** @param {State} state */
    update({ outcome: now, draft, planned, isFlat, domain }) {
      outcome = now;
      drawings.hidden = outcome === null;
      makers[0].hidden = !outcome?.files;
      makers[1].hidden = !isFlat || !domain;
      sheet.hidden = !outcome?.files;
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
        const item = (/** @type {string} */ id, /** @type {string} */ ending, /** @type {Blob} */ blob) =>
          items.push({ id, ending, size: blob.size, make: () => blob });
        item('apt', 'apt', apt);
        if (nc) item('nc', 'nc', nc);
        item('csv', 'csv', csv);
        item('report', 'report.json', report);
      }
      // A surface is only written out when somebody wants the file.
      const size = jobOf(draft).size + Math.ceil((draft.source.bytes?.length ?? 0) / 3) * 4;
      items.push({ id: 'spec', ending: 'job.json', size, make: () => projectOf(draft) });
      list.replaceChildren(...items.map((item) => button(item, subject)));
    },
  };
}

/** The job as a file. @param {Draft} draft */
function jobOf(draft) {
  return new Blob([`${JSON.stringify(draft.spec, null, 2)}\n`], { type: 'application/json' });
}

/** The job with the file of its surface, so that it opens anywhere. @type {(draft: Draft) => Blob} */
export function projectOf(draft) {
  const { bytes } = draft.source;
  if (!bytes) return jobOf(draft);
  // In pieces: the file may be larger than what a function takes.
  const pieces = [];
  for (let i = 0; i < bytes.length; i += PIECE)
    pieces.push(btoa(String.fromCharCode(...bytes.subarray(i, i + PIECE))));
  const job = JSON.stringify({ ...draft.spec, file: FILE }, null, 2);
  const [before, after] = job.split(`"${FILE}"`);
  const opening = `{ "name": ${JSON.stringify(draft.source.name)}, "base64": "`;
  return new Blob([before, opening, ...pieces, '" }', after, '\n'], { type: 'application/json' });
}

/** Bytes that are encoded at once: a multiple of three, so that the pieces fit together. */
const PIECE = 3 * 8192;
/** Stands in for the file until its bytes are put there. */
const FILE = 'file of the surface';

/** @param {string | null} text */
const svg = (text) => text && new Blob([text], { type: 'image/svg+xml' });

/** @param {HTMLCanvasElement | null} canvas @returns {Promise<Blob | null>} */
const png = (canvas) => new Promise((resolve) => (canvas ? canvas.toBlob(resolve) : resolve(null)));

/** @param {Item} item @param {Draft} draft */
function button({ id, ending, size, make }, draft) {
  return h(
    'button',
    { type: 'button', 'data-save': id, onclick: () => save(make(), `${stem(draft)}.${ending}`) },
    icon('save'),
    h('span', {}, t(`save.${id}`)),
    h('small', {}, t('save.size', { ending, size: bytes(size) })),
  );
}

/** A file name from the job's name: what any system can store. @param {Draft} draft */
export function stem(draft) {
  const name = draft.source.name || draft.spec.name || 'path';
  return name.replace(/\.[^.]*$/, '').replace(/[^\p{L}\p{N}_-]+/gu, '-') || 'path';
}
