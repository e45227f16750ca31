/**
 * A figure that is computed while somebody reads: a drawing with a text for who does not see it, handles to change it, and its
 * numbers as a table.
 */
import { Cancelled } from '../protocol.js';
import { attribute, h, s, say } from '../view/dom.js';
import { t } from './text.js';

/**
 * @typedef {{ id: string, min: number, max: number, step: number, value: number, unit: string }} Handle
 * @typedef {{ head: string[], rows: (string | number)[][] }} Table
 * @typedef {{ alt: string, caption: string, table: Table, legend?: [string, string][] }} Told
 * `legend` has the class of each line and what it is.
 */

/**
 * @param {string} id The texts' ids begin so.
 * @param {Handle[]} handles
 * @param {(values: Record<string, number>, svg: SVGSVGElement, tell: (fraction: number) => void) => Promise<Told>} compute
 */
export function createFigure(id, handles, compute) {
  const svg = s('svg', { role: 'img', viewBox: '0 0 640 320' });
  const caption = h('figcaption', { 'aria-live': 'polite' });
  const legend = h('ul', { class: 'lines' });
  const table = h('table', {});
  const bar = h('progress', { max: 1, value: 0, 'aria-label': t('waiting') });
  const more = h(
    'details',
    {},
    h('summary', {}, t('table')),
    h('div', { class: 'scroll', tabindex: 0, role: 'region', 'aria-label': t('table') }, table),
  );
  /** @type {Record<string, number>} */
  const values = Object.fromEntries(handles.map((handle) => [handle.id, handle.value]));
  /** @type {Record<string, { input: HTMLInputElement, output: HTMLOutputElement, handle: Handle }>} */
  const controls = {};
  const rows = handles.map((handle) => {
    const { min, max, step, value } = handle;
    const input = h('input', {
      type: 'range',
      min,
      max,
      step,
      value,
      name: `${id}.${handle.id}`,
      oninput: () => set(handle.id, input.valueAsNumber),
    });
    const output = h('output', {});
    controls[handle.id] = { input, output, handle };
    return h('label', { class: 'handle' }, h('span', {}, t(`${id}.${handle.id}`)), input, output);
  });
  const figure = h('figure', { 'data-figure': id }, svg, legend, ...rows, bar, caption, more);
  let isWanted = false;
  let isBusy = false;
  let isStale = false;

  function showValues() {
    for (const [name, { input, output, handle }] of Object.entries(controls)) {
      input.value = String(values[name]);
      const text = `${values[name]}${handle.unit}`;
      say(output, text);
      attribute(input, 'aria-valuetext', text);
    }
  }
  showValues();

  /** @param {string} name @param {number} value */
  function set(name, value) {
    const { min, max, step } = controls[name].handle;
    const held = Math.min(Math.max(Math.round(value / step) * step, min), max);
    values[name] = Number(held.toPrecision(8));
    showValues();
    draw();
  }

  async function draw() {
    if (!isWanted) return;
    // One at a time; whatever changed meanwhile is drawn once afterwards.
    if (isBusy) {
      isStale = true;
      return;
    }
    isBusy = true;
    attribute(figure, 'aria-busy', 'true');
    try {
      const told = await compute({ ...values }, svg, (fraction) => {
        bar.hidden = false;
        bar.value = fraction;
      });
      show(told);
    } catch (error) {
      if (!(error instanceof Cancelled))
        say(caption, t('failed', { message: String(/** @type {Error} */ (error).message) }));
    } finally {
      bar.hidden = true;
      isBusy = false;
      attribute(figure, 'aria-busy', null);
      if (isStale) {
        isStale = false;
        draw();
      }
    }
  }

  /** @param {Told} told */
  function show({ alt, caption: text, table: { head, rows: lines }, legend: names = [] }) {
    attribute(svg, 'aria-label', alt);
    say(caption, text);
    legend.replaceChildren(
      ...names.map(([name, label]) =>
        h(
          'li',
          {},
          s(
            'svg',
            { viewBox: '0 0 26 8', 'aria-hidden': 'true' },
            s('path', { class: `line ${name}`, d: 'M0 4h26' }),
          ),
          label,
        ),
      ),
    );
    table.replaceChildren(
      h('thead', {}, h('tr', {}, ...head.map((name) => h('th', { scope: 'col' }, name)))),
      h(
        'tbody',
        {},
        ...lines.map(([first, ...rest]) =>
          h(
            'tr',
            {},
            h('th', { scope: 'row' }, String(first)),
            ...rest.map((cell) => h('td', {}, String(cell))),
          ),
        ),
      ),
    );
    figure.dataset.drawn = '';
  }

  new IntersectionObserver(
    (entries, observer) => {
      if (!entries.some((entry) => entry.isIntersecting)) return;
      observer.disconnect();
      isWanted = true;
      draw();
    },
    { rootMargin: '300px' },
  ).observe(figure);

  return { figure, svg, set, values };
}

/**
 * Lets a pointer drag over a drawing.
 *
 * @param {SVGSVGElement} svg
 * @param {(x: number, y: number) => void} onDrag In units of the drawing.
 */
export function draggable(svg, onDrag) {
  svg.classList.add('draggable');
  const tell = (/** @type {PointerEvent} */ event) => {
    const { left, top, width } = svg.getBoundingClientRect();
    const scale = svg.viewBox.baseVal.width / width;
    onDrag((event.clientX - left) * scale, (event.clientY - top) * scale);
  };
  svg.addEventListener('pointerdown', (event) => {
    svg.setPointerCapture(event.pointerId);
    tell(event);
  });
  svg.addEventListener('pointermove', (event) => svg.hasPointerCapture(event.pointerId) && tell(event));
}
