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
import { KIND, LENGTH, STRIDE } from './way.js';

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
export function nearer(material) {
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
