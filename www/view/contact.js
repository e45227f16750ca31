/**
 * What the cutter does where it stands: how it leans and why, how wide its strip is, and how these go along the pass.
 *
 * @import { State, Outcome } from '../types.js'
 */
import { degrees, length } from '../format.js';
import { t } from '../text/index.js';
import { COLUMNS, hasPostures, POSTURE, passAt } from './along-path.js';
import { attribute, h, s, say } from './dom.js';
import { LENGTH, lastCut, locate, STRIDE } from './way.js';

/** In the order of their numbers. */
const BOUNDS = ['given', 'least', 'curvature', 'beside', 'body', 'holder', 'turn', 'misfit', 'met'];
const WIDTH = 280;
const HEIGHT = 34;
/** A plot reaches over no less than this, so that what hardly changes looks so. */
const LEAST_SPAN = { lead: 1, yaw: 1, strip: 0.1 };

/** @param {HTMLElement} root */
export function createContact(root) {
  const rows = /** @type {(keyof typeof COLUMNS)[]} */ (['lead', 'yaw', 'strip']).map((name) => {
    const value = h('dd', {});
    const line = s('path', { class: 'line' });
    const mark = s('path', { class: 'at' });
    const plot = s(
      'svg',
      { viewBox: `0 0 ${WIDTH} ${HEIGHT}`, preserveAspectRatio: 'none', role: 'img' },
      mark,
      line,
    );
    const ends = h('p', { class: 'ends' });
    return {
      name,
      value,
      line,
      mark,
      plot,
      ends,
      term: h('div', { 'data-figure': name }, h('dt', {}, t(`contact.${name}`)), value),
    };
  });
  const why = h('p', { class: 'why' });
  root.append(
    h('summary', {}, h('h2', {}, t('contact.title'))),
    h('p', { class: 'help' }, t('contact.hint')),
    ...rows.map(({ term, plot, ends }) => h('figure', {}, h('dl', {}, term), plot, ends)),
    why,
  );
  /** @type {Outcome | null} */
  let shown = null;
  let isTold = false;
  let drawn = { first: -1, last: -1 };

  return {
    /** @param {State} state */
    update({ outcome, at }) {
      if (outcome !== shown) {
        // The proof adds nothing to postures.
        if (outcome?.postures !== shown?.postures) {
          drawn = { first: -1, last: -1 };
          isTold = hasPostures(outcome);
        }
        shown = outcome;
      }
      root.hidden = !isTold;
      if (!outcome || !isTold) return;
      const place = at >= 1 ? lastCut(outcome.path) : at;
      const move = Math.min(locate(outcome.path, place).point, outcome.path.length / STRIDE - 1);
      const pass = passAt(outcome, move);
      if (pass.first !== drawn.first || pass.last !== drawn.last) {
        drawn = pass;
        for (const row of rows) draw(outcome, pass, row);
      }
      const here = Math.min(Math.max(move, pass.first), pass.last);
      const x = (WIDTH * placeOn(outcome, pass, here)).toFixed(1);
      for (const { name, value, mark } of rows) {
        say(value, shownAs(name, known(outcome, pass, here, COLUMNS[name])));
        attribute(mark, 'd', `M${x} 0V${HEIGHT}`);
      }
      const bound = BOUNDS[outcome.postures[here * POSTURE + 3]];
      say(why, bound ? t(`bound.${bound}`) : '');
    },
  };
}

/** How far along its pass a move ends, 0 to 1. @param {Outcome} outcome @param {{ first: number, last: number }} pass @param {number} move */
function placeOn({ path }, { first, last }, move) {
  const [from, to] = [first, last].map((i) => path[i * STRIDE + LENGTH]);
  return to > from ? (path[move * STRIDE + LENGTH] - from) / (to - from) : 0;
}

/**
 * The number of a column at a move, or the nearest of its pass where that is none: as the cutter runs out over a border.
 *
 * @param {Outcome} outcome
 * @param {{ first: number, last: number }} pass
 * @param {number} move
 * @param {number} column
 */
function known({ postures }, { first, last }, move, column) {
  for (let off = 0; off <= last - first; off += 1) {
    for (const i of [move - off, move + off]) {
      if (i >= first && i <= last && !Number.isNaN(postures[i * POSTURE + column])) {
        return postures[i * POSTURE + column];
      }
    }
  }
  return Number.NaN;
}

/** @param {keyof typeof COLUMNS} name @param {number} value */
function shownAs(name, value) {
  if (Number.isNaN(value)) return '–';
  return name === 'strip' ? length(value) : degrees(value);
}

/**
 * @param {Outcome} outcome
 * @param {{ first: number, last: number }} pass
 * @param {{ name: keyof typeof COLUMNS, line: SVGElement, plot: SVGElement, ends: HTMLElement }} row
 */
function draw(outcome, pass, { name, line, plot, ends }) {
  /** @type {[number, number][]} */
  const points = [];
  for (let i = pass.first; i <= pass.last; i += 1) {
    const value = outcome.postures[i * POSTURE + COLUMNS[name]];
    if (!Number.isNaN(value)) points.push([placeOn(outcome, pass, i), value]);
  }
  const values = points.map(([, value]) => value);
  const [least, most] = [Math.min(...values), Math.max(...values)];
  const spare = Math.max(0, LEAST_SPAN[name] - (most - least)) / 2;
  const [low, high] = [least - spare, most + spare];
  const y = (/** @type {number} */ value) => HEIGHT - 3 - ((value - low) / (high - low)) * (HEIGHT - 6);
  const d = points.map(
    ([x, value], i) => `${i === 0 ? 'M' : 'L'}${(WIDTH * x).toFixed(1)} ${y(value).toFixed(1)}`,
  );
  attribute(line, 'd', d.join('') || null);
  const span =
    points.length === 0 ? '' : t('contact.span', { least: shownAs(name, least), most: shownAs(name, most) });
  say(ends, span);
  attribute(plot, 'aria-label', `${t(`contact.${name}`)}: ${span}`);
}
