/**
 * The path: passes, links at feed and rapids, each one buffer however long the path is.
 *
 * @import { Outcome } from '../types.js'
 */
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  Group,
  LineBasicMaterial,
  LineDashedMaterial,
  LineSegments,
} from 'three';

/** Numbers a point of `path`; the kind of the move that ends there, and the length so far. */
export const STRIDE = 8;
const KIND = 6;
const LENGTH = 7;

/** A dash and its gap as shares of the picture's size. */
const DASH = 0.012;

/** While the picture moves, passes of more segments than this are drawn with fewer: a processor draws these 25 times a second. */
const MOVING_SEGMENTS = 50_000;

/**
 * @typedef {{ ends: Uint32Array, index: BufferAttribute }} Segments
 * The points at which segments end, ascending, and their two points each.
 */

export function createPathLines() {
  const cut = new LineSegments(new BufferGeometry(), nearer(new LineBasicMaterial({ transparent: true })));
  // What is still to come when the path is shown up to a position only.
  const ahead = new LineSegments(
    new BufferGeometry(),
    nearer(new LineBasicMaterial({ transparent: true, opacity: 0.16, depthWrite: false })),
  );
  const link = new LineSegments(
    new BufferGeometry(),
    new LineBasicMaterial({ transparent: true, opacity: 0.7 }),
  );
  const rapid = new LineSegments(
    new BufferGeometry(),
    new LineDashedMaterial({ transparent: true, opacity: 0.55 }),
  );
  const group = new Group();
  group.add(ahead, cut, link, rapid);
  /** @type {Outcome | null} */
  let shown = null;
  /** Per kind: every segment, and as many as are drawn in motion. @type {{ all: Segments, few: Segments }[]} */
  let kinds = [];
  let isMoving = false;
  /** The point up to which the path is shown. */
  let reached = Infinity;
  const plain = new Color();
  /** On the colours of excess, which are light, the passes are dark. */
  const dark = new Color();
  let isOver = false;

  function apply() {
    if (kinds.length === 0) return;
    [cut, link, rapid].forEach((line, kind) => {
      const { ends, index } = isMoving ? kinds[kind].few : kinds[kind].all;
      line.geometry.setIndex(index);
      line.geometry.setDrawRange(0, 2 * countUpTo(ends, reached));
    });
    ahead.geometry.setIndex(cut.geometry.index);
    ahead.geometry.setDrawRange(cut.geometry.drawRange.count, Infinity);
    ahead.visible = cut.visible && reached !== Infinity;
  }

  return {
    group,

    /** @param {Outcome | null} outcome @param {number} size Of the picture, millimetres. */
    set(outcome, size) {
      if (outcome === shown) return;
      shown = outcome;
      for (const line of [cut, ahead, link, rapid]) {
        line.geometry.dispose();
        line.geometry = new BufferGeometry();
      }
      kinds = [];
      if (!outcome) return;
      const { path, contacts } = outcome;
      const points = path.length / STRIDE;
      const position = new BufferAttribute(contacts, 3);
      kinds = segmentEnds(path, points).map((ends) => {
        const all = segments(ends, 1);
        const step = Math.ceil(ends.length / MOVING_SEGMENTS);
        return { all, few: step > 1 ? segments(ends, step) : all };
      });
      for (const line of [cut, link, rapid, ahead]) line.geometry.setAttribute('position', position);
      apply();
      const lengths = new Float32Array(points);
      for (let i = 0; i < points; i += 1) lengths[i] = path[i * STRIDE + LENGTH];
      rapid.geometry.setAttribute('lineDistance', new BufferAttribute(lengths, 1));
      rapid.material.dashSize = size * DASH;
      rapid.material.gapSize = size * DASH;
    },

    /** Shows the path up to a point, and the rest faintly. @param {number} point Index, `Infinity` for all. */
    upTo(point) {
      reached = point;
      apply();
    },

    /** Whether the picture is moving; returns whether that makes a difference. @param {boolean} moves */
    move(moves) {
      if (isMoving === moves) return false;
      isMoving = moves;
      apply();
      return kinds.some(({ all, few }) => all !== few);
    },

    /** @param {{ passes: boolean, links: boolean, rapids: boolean }} layers @param {boolean} overColours Whether the surface is coloured. */
    show({ passes, links, rapids }, overColours) {
      cut.visible = passes;
      ahead.visible = passes && reached !== Infinity;
      link.visible = links;
      rapid.visible = rapids;
      isOver = overColours;
      cut.material.color.copy(isOver ? dark : plain);
      ahead.material.color.copy(cut.material.color);
      cut.material.opacity = isOver ? 0.55 : 0.95;
    },

    /** @param {(name: string) => Color} color */
    theme(color) {
      plain.copy(color('--path-cut'));
      dark.copy(color('--path-over'));
      cut.material.color.copy(isOver ? dark : plain);
      ahead.material.color.copy(cut.material.color);
      link.material.color.copy(color('--path-link'));
      rapid.material.color.copy(color('--path-rapid'));
    },
  };
}

