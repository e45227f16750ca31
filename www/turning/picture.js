/**
 * The part: the map of residues as seen from the tool, or the lens in space, each with the path on it.
 *
 * @import { State, Outcome } from './types.js'
 */
import { length, plain } from '../format.js';
import { css } from '../view/colors.js';
import { attribute, h, say } from '../view/dom.js';
import { drawLens } from './lens.js';
import { drawExtremes, drawMap, drawTouches, residueAt, residueColor, zoom } from './map.js';
import { t } from './text.js';

/** Sharper than this nobody sees, and it costs the square. */
const SHARPEST = 2;
/** Radians that an arrow key turns the lens, and that a pixel does. */
const KEY = 0.12;
const DRAG = 0.008;

/**
 * @param {HTMLElement} root
 * @param {{ onShow: (shown: Partial<State>) => void }} callbacks
 */
export function createPicture(root, { onShow }) {
  const canvas = h('canvas', { tabindex: 0, 'aria-label': t('picture.label') });
  const reading = h('output', { class: 'reading' });
  /** @param {'map' | 'lens'} view */
  const viewButton = (view) =>
    h(
      'button',
      { type: 'button', class: 'small', 'data-view': view, onclick: () => onShow({ view }) },
      t(`picture.${view}`),
    );
  const [map, lens] = [viewButton('map'), viewButton('lens')];
  const path = h('input', { type: 'checkbox', name: 'path' });
  path.addEventListener('change', () => onShow({ path: path.checked }));
  const range = h('select', { name: 'range', 'aria-label': t('picture.range') });
  range.addEventListener('change', () => onShow({ range: /** @type {State['range']} */ (range.value) }));
  const [low, high] = [h('span', {}), h('span', {})];
  const swatches = Array.from({ length: 11 }, () => h('i', {}));
  const beyond = h('p', { class: 'beyond' });
  root.append(
    canvas,
    h(
      'div',
      { class: 'tools' },
      h('div', { class: 'switch', role: 'group' }, map, lens),
      h('label', {}, path, t('picture.path')),
      h('label', {}, t('picture.range'), range),
    ),
    h(
      'div',
      { class: 'scale', role: 'group', 'aria-label': t('picture.title') },
      h(
        'div',
        { class: 'ends' },
        h('span', {}, t('picture.dug')),
        h('strong', {}, t('picture.title')),
        h('span', {}, t('picture.left')),
      ),
      h('div', { class: 'ramp', 'aria-hidden': 'true' }, ...swatches),
      h('div', { class: 'ends numbers' }, low, h('span', {}, '0'), high),
      beyond,
    ),
    reading,
  );
  let camera = { yaw: -0.6, pitch: 0.75 };
  /** @type {State | null} */
  let last = null;
  let isScheduled = false;

  /** @param {number} yaw @param {number} pitch */
  function turn(yaw, pitch) {
    if (last?.view !== 'lens') return;
    camera = { yaw: camera.yaw + yaw, pitch: Math.min(1.5, Math.max(0.05, camera.pitch + pitch)) };
    schedule();
  }

  canvas.addEventListener('keydown', (event) => {
    /** @type {Record<string, number[]>} */
    const keys = { ArrowLeft: [-KEY, 0], ArrowRight: [KEY, 0], ArrowUp: [0, KEY], ArrowDown: [0, -KEY] };
    const step = keys[event.key];
    if (!step || last?.view !== 'lens') return;
    event.preventDefault();
    turn(step[0], step[1]);
  });
  canvas.addEventListener('pointerdown', (event) => canvas.setPointerCapture(event.pointerId));
  canvas.addEventListener('pointermove', (event) => {
    if (event.buttons === 1) turn(-event.movementX * DRAG, event.movementY * DRAG);
    tell(event);
  });
  canvas.addEventListener('pointerleave', () => say(reading, ''));

  /** Says what is under the pointer. @param {PointerEvent} event */
  function tell({ offsetX, offsetY }) {
    const { outcome, view } = last ?? {};
    if (!outcome?.residues || view !== 'map') return say(reading, '');
    const { clientWidth, clientHeight, width } = canvas;
    const scale = (zoom(canvas, outcome.farthest) * clientWidth) / width;
    const [x, y] = [(offsetX - 0.5 * clientWidth) / scale, (0.5 * clientHeight - offsetY) / scale];
    const residue = residueAt(outcome.residues, outcome.farthest, x, y);
    const value = Number.isFinite(residue)
      ? `${plain(Number((residue * 1000).toFixed(3)))} µm`
      : t('picture.uncut');
    const places = { x: length(x), y: length(y), value };
    say(reading, Number.isNaN(residue) ? '' : t('picture.reading', places));
  }

  function schedule() {
    if (isScheduled) return;
    isScheduled = true;
    requestAnimationFrame(() => {
      isScheduled = false;
      draw();
    });
  }

  function draw() {
    const ratio = Math.min(devicePixelRatio, SHARPEST);
    const [width, height] = [canvas.clientWidth, canvas.clientHeight].map((n) => Math.round(n * ratio));
    if (!last?.outcome || width === 0 || height === 0) return;
    canvas.width = width;
    canvas.height = height;
    const context = canvas.getContext('2d');
    if (!context) return;
    const style = getComputedStyle(root);
    const color = (/** @type {string} */ name) => style.getPropertyValue(name).trim();
    const most = scale(last.outcome, last.range);
    const isBand = last.range !== 'own';
    if (last.view === 'map') {
      drawMap(context, last.outcome, most, isBand);
      if (last.path) drawTouches(context, last.outcome, color('--path-cut'));
      drawExtremes(context, last.outcome, [color('--ink'), color('--panel')], ratio);
    } else {
      const lines = last.path ? color('--path-over') : null;
      const paint = (/** @type {number} */ residue) => residueColor(residue, most, isBand);
      drawLens(context, last.outcome, paint, camera, lines, color('--surface-front'));
    }
    root.dataset.drawn = last.view;
  }

  new ResizeObserver(schedule).observe(canvas);
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', schedule);

  return {
    /** @param {State} state */
    update(state) {
      const keys = /** @type {const} */ (['outcome', 'view', 'path', 'range', 'planned']);
      if (last && keys.every((key) => last?.[key] === state[key])) return;
      last = state;
      attribute(map, 'aria-pressed', String(state.view === 'map'));
      attribute(lens, 'aria-pressed', String(state.view === 'lens'));
      path.checked = state.path;
      const { outcome } = state;
      const bands = outcome?.report.verified?.bands ?? [];
      const names = [t('picture.range.own'), ...bands.map(({ limit_mm }) => `±${plain(limit_mm)} mm`)];
      range.replaceChildren(
        ...names.map((name, i) => h('option', { value: ['own', 'fine', 'wide'][i] }, name)),
      );
      range.value = state.range;
      const most = outcome ? scale(outcome, state.range) * 1000 : 0;
      say(low, most ? `−${plain(Number(most.toPrecision(3)))}` : '');
      say(high, most ? `+${plain(Number(most.toPrecision(3)))}` : '');
      const isBand = state.range !== 'own';
      swatches.forEach((swatch, i) => {
        // The outermost two stand for what is beyond.
        swatch.style.background = css(residueColor((i / 5 - 1) * (isBand ? 1.25 : 1), 1, isBand));
      });
      const band = isBand ? bands[state.range === 'fine' ? 0 : 1] : null;
      const shares = band && { over: few(band.over), under: few(band.under) };
      say(beyond, shares ? t('picture.beyond', shares) : '');
      beyond.hidden = !band;
      schedule();
    },
  };
}

/** A share of little, %. @param {number} share */
const few = (share) => `${plain(Number((share * 100).toPrecision(2)))} %`;

/** The residue that the ends of the colours stand for, mm. @param {Outcome} outcome @param {State['range']} range */
function scale({ report }, range) {
  const { verified } = report;
  if (!verified) return 0.01;
  if (range !== 'own') return verified.bands[range === 'fine' ? 0 : 1].limit_mm;
  return Math.max(Math.abs(verified.residue?.mm ?? 0), Math.abs(verified.overcut?.mm ?? 0)) || 1e-6;
}
