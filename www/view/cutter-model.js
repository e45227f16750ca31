/** The cutter where the path is shown up to. */
import { Color, LatheGeometry, Mesh, MeshStandardMaterial, Vector2, Vector3 } from 'three';
import { outline } from './outline.js';

const SIDES = 48;
/** Lathes turn around y. */
const UP = new Vector3(0, 1, 0);

export function createCutterModel() {
  const material = new MeshStandardMaterial({
    roughness: 0.35,
    metalness: 0.3,
    transparent: true,
    opacity: 0.62,
  });
  const mesh = new Mesh(new LatheGeometry([], 3), material);
  let shown = '';
  let possible = false;

  return {
    mesh,

    /** @param {any} cutter */
    set(cutter) {
      const key = JSON.stringify(cutter ?? null);
      if (key === shown) return;
      shown = key;
      const points = outline(cutter);
      possible = points !== null;
      mesh.geometry.dispose();
      const closed = points ? [...points, [0, points[points.length - 1][1]]] : [];
      mesh.geometry = new LatheGeometry(
        closed.map(([radius, z]) => new Vector2(radius, z)),
        SIDES,
      );
    },

    /** @param {number[]} tip @param {number[]} axis */
    place(tip, axis) {
      mesh.position.fromArray(tip);
      mesh.quaternion.setFromUnitVectors(UP, new Vector3().fromArray(axis).normalize());
    },

    /** @param {boolean} visible */
    show(visible) {
      mesh.visible = visible && possible;
    },

    /** @param {(name: string) => Color} color */
    theme(color) {
      material.color.copy(color('--cutter'));
    },
  };
}
