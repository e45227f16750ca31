/**
 * The picture's controls: standard views and layers.
 *
 * @import { State, Layers, TintName } from '../types.js'
 */
import { t } from '../text/index.js';
import { attribute, h } from './dom.js';
import { TINTS, tintsOf } from './tint.js';

const VIEWS = /** @type {const} */ (['fit', 'iso']);
const LAYERS = /** @type {('passes' | 'links' | 'rapids' | 'zones' | 'cutter' | 'side')[]} */ ([
  'passes',
  'links',
  'rapids',
  'zones',
  'cutter',
  'side',
]);

/** @typedef {(typeof VIEWS)[number]} ViewName */

/**
 * @param {{ views: HTMLElement, layers: HTMLElement }} roots
 * @param {{ onView: (view: ViewName) => void, onParallel: (isParallel: boolean) => void,
 *   onFlat: (isFlat: boolean) => void, onLayers: (layers: Layers) => void}} callbacks
 */
export function createTools(roots, { onView, onParallel, onFlat, onLayers }) {
  const parallel = h(
    'button',
    {
      type: 'button',
      name: 'parallel',
      'aria-pressed': 'false',
      title: t('canvas.parallel.hint'),
      onclick: switchLens,
    },
    t('canvas.parallel'),
  );
  const flat = h(
    'button',
    {
      type: 'button',
      name: 'flat',
      'aria-pressed': 'false',
      title: t('canvas.flat.hint'),
      onclick: () => last && onFlat(!last.isFlat),
    },
    t('canvas.flat'),
  );

  function switchLens() {
    const isParallel = parallel.getAttribute('aria-pressed') !== 'true';
    attribute(parallel, 'aria-pressed', String(isParallel));
    onParallel(isParallel);
  }

  roots.views.append(
    flat,
    parallel,
    ...VIEWS.map((view) =>
      h('button', { type: 'button', name: `view-${view}`, onclick: () => onView(view) }, t(`canvas.${view}`)),
    ),
  );
  /** @type {State | null} */
  let last = null;
  const toggles = LAYERS.map((layer) => {
    const button = h(
      'button',
      {
        type: 'button',
        'data-layer': layer,
        onclick: () => last && onLayers({ ...last.layers, [layer]: !last.layers[layer] }),
      },
      h('i', { 'aria-hidden': 'true' }),
      t(`layer.${layer}`),
    );
    roots.layers.append(button);
    return { layer, button };
  });
  const tints = TINTS.map((name) => h('option', { value: name }, t(`tint.${name}`)));
  const tint = h(
    'select',
    {
      name: 'tint',
      onchange: () => last && onLayers({ ...last.layers, tint: /** @type {TintName} */ (tint.value) }),
    },
    ...tints,
  );
  const tinting = h('label', {}, t('tint.label'), tint);
  roots.layers.prepend(tinting);

  /** @param {Layers} layers @param {State} state */
  function showToggles(layers, state) {
    roots.layers.hidden = state.outcome === null;
    for (const { layer, button } of toggles) {
      attribute(button, 'aria-pressed', String(layers[layer]));
      const { outcome } = state;
      button.hidden =
        !outcome ||
        (layer === 'links' && !outcome.report.length.link_mm) ||
        (layer === 'rapids' && !outcome.report.length.rapid_mm) ||
        (layer === 'cutter' && outcome.isPreview) ||
        (layer === 'zones' && outcome.zones.length === 0);
    }
  }

  /** @param {State} state */
  function showTints({ outcome, layers }) {
    const there = tintsOf(outcome);
    tinting.hidden = there.length < 2;
    tints.forEach((option, i) => {
      option.hidden = option.disabled = !there.includes(TINTS[i]);
    });
    tint.value = there.includes(layers.tint) ? layers.tint : 'none';
  }

  return {
    switchLens,

    /** @param {State} state */
    update(state) {
      attribute(flat, 'aria-pressed', String(state.isFlat));
      flat.hidden = !state.outcome || state.outcome.isPreview === true;
      if (last?.outcome !== state.outcome || last?.layers !== state.layers) showTints(state);
      last = state;
      showToggles(state.layers, state);
    },
  };
}
