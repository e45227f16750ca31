/**
 * The domain of the parameters: passes as they run in it, and the direction and width of the widest strip at places of it.
 *
 * @import { State, Outcome } from '../types.js'
 */
import { length, plain } from '../format.js';
import { t } from '../text/index.js';
import { css, sequentialColor } from './colors.js';
import { attribute, h, s } from './dom.js';
import { KIND, lastCut, locate, STRIDE } from './way.js';

/** The drawing's own size; the browser fits it to the room there is. */
const SIZE = 1000;
const MARGIN = 84;
/** Points nearer to one another than this are one, in units of the drawing. */
const APART = 0.8;
/** Longest half arrow as a share of the distance of places. */
const REACH = 0.42;

/** @param {HTMLElement} root */
export function createDomain(root) {
  const svg = s('svg', { viewBox: `0 0 ${SIZE} ${SIZE}`, role: 'img' });
  const note = h('p', { class: 'help' });
  root.append(svg, note);
  /** @type {unknown[]} */
  let shown = [];
  const cutter = s('circle', { class: 'cutter', r: 9 });
  const place = s('path', { class: 'picked' });
  /** @type {((u: number, v: number) => [number, number]) | null} */
  let project = null;

  /** @param {NonNullable<State['domain']>} domain @param {Outcome} outcome */
  function draw({ uv, potential, ends: [u0, u1, v0, v1] }, outcome) {
    const room = SIZE - 2 * MARGIN;
    const at = (/** @type {number} */ u, /** @type {number} */ v) =>
      /** @type {[number, number]} */ ([
        MARGIN + ((u - u0) / (u1 - u0)) * room,
        SIZE - MARGIN - ((v - v0) / (v1 - v0)) * room,
      ]);
    project = at;
    const arrows = [];
    const widths = [];
    for (let i = 0; i < potential.length; i += 6) widths.push(potential[i + 4]);
    const [low, high] = [Math.min(...widths), Math.max(...widths)];
    const cell = room / Math.max(Math.sqrt(widths.length) - 1, 1);
    for (let i = 0; i < potential.length; i += 6) {
      const [u, v, du, dv, width] = potential.subarray(i, i + 5);
      const [x, y] = at(u, v);
      const [dx, dy] = [(du / (u1 - u0)) * room, (-dv / (v1 - v0)) * room];
      const size = (REACH * cell) / (Math.hypot(dx, dy) || 1);
      const share = high > low ? (2 * (width - low)) / (high - low) - 1 : 0;
      const line = `M${fix(x - dx * size)} ${fix(y - dy * size)}L${fix(x + dx * size)} ${fix(y + dy * size)}`;
      arrows.push(s('path', { class: 'widest', d: line, stroke: css(sequentialColor(share)) }));
    }
    const ticks = [0, 0.25, 0.5, 0.75, 1];
    const number = (/** @type {number} */ x) => plain(Number(x.toPrecision(3)));
    svg.replaceChildren(
      s('rect', { class: 'ground', x: MARGIN, y: MARGIN, width: room, height: room }),
      ...arrows,
      s('path', { class: 'passes', d: passes(uv, outcome, at) }),
      ...ticks.flatMap((share) => {
        const [x, y] = at(u0 + (u1 - u0) * share, v0 + (v1 - v0) * share);
        return [
          s('text', { x, y: SIZE - MARGIN + 44, 'text-anchor': 'middle' }, number(u0 + (u1 - u0) * share)),
          s('text', { x: MARGIN - 30, y: y + 6, 'text-anchor': 'end' }, number(v0 + (v1 - v0) * share)),
        ];
      }),
      s('text', { class: 'name', x: SIZE - MARGIN, y: SIZE - 12, 'text-anchor': 'end' }, 'u'),
      s('text', { class: 'name', x: 14, y: MARGIN - 18 }, 'v'),
      place,
      cutter,
    );
    note.textContent = t('domain.note', { least: length(low), most: length(high) });
    attribute(svg, 'aria-label', `${t('domain.label')} ${note.textContent}`);
  }

  return {
    /** @param {State} state */
    update({ isFlat, domain, outcome, at, picked }) {
      root.hidden = !isFlat;
      root.parentElement?.classList.toggle('flat', isFlat);
      if (!isFlat) return;
      if (shown[0] !== domain || shown[1] !== outcome?.contacts) {
        shown = [domain, outcome?.contacts];
        if (domain && outcome) draw(domain, outcome);
        else {
          svg.replaceChildren();
          project = null;
          note.textContent = t(outcome ? 'domain.waiting' : 'domain.empty');
        }
      }
      if (!domain || !outcome || !project) return;
      const point = Math.min(
        locate(outcome.path, at >= 1 ? lastCut(outcome.path) : at).point,
        domain.uv.length / 2 - 1,
      );
      const [x, y] = project(domain.uv[2 * point], domain.uv[2 * point + 1]);
      attribute(cutter, 'cx', fix(x));
      attribute(cutter, 'cy', fix(y));
      const [px, py] = picked && !Number.isNaN(picked.u) ? project(picked.u, picked.v) : [0, 0];
      attribute(place, 'd', px ? `M${fix(px - 12)} ${fix(py)}h24M${fix(px)} ${fix(py - 12)}v24` : null);
    },

    /** The drawing as a file of its own; nothing while there is none. */
    drawing() {
      if (!project) return null;
      const copy = /** @type {SVGElement} */ (svg.cloneNode(true));
      copy.setAttribute('xmlns', 'http://www.w3.org/2000/svg');
      copy.setAttribute('fill', 'none');
      for (const [part, settings] of Object.entries(INK)) {
        for (const found of copy.querySelectorAll(part)) {
          for (const [name, value] of Object.entries(settings)) found.setAttribute(name, value);
        }
      }
      return new XMLSerializer().serializeToString(copy);
    },
  };
}

/** What the page's styles say, for paper. @type {Record<string, Record<string, string>>} */
const INK = {
  '.ground': { stroke: '#59646e', 'stroke-width': '1' },
  '.passes': { stroke: '#04665a', 'stroke-width': '1.2' },
  '.widest': { 'stroke-width': '4' },
  '.cutter': { stroke: '#171c21', 'stroke-width': '2' },
  text: { fill: '#171c21', 'font-size': '20', 'font-family': 'sans-serif' },
};

/** @param {Float32Array} uv @param {Outcome} outcome @param {(u: number, v: number) => [number, number]} at */
function passes(uv, { path }, at) {
  let d = '';
  let isDown = false;
  let [lastX, lastY] = [NaN, NaN];
  for (let i = 1; i < uv.length / 2; i += 1) {
    const isCut = path[i * STRIDE + KIND] === 0;
    if (!isCut) {
      isDown = false;
      continue;
    }
    if (!isDown) {
      [lastX, lastY] = at(uv[2 * i - 2], uv[2 * i - 1]);
      d += `M${fix(lastX)} ${fix(lastY)}`;
      isDown = true;
    }
    const [x, y] = at(uv[2 * i], uv[2 * i + 1]);
    // Across the seam of what closes, or no further than a line is wide.
    const far = Math.hypot(x - lastX, y - lastY);
    const isEnd = path[(i + 1) * STRIDE + KIND] !== 0;
    if (far < APART && !isEnd) continue;
    d += `${far > SIZE / 2 ? 'M' : 'L'}${fix(x)} ${fix(y)}`;
    [lastX, lastY] = [x, y];
  }
  return d;
}

/** @param {number} x */
const fix = (x) => String(Number(x.toFixed(1)));
