/** The cutter where the path is shown up to. */
import { Color, LatheGeometry, Mesh, MeshPhongMaterial, Vector2, Vector3 } from 'three';
import { pairs } from './outline.js';

const SIDES = 48;
/** Lathes turn around y. */
const UP = new Vector3(0, 1, 0);

export function createCutterModel() {
  const material = new MeshPhongMaterial({
    specular: 0x333333,
    shininess: 20,
    transparent: true,
    opacity: 0.62,
  });
  const mesh = new Mesh(new LatheGeometry([], 3), material);
  mesh.visible = false;
  /** @type {Float32Array | null} */
  let shown = null;

  return {
    mesh,

    /** @param {Float32Array | null} outline */
    set(outline) {
      if (outline === shown) return;
      shown = outline;
      mesh.geometry.dispose();
      const points = outline ? pairs(outline) : [];
      const last = points[points.length - 1];
      const closed = last ? [...points, [0, last[1]]] : [];
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
      mesh.visible = visible && shown !== null;
    },

    /** @param {(name: string) => Color} color */
    theme(color) {
      material.color.copy(color('--cutter'));
    },
  };
}
