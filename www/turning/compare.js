/**
 * The paper's comparisons: circles against the spiral, equal angles against equal arcs.
 *
 * @import { State, Compared } from './types.js'
 * @import { Schema } from '../types.js'
 */
import { minutes, plain } from '../format.js';
import { withVariant, write } from '../spec.js';
import { attribute, h } from '../view/dom.js';
import { t } from './text.js';

const SWITCHES = /** @type {const} */ ({ guide: ['spiral', 'circles'], points: ['angle', 'arc'] });

/**
 * The specification with this guide curve and these points. Points of equal arcs are gone through in equal times, as the
 * paper has it: the surface then runs evenly under the tool, and C does not.
 *
 * @param {Schema} schema
 * @param {any} spec
 * @param {string} guide
 * @param {string} points
 */
export function variants(schema, spec, guide, points) {
  const group = (/** @type {string} */ path) => schema.groups.find((g) => g.path === path);
  const [curve, spacing] = [group('guide'), group('points')];
  if (curve) spec = withVariant(spec, curve, guide);
  if (spacing) spec = withVariant(spec, spacing, points);
  return write(spec, 'speed.pace', points === 'arc' ? 'surface_speed' : 'c_speed');
}

/**
 * @param {HTMLElement} root
 * @param {{ onChoose: (guide: string, points: string) => void, onRun: () => void }} callbacks
 */
export function createCompare(root, { onChoose, onRun }) {
  let now = { guide: 'spiral', points: 'angle' };
  /** @type {Map<string, HTMLButtonElement>} */
  const buttons = new Map();
  const choices = Object.entries(SWITCHES).map(([name, options]) =>
    h(
      'div',
      { class: 'switch', role: 'group', 'data-switch': name, 'aria-label': t(`compare.${name}`) },
      ...options.map((option) => {
        const button = h(
          'button',
          {
            type: 'button',
            class: 'small',
            'data-choose': option,
            onclick: () => {
              const next = { ...now, [name]: option };
              onChoose(next.guide, next.points);
            },
          },
          t(`compare.${name}.${option}`),
        );
        buttons.set(`${name}.${option}`, button);
        return button;
      }),
    ),
  );
  const run = h(
    'button',
    { type: 'button', class: 'small', name: 'compare', onclick: onRun },
    t('compare.run'),
  );
  const columns = ['way', 'residue', 'x', 'c', 'time'];
  const head = h('tr', {}, ...columns.map((id) => h('th', { scope: 'col' }, t(`compare.column.${id}`))));
  const body = h('tbody', {});
  const table = h('table', {}, h('caption', {}, t('compare.caption')), h('thead', {}, head), body);
  root.append(
    h('h2', {}, t('compare.title')),
    ...choices,
    run,
    h('div', { class: 'wide' }, table),
    h('p', { class: 'help' }, t('compare.about')),
  );
  /** @type {unknown} */
  let shown = null;

  return {
    /** @param {State} state */
    update({ draft: spec, compared, job }) {
      if (!spec) return;
      now = { guide: spec.guide.kind, points: spec.points.kind };
      for (const [key, button] of buttons) {
        const [name, option] = key.split('.');
        attribute(button, 'aria-pressed', String(now[/** @type {'guide'} */ (name)] === option));
      }
      run.disabled = job !== null;
      table.hidden = compared.length === 0;
      if (shown === compared) return;
      shown = compared;
      body.replaceChildren(...compared.map(line));
    },
  };
}

/** @param {Compared} compared */
function line({ guide, points, report }) {
  const um = (/** @type {number | undefined} */ mm) => (mm === undefined ? '–' : plain(round(mm * 1000)));
  const { verified } = report;
  const cells = [
    `${um(verified?.overcut?.mm)} … ${um(verified?.residue?.mm)}`,
    plain(round(report.x.acceleration.value)),
    plain(round(report.c.acceleration.value)),
    minutes(report.time_s / 60),
  ];
  const way = `${t(`compare.guide.${guide}`)}, ${t(`compare.points.${points}`).toLowerCase()}`;
  return h(
    'tr',
    { 'data-row': `${guide}-${points}` },
    h('th', { scope: 'row' }, way),
    ...cells.map((cell) => h('td', {}, cell)),
  );
}

/** Three digits. @param {number} value */
const round = (value) => Number(value.toPrecision(3));
