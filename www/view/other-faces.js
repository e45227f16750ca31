/**
 * The other faces of a file: faint, and chosen by a click.
 *
 * @import { Picture } from '../types.js'
 */
import {
  BufferAttribute,
  BufferGeometry,
  Color,
  DoubleSide,
  Group,
  Mesh,
  MeshLambertMaterial,
  Raycaster,
} from 'three';

export function createOtherFaces() {
  const material = new MeshLambertMaterial({
    side: DoubleSide,
    transparent: true,
    opacity: 0.35,
    depthWrite: false,
  });
  const group = new Group();
  /** @type {Map<number, Mesh>} */
  const meshes = new Map();
  /** @type {unknown} */
  let shown = null;

  /** @param {Picture} picture */
  function mesh({ positions, normals, indices }) {
    const geometry = new BufferGeometry();
    geometry.setAttribute('position', new BufferAttribute(positions, 3));
    geometry.setAttribute('normal', new BufferAttribute(normals, 3));
    geometry.setIndex(new BufferAttribute(indices, 1));
    return new Mesh(geometry, material);
  }

  return {
    group,

    /** @param {Map<number, Picture>} faces By index; the chosen one among them is not drawn. @param {number} chosen */
    set(faces, chosen) {
      if (shown !== faces) {
        for (const old of meshes.values()) old.geometry.dispose();
        meshes.clear();
        for (const [index, picture] of faces) meshes.set(index, mesh(picture));
        group.clear();
        for (const face of meshes.values()) group.add(face);
        shown = faces;
      }
      for (const [index, face] of meshes) face.visible = index !== chosen;
    },

    /**
     * The face that a ray meets first, unless `front`, the chosen one, lies before it.
     *
     * @param {Raycaster} ray
     * @param {Mesh} front
     * @returns {number | null}
     */
    pick(ray, front) {
      const seen = [front, ...meshes.values()].filter((face) => face.visible);
      const hit = ray.intersectObjects(seen, false)[0]?.object;
      const found = [...meshes].find(([, face]) => face === hit);
      return found ? found[0] : null;
    },

    /** @param {(name: string) => Color} color */
    theme(color) {
      material.color.copy(color('--surface-front'));
    },
  };
}
