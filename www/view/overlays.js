/**
 * Passes of other runs over the picture, each in a colour of its own.
 *
 * @import { Run } from '../types.js'
 */
import { BufferAttribute, BufferGeometry, Color, Group, LineBasicMaterial, LineSegments } from 'three';
import { OVERLAYS } from './colors.js';
import { nearer } from './path-lines.js';
import { KIND, STRIDE } from './way.js';

export function createOverlays() {
  const group = new Group();
  /** @type {Map<number, LineSegments>} */
  let lines = new Map();

  return {
    group,

    /** @param {Run[]} laid In the order in which colours are given. */
    set(laid) {
      const kept = new Map(laid.map((run) => [run.id, lines.get(run.id) ?? passesOf(run)]));
      for (const [id, line] of lines) if (!kept.has(id)) line.geometry.dispose();
      lines = kept;
      group.clear();
      [...lines.values()].forEach((line, i) => {
        /** @type {LineBasicMaterial} */ (line.material).color.copy(new Color(OVERLAYS[i % OVERLAYS.length]));
        group.add(line);
      });
    },
  };
}

/** @param {Run} run */
function passesOf({ contacts, path }) {
  const index = [];
  for (let i = 1; i < contacts.length / 3; i += 1) if (path[i * STRIDE + KIND] === 0) index.push(i - 1, i);
  const geometry = new BufferGeometry().setAttribute('position', new BufferAttribute(contacts, 3));
  geometry.setIndex(new BufferAttribute(new Uint32Array(index), 1));
  return new LineSegments(geometry, nearer(new LineBasicMaterial()));
}
