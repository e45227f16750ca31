/**
 * The picture's controls: standard views, layers, and the position on the path.
 *
 * @import { State, Layers, TintName } from '../types.js'
 */
import { length } from '../format.js';
import { t } from '../text/index.js';
import { attribute, h, icon, say } from './dom.js';
import { TINTS, tintsOf } from './tint.js';

const VIEWS = /** @type {const} */ (['fit', 'iso', 'top', 'front']);
const LAYERS = /** @type {('passes' | 'links' | 'rapids' | 'zones' | 'cutter' | 'side')[]} */ ([
  'passes',
  'links',
  'rapids',
  'zones',
  'cutter',
  'side',
]);
/** Playing shows the whole path in this time. */
const PLAY_SECONDS = 20;
const STEPS = 10_000;

/** @typedef {(typeof VIEWS)[number]} ViewName */

/**
 * @param {{ views: HTMLElement, layers: HTMLElement, scrub: HTMLElement }} roots
 * @param {{ onView: (view: ViewName) => void, onLayers: (layers: Layers) => void, onAt: (at: number) => void }} callbacks
 */
export function createTools(roots, { onView, onLayers, onAt }) {
  roots.views.append(
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

  const slider = h('input', {
    type: 'range',
    min: 0,
    max: STEPS,
    step: 1,
    name: 'at',
    'aria-label': t('scrub.label'),
    oninput: () => {
      pause();
      onAt(slider.valueAsNumber / STEPS);
    },
  });
  const play = h('button', { type: 'button', class: 'quiet', name: 'play', onclick: toggle });
  const readout = h('output', {});
  roots.scrub.append(play, slider, readout);
  let playing = 0;
  let lastFrame = 0;

  function toggle() {
    if (playing) {
      pause();
      return;
    }
    if ((last?.at ?? 1) >= 1) onAt(0);
    lastFrame = performance.now();
    playing = requestAnimationFrame(advance);
    showPlay();
  }

  function pause() {
    cancelAnimationFrame(playing);
    playing = 0;
    showPlay();
  }

  /** @param {number} now */
  function advance(now) {
    const at = Math.min((last?.at ?? 1) + Math.max(now - lastFrame, 0) / 1000 / PLAY_SECONDS, 1);
    lastFrame = now;
    playing = requestAnimationFrame(advance);
    onAt(at);
    if (at >= 1) pause();
  }

  function showPlay() {
    const name = playing ? 'pause' : 'play';
    attribute(play, 'aria-label', t(`scrub.${name}`));
    play.replaceChildren(icon(name));
  }
  showPlay();

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
    /** @param {State} state */
    update(state) {
      if (last?.outcome !== state.outcome || last?.layers !== state.layers) showTints(state);
      last = state;
      const { outcome, at } = state;
      showToggles(state.layers, state);
      roots.scrub.hidden = outcome === null;
      if (!outcome) {
        if (playing) pause();
        return;
      }
      const all = outcome.path[outcome.path.length - 1] ?? 0;
      slider.value = String(Math.round(at * STEPS));
      attribute(slider, 'aria-valuetext', length(at * all));
      say(readout, t('scrub.at', { at: length(at * all), all: length(all) }));
    },
  };
}
