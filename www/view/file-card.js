/**
 * A loaded file: what is in it, and what it does not say by itself.
 *
 * @import { State, Face } from '../types.js'
 */
import { box, bytes as size } from '../format.js';
import { t } from '../text/index.js';
import { h, say } from './dom.js';

const UNITS = ['mm', 'cm', 'm', 'inch'];
/** @type {Record<string, number>} */
const MILLIMETRES = { mm: 1, cm: 10, m: 1000, inch: 25.4 };

/**
 * @typedef {{ onFace: (index: number) => void, onUnit: (unit: string) => void,
 *   onScale: (scale: number[]) => void }} FileCallbacks
 */

/**
 * @param {HTMLElement} root
 * @param {FileCallbacks} callbacks
 */
export function createFileCard(root, { onFace, onUnit, onScale }) {
  /** @type {unknown} */
  let shownInfo = null;
  let shownKey = '';
  /** @type {HTMLInputElement[]} */
  let factors = [];
  /** @type {((scale: number[]) => void)[]} */
  let showSizes = [];

  /** @param {Face[]} faces @param {Face} face */
  function faceSelect(faces, face) {
    const options = faces.map((f) => {
      const name = f.name || t('surface.face.unnamed', { index: f.index + 1 });
      return h('option', { value: f.index, selected: f.index === face.index }, name);
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

  /** @param {string} unit */
  function statedUnit(unit) {
    const text = t('surface.unit.of', { unit: t(`unit.${unit}`, {}, unit) });
    return h(
      'div',
      { class: 'field' },
      h('span', {}, t('surface.unit')),
      h('span', { class: 'value' }, text),
    );
  }

  /** Asks for the unit by the size that each would give. @param {string | null} unit @param {Face} face */
  function unitQuestion(unit, face) {
    const choices = UNITS.map((choice) => {
      const shown = h('span', {});
      // The bounds of a file without a unit are stated as if it were the millimetre.
      const [low, high] = face.bounds_mm.map((p) => p.map((x) => x * MILLIMETRES[choice]));
      showSizes.push((scale) => {
        const scaled = (/** @type {number[]} */ p) => p.map((x, i) => x * scale[i]);
        say(shown, box([scaled(low), scaled(high)], 'mm'));
      });
      const input = h('input', {
        type: 'radio',
        name: 'source.unit',
        value: choice,
        checked: choice === unit,
        onchange: () => onUnit(choice),
      });
      return h('label', { class: 'choice' }, input, h('strong', {}, t(`unit.${choice}`)), shown);
    });
    return h(
      'fieldset',
      { class: unit ? 'units' : 'units asked', 'data-field': 'source.unit' },
      h('legend', {}, t(unit ? 'surface.unit' : 'surface.unit.ask')),
      ...choices,
    );
  }

  /** Factors, for files whose numbers are no lengths. */
  function scaleRow() {
    factors = ['x', 'y', 'z'].map((axis) =>
      h('input', {
        type: 'number',
        name: `source.scale.${axis}`,
        'aria-label': t('surface.scale.axis', { axis }),
        step: 'any',
        oninput: () => {
          const scale = factors.map((input) => input.valueAsNumber);
          if (scale.every((factor) => factor > 0)) onScale(scale);
        },
      }),
    );
    return h(
      'div',
      { class: 'field scales', 'data-field': 'source.scale' },
      h('span', {}, t('surface.scale')),
      h('span', { class: 'value' }, ...factors),
      h('p', { class: 'help' }, t('surface.scale.hint')),
    );
  }

  return {
    /** @param {State} state */
    update({ draft }) {
      const info = draft?.source.info ?? null;
      if (!draft?.source.bytes || !info) {
        shownInfo = null;
        root.replaceChildren();
        return;
      }
      const { face: index, unit, scale } = draft.spec.source;
      const key = `${index} ${unit} ${scale !== undefined}`;
      if (shownInfo !== info || shownKey !== key) {
        shownInfo = info;
        shownKey = key;
        showSizes = [];
        factors = [];
        const face = info.faces.find((f) => f.index === index) ?? info.faces[0];
        const about = `${info.format} · ${size(draft.source.bytes.length)}`;
        const parts = [
          h('p', { class: 'name' }, h('strong', {}, draft.source.name), h('span', {}, about)),
          info.faces.length > 1 && faceSelect(info.faces, face),
          face.detail && h('p', { class: 'help' }, face.detail),
          info.unit === null ? unitQuestion(unit ?? null, face) : statedUnit(info.unit),
          scale !== undefined && scaleRow(),
          ...info.warnings.map((warning) => h('p', { class: 'warning' }, warning)),
        ];
        root.replaceChildren(...parts.filter((part) => part instanceof HTMLElement));
      }
      for (const show of showSizes) show(scale ?? [1, 1, 1]);
      factors.forEach((input, i) => {
        if (input.valueAsNumber !== scale[i] && input !== document.activeElement) input.value = scale[i];
      });
    },
  };
}
