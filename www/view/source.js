/**
 * What is cut: the gallery, or a file with its face, unit and side.
 *
 * @import { State, Source, Spec, Face } from '../types.js'
 */
import { box, bytes as size } from '../format.js';
import { prettify, t } from '../text/index.js';
import { attribute, h, icon, say } from './dom.js';
import { glyph } from './glyphs.js';

/** What the file picker offers; the planner decides by content. */
const ENDINGS = '.igs,.iges,.stl,.obj,.csv,.txt,.xyz,.cpt,.cptw,.json';
const UNITS = ['mm', 'cm', 'm', 'inch'];
/** @type {Record<string, number>} */
const MILLIMETRES = { mm: 1, cm: 10, m: 1000, inch: 25.4 };

/**
 * @param {HTMLElement} root
 * @param {{ onPick: (id: string) => void, onFiles: (files: File[]) => void, onFace: (index: number) => void,
 *   onUnit: (unit: string) => void, onSide: () => void, limit: number }} callbacks
 */
export function createSource(root, { onPick, onFiles, onFace, onUnit, onSide, limit }) {
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
  root.append(gallery, h('div', { class: 'opener' }, open, picker), hint, file, sideRow);

  /** @type {unknown} */
  let shownGallery = null;
  /** @type {unknown} */
  let shownInfo = null;
  let shownKey = '';

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

  /** @param {Source} source @param {Spec} spec */
  function showFile({ name, bytes, info }, spec) {
    const key = `${spec.source.face} ${spec.source.unit}`;
    if (shownInfo === info && shownKey === key) return;
    shownInfo = info;
    shownKey = key;
    if (!info || !bytes) {
      file.replaceChildren();
      return;
    }
    const face = info.faces.find((f) => f.index === spec.source.face) ?? info.faces[0];
    file.replaceChildren(
      h(
        'p',
        { class: 'name' },
        h('strong', {}, name),
        h('span', {}, `${info.format} · ${size(bytes.length)}`),
      ),
      ...(info.faces.length > 1 ? [faceSelect(info.faces, face, info.unit ?? spec.source.unit)] : []),
      face.detail ? h('p', { class: 'help' }, face.detail) : '',
      unitRow(info.unit, spec.source.unit, face),
      ...info.warnings.map((warning) => h('p', { class: 'warning' }, warning)),
    );
  }

  /** @param {Face[]} faces @param {Face} face @param {string | null} unit */
  function faceSelect(faces, face, unit) {
    const options = faces.map((f) => {
      const name = f.name || t('surface.face.unnamed', { index: f.index + 1 });
      const size = box(f.bounds_mm, unit ? 'mm' : '');
      const text = t('surface.face.option', { name, size });
      return h('option', { value: f.index, selected: f.index === face.index }, text);
    });
    const select = h(
      'select',
      { name: 'source.face', onchange: () => onFace(Number(select.value)) },
      ...options,
    );
    return h(
      'label',
      { class: 'field wide' },
      h('span', {}, t('surface.face')),
      select,
      h('span', { class: 'help' }, t('surface.face.hint')),
    );
  }

  /** @param {string | null} stated @param {string | null} unit @param {Face} face */
  function unitRow(stated, unit, face) {
    if (stated !== null) {
      const text = t('surface.unit.of', { unit: t(`unit.${stated}`, {}, stated) });
      return h(
        'div',
        { class: 'field' },
        h('span', {}, t('surface.unit')),
        h('span', { class: 'value' }, text),
      );
    }
    const asked = unit === null || unit === undefined;
    // The bounds of a file without a unit are stated as if it were the millimetre.
    const choices = UNITS.map((choice) => {
      const factor = MILLIMETRES[choice];
      const [low, high] = face.bounds_mm;
      return h(
        'label',
        { class: 'choice' },
        h('input', {
          type: 'radio',
          name: 'source.unit',
          value: choice,
          checked: choice === unit,
          onchange: () => onUnit(choice),
        }),
        h('strong', {}, t(`unit.${choice}`)),
        h('span', {}, box([low.map((x) => x * factor), high.map((x) => x * factor)], 'mm')),
      );
    });
    return h(
      'fieldset',
      { class: asked ? 'units asked' : 'units', 'data-field': 'source.unit' },
      h('legend', {}, t(asked ? 'surface.unit.ask' : 'surface.unit')),
      ...choices,
    );
  }

  return {
    /** @param {State} state */
    update(state) {
      showGallery(state);
      sideRow.hidden = !state.draft;
      if (!state.draft) return;
      showFile(state.draft.source, state.draft.spec);
      say(side, t(`surface.side.${state.draft.spec.source.side ?? 'front'}`));
    },

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
