/**
 * The way along the path: play, pause, step, scrub, at 1 to 64 times the speed of the machine.
 *
 * @import { State } from '../types.js'
 */
import { feed, length, minutes } from '../format.js';
import { t } from '../text/index.js';
import { attribute, h, icon, say } from './dom.js';
import { createTiming } from './timing.js';

const SPEEDS = [1, 2, 4, 8, 16, 32, 64];
/** Shown first at the least speed with which the whole path takes no longer. */
const PATIENCE_SECONDS = 30;
const STEPS = 10_000;
const KINDS = ['cut', 'link', 'rapid'];

/**
 * @param {HTMLElement} root
 * @param {{ onAt: (at: number) => void }} callbacks
 */
export function createPlayback(root, { onAt }) {
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
  const back = stepper('back', -1);
  const on = stepper('on', 1);
  const speed = h(
    'select',
    { name: 'speed', 'aria-label': t('scrub.speed'), title: t('scrub.speed') },
    ...SPEEDS.map((times) => h('option', { value: times }, `${times}×`)),
  );
  const readout = h('output', {});
  root.append(back, play, on, slider, speed, readout);
  let playing = 0;
  let lastFrame = 0;
  /** @type {State | null} */
  let last = null;
  /** @type {ReturnType<typeof createTiming> | null} */
  let timing = null;

  /** @param {'back' | 'on'} name @param {number} by */
  function stepper(name, by) {
    const button = h(
      'button',
      { type: 'button', class: 'quiet step', name, onclick: () => step(by) },
      icon(name),
    );
    attribute(button, 'aria-label', t(`scrub.${name}`));
    button.title = t(`scrub.${name}`);
    return button;
  }

  /** @param {number} by */
  function step(by) {
    pause();
    if (last && timing) onAt(timing.stepped(last.at, by));
  }

  function toggle() {
    if (playing) {
      pause();
      return;
    }
    if (!timing) return;
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
    if (!timing || !last) return;
    const passed = (Math.max(now - lastFrame, 0) / 60_000) * Number(speed.value);
    const at = timing.atTime(timing.timeAt(last.at) + passed);
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

  return {
    toggle,
    step,

    /** @param {State} state */
    update(state) {
      const { outcome, planned, at } = state;
      if (outcome?.path !== last?.outcome?.path || !timing) {
        timing = outcome && planned ? createTiming(outcome, planned.spec.feeds) : null;
        if (timing && outcome?.path !== last?.outcome?.path) {
          const seconds = timing.minutes * 60;
          speed.value = String(SPEEDS.find((times) => seconds / times <= PATIENCE_SECONDS) ?? SPEEDS.at(-1));
        }
      }
      last = state;
      root.hidden = outcome === null;
      if (!outcome || !timing) {
        if (playing) pause();
        return;
      }
      const all = outcome.path[outcome.path.length - 1] ?? 0;
      slider.value = String(Math.round(at * STEPS));
      const { kind, feed: rate } = timing.moveAt(at);
      const time = minutes(timing.timeAt(at));
      attribute(slider, 'aria-valuetext', `${time}, ${length(at * all)}`);
      const told = {
        time,
        all: minutes(timing.minutes),
        at: length(at * all),
        kind: t(`scrub.kind.${KINDS[kind]}`),
      };
      say(readout, t('scrub.at', { ...told, feed: feed(rate) }));
    },
  };
}
