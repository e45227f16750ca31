/**
 * What the axes do over the time of the program, with their limits; a click goes to that moment.
 *
 * @import { State, Axis } from './types.js'
 */
import { minutes, plain } from '../format.js';
import { attribute, h, s, say } from '../view/dom.js';
import { t } from './text.js';

const SIZE = { width: 298, height: 54 };
/** Columns of a plot: two a pixel on a sharp screen. */
const COLUMNS = 300;
/** Seconds that are shown around the playhead. */
const NEAR = 10;

/**
 * @param {HTMLElement} root
 * @param {{ onSeconds: (seconds: number) => void,
 *   ask: (speeds: boolean, from: number, to: number, columns: number) => Promise<Float32Array[]> }} callbacks
 */
export function createPlots(root, { onSeconds, ask }) {
  const kind = choice('plot', ['position', 'speed']);
  const span = choice('span', ['whole', 'near']);
  const time = h('p', { class: 'help' });
  const rows = h('div', { class: 'rows' });
  root.append(
    h('h3', {}, t('plot.title')),
    h('div', { class: 'switches' }, kind.element, span.element),
    rows,
    time,
  );
  let shown = { work: /** @type {unknown} */ (null), key: '' };
  let window_ = [0, 1];
  /** @type {{ value: HTMLElement, mark: SVGElement }[]} */
  let marks = [];
  /** @type {State | null} */
  let last = null;

  /** @param {string} name @param {string[]} words */
  function choice(name, words) {
    const select = h(
      'select',
      { name: `machine-${name}`, 'aria-label': t('plot.title'), onchange: () => last && update(last) },
      ...words.map((word) => h('option', { value: word }, t(`plot.${word}`))),
    );
    return { element: select, value: () => select.value };
  }

  /** @param {State} state */
  async function redraw({ work, moment }) {
    if (!work) return;
    const { axes, seconds } = work.report;
    const now = moment?.seconds ?? 0;
    const isNear = span.value() === 'near';
    const from = isNear ? Math.max(0, Math.min(now - NEAR / 2, seconds.shown - NEAR)) : 0;
    const to = isNear ? Math.min(seconds.shown, from + NEAR) : seconds.shown;
    const speeds = kind.value() === 'speed';
    const bands = await ask(speeds, from, to, COLUMNS);
    if (shown.work !== work || bands.length === 0) return;
    window_ = [from, to];
    marks = [];
    rows.replaceChildren(...axes.map((axis, k) => row(axis, bands[k], speeds)));
    if (last) point(last);
  }

  /** @param {Axis} axis @param {Float32Array} band @param {boolean} speeds */
  function row(axis, band, speeds) {
    const known = band.filter((x) => !Number.isNaN(x));
    const [least, most] = known.reduce(
      ([a, b], x) => [Math.min(a, x), Math.max(b, x)],
      [known[0] ?? 0, known[0] ?? 0],
    );
    const limits = speeds ? [-axis.speed, axis.speed] : axis.limits;
    const unit = speeds ? `${axis.unit}/s` : axis.unit;
    const told = (/** @type {number} */ x) => `${plain(Number(x.toFixed(speeds ? 1 : 2)))} ${unit}`;
    // The limits are drawn where they are near enough to be seen beside what the axis does.
    const room = Math.max(0.15 * (most - least), 0.5);
    const near = (limits ?? []).filter(
      (x) => x > least - 1.5 * (most - least) - room && x < most + 1.5 * (most - least) + room,
    );
    const [low, high] = [
      Math.min(least - room, ...near.map((x) => x - room / 3)),
      Math.max(most + room, ...near.map((x) => x + room / 3)),
    ];
    const y = (/** @type {number} */ x) => SIZE.height - ((x - low) / (high - low)) * SIZE.height;
    const x = (/** @type {number} */ k) => ((k + 0.5) / COLUMNS) * SIZE.width;
    let path = '';
    let isDown = false;
    for (let k = 0; k < COLUMNS; k += 1) {
      const [a, b] = [band[2 * k], band[2 * k + 1]];
      if (Number.isNaN(a)) isDown = false;
      else {
        path += `${isDown ? 'L' : 'M'}${x(k).toFixed(1)} ${y(a).toFixed(1)}L${x(k).toFixed(1)} ${y(b).toFixed(1)}`;
        isDown = true;
      }
    }
    const mark = s('path', { class: 'at' });
    const value = h('output', {});
    marks.push({ value, mark });
    const svg = s(
      'svg',
      {
        viewBox: `0 0 ${SIZE.width} ${SIZE.height}`,
        preserveAspectRatio: 'none',
        role: 'img',
        'aria-label': t('plot.label', { axis: axis.letter, least: told(least), most: told(most) }),
        onpointerdown: go,
      },
      ...near.map((limit) => s('path', { class: 'limit', d: `M0 ${y(limit).toFixed(1)}H${SIZE.width}` })),
      s('path', { class: 'line', d: path }),
      mark,
    );
    const bounds = speeds
      ? t('plot.most', { most: told(axis.speed) })
      : limits
        ? t('plot.limits', { low: plain(limits[0]), high: told(limits[1]) })
        : t('plot.endless');
    return h(
      'figure',
      { 'data-axis': axis.letter },
      h('figcaption', {}, h('strong', {}, axis.letter), value, h('span', { class: 'bounds' }, bounds)),
      svg,
    );
  }

  /** @param {PointerEvent} event */
  function go(event) {
    const { left, width } = /** @type {Element} */ (event.currentTarget).getBoundingClientRect();
    const share = Math.min(Math.max((event.clientX - left) / width, 0), 1);
    onSeconds(window_[0] + share * (window_[1] - window_[0]));
  }

  /** Marks the moment. @param {State} state */
  function point({ work, moment }) {
    if (!work || !moment) return;
    const share = (moment.seconds - window_[0]) / (window_[1] - window_[0] || 1);
    for (const [k, { value, mark }] of marks.entries()) {
      const { unit } = work.report.axes[k];
      say(value, `${moment.positions[k].toFixed(3).replace('-', '−')} ${unit}`);
      attribute(mark, 'd', `M${(share * SIZE.width).toFixed(1)} 0V${SIZE.height}`);
    }
    say(time, t('plot.at', { time: minutes(moment.seconds / 60) }));
  }

  /** @param {State} state */
  function update(state) {
    last = state;
    root.hidden = !state.work;
    if (!state.work) return;
    const { moment } = state;
    const isOutside = moment && (moment.seconds < window_[0] || moment.seconds > window_[1]);
    const turn = span.value() === 'near' && isOutside ? ` ${Math.floor(moment.seconds / (NEAR / 2))}` : '';
    const key = `${kind.value()} ${span.value()}${turn}`;
    if (shown.work !== state.work || (shown.key !== key && (turn || !shown.key.startsWith(key)))) {
      shown = { work: state.work, key };
      redraw(state);
    }
    point(state);
  }

  return { update };
}