/**
 * Draws a little nearer to the eye, so that contact points are not hidden by the triangles that stand for the surface.
 *
 * @template {import('three').Material} M
 * @param {M} material
 */
function nearer(material) {
  material.onBeforeCompile = (shader) => {
    shader.vertexShader = shader.vertexShader.replace(
      '#include <project_vertex>',
      '#include <project_vertex>\ngl_Position.z -= 0.0006 * gl_Position.w;',
    );
  };
  return material;
}

/** For each kind the points at which its segments end, ascending. @param {Float32Array} path @param {number} points */
function segmentEnds(path, points) {
  const counts = [0, 0, 0];
  for (let i = 1; i < points; i += 1) counts[path[i * STRIDE + KIND]] += 1;
  const lists = counts.map((n) => new Uint32Array(n));
  counts.fill(0);
  for (let i = 1; i < points; i += 1) {
    const kind = path[i * STRIDE + KIND];
    lists[kind][counts[kind]] = i;
    counts[kind] += 1;
  }
  return lists;
}

/**
 * Segments that end at points, each from the point before; up to `step` of them that follow one another are one.
 *
 * @param {Uint32Array} ends Ascending.
 * @param {number} step
 * @returns {Segments}
 */
function segments(ends, step) {
  const index = new Uint32Array(2 * ends.length);
  const kept = new Uint32Array(ends.length);
  let count = 0;
  for (let i = 0; i < ends.length; ) {
    const from = i;
    while (i - from < step - 1 && ends[i + 1] === ends[i] + 1) i += 1;
    index[2 * count] = ends[from] - 1;
    index[2 * count + 1] = ends[i];
    kept[count] = ends[i];
    count += 1;
    i += 1;
  }
  return { ends: kept.slice(0, count), index: new BufferAttribute(index.slice(0, 2 * count), 1) };
}

/** How many of an ascending list are at most `point`. @param {Uint32Array} list @param {number} point */
function countUpTo(list, point) {
  let low = 0;
  let high = list.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (list[middle] <= point) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** The share of the path at which the last pass ends. @param {Float32Array} path */
export function lastCut(path) {
  let point = path.length / STRIDE - 1;
  const all = path[point * STRIDE + LENGTH];
  while (point > 0 && path[point * STRIDE + KIND] !== 0) point -= 1;
  return all > 0 ? path[point * STRIDE + LENGTH] / all : 1;
}

/** The share of the path that is done at a place: the move before it and how much of the next. @param {Float32Array} path @param {number} place */
export function shareAt(path, place) {
  const last = path.length / STRIDE - 1;
  const move = Math.min(Math.floor(place), last);
  const from = path[move * STRIDE + LENGTH];
  const to = path[Math.min(move + 1, last) * STRIDE + LENGTH];
  const all = path[last * STRIDE + LENGTH];
  return all > 0 ? (from + (to - from) * (place - move)) / all : 1;
}

/**
 * Where the cutter is after a share of the path: the point reached last, and tip and axis between it and the next.
 *
 * @param {Float32Array} path
 * @param {number} at From 0 to 1.
 */
export function locate(path, at) {
  const points = path.length / STRIDE;
  const wanted = at * path[(points - 1) * STRIDE + LENGTH];
  let low = 0;
  let high = points - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (path[middle * STRIDE + LENGTH] <= wanted) low = middle;
    else high = middle - 1;
  }
  const next = Math.min(low + 1, points - 1);
  const from = path[low * STRIDE + LENGTH];
  const span = path[next * STRIDE + LENGTH] - from;
  const share = span > 0 ? (wanted - from) / span : 0;
  const mix = (/** @type {number} */ k) =>
    path[low * STRIDE + k] + (path[next * STRIDE + k] - path[low * STRIDE + k]) * share;
  return { point: at >= 1 ? points : low, tip: [mix(0), mix(1), mix(2)], axis: [mix(3), mix(4), mix(5)] };
}
