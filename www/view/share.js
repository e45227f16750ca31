/**
 * Sharing: the link, what it holds and how long it is; or a file where a link would be too long.
 *
 * @import { State } from '../types.js'
 */
import { count, micron } from '../format.js';
import { linked, MOST, WISHED } from '../share/link.js';
import { t } from '../text/index.js';
import { toClipboard } from './clipboard.js';
import { attribute, h, icon, say } from './dom.js';
import { projectOf, stem } from './downloads.js';
import { save } from './saving.js';

/** A course page shows the picture so. */
const FRAME = 'width="800" height="520" style="border:0" loading="lazy"';

const COPIED = { copy: t('share.copy'), copied: t('share.copied') };

/**
 * @param {HTMLElement} root Where the button goes.
 * @param {() => State} read
 */
export function createShare(root, read) {
  const link = h('textarea', {
    name: 'link',
    rows: 4,
    readonly: true,
    spellcheck: 'false',
    'aria-label': t('share.link'),
  });
  const frame = h('textarea', {
    name: 'frame',
    rows: 3,
    readonly: true,
    spellcheck: 'false',
    'aria-label': t('share.frame'),
  });
  const about = h('p', { class: 'about' });
  const size = h('p', { class: 'help', 'aria-live': 'polite' });
  const copy = h(
    'button',
    { type: 'button', class: 'primary', name: 'copy', onclick: () => toClipboard(link, copy, COPIED) },
    t('share.copy'),
  );
  const copyFrame = h(
    'button',
    { type: 'button', name: 'copy-frame', onclick: () => toClipboard(frame, copyFrame, COPIED) },
    t('share.copy'),
  );
  const asFile = h(
    'button',
    { type: 'button', name: 'share-file', onclick: saveJob },
    icon('save'),
    t('share.file'),
  );
  const parts = h(
    'div',
    { class: 'parts' },
    link,
    copy,
    h('details', {}, h('summary', {}, t('share.frame')), frame, copyFrame),
  );
  const dialog = h(
    'dialog',
    { class: 'sheet share', 'aria-labelledby': 'share-title' },
    h(
      'div',
      { class: 'head' },
      h('h2', { id: 'share-title' }, t('share.title')),
      h(
        'button',
        { type: 'button', class: 'quiet', 'aria-label': t('action.close'), onclick: () => dialog.close() },
        icon('close'),
      ),
    ),
    about,
    parts,
    size,
    asFile,
  );
  const button = h(
    'button',
    { type: 'button', name: 'share', 'aria-label': t('share.open'), onclick: show },
    icon('share'),
    h('span', {}, t('share.open')),
  );
  root.append(button, dialog);

  async function show() {
    const { draft, outcome, planned, picture } = read();
    if (!draft) return;
    const isCurrent = outcome !== null && planned === draft;
    const isPreview = draft.spec.source.kind === 'file';
    say(about, t(isPreview ? (isCurrent ? 'share.preview' : 'share.unplanned') : 'share.whole'));
    say(size, '');
    link.value = '';
    parts.hidden = asFile.hidden = true;
    dialog.showModal();
    if (isPreview && !isCurrent) return;
    const name = draft.source.id ? draft.spec.name : draft.source.name || draft.spec.name;
    const shown = outcome?.picture ?? picture;
    const { fragment, precision } = await linked({
      spec: draft.spec,
      name,
      outcome: isCurrent ? outcome : null,
      picture: shown,
      isPreview,
    });
    const base = `${location.origin}${location.pathname}`;
    link.value = base + fragment;
    frame.value = `<iframe src="${base}?embed${fragment}" title="Stepover" ${FRAME}></iframe>`;
    const isTooLong = fragment.length > MOST;
    parts.hidden = isTooLong;
    asFile.hidden = !isTooLong;
    attribute(dialog, 'data-letters', String(fragment.length));
    const told = [t('share.size', { letters: count(fragment.length) })];
    if (precision !== null) told.push(t('share.precision', { precision: micron(precision) }));
    if (isTooLong) told.push(t('share.too_long', { most: count(MOST) }));
    else if (fragment.length > WISHED) told.push(t('share.long', { wished: count(WISHED) }));
    say(size, told.join(' '));
    if (!isTooLong) link.select();
  }

  function saveJob() {
    const { draft } = read();
    if (!draft) return;
    save(projectOf(draft), `${stem(draft)}.job.json`);
  }
}
