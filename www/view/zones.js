/** Where the cutter cannot reach: one cube a cell. */
import { BoxGeometry, Color, InstancedMesh, Matrix4, MeshLambertMaterial } from 'three';

export function createZones() {
  const material = new MeshLambertMaterial({ transparent: true, opacity: 0.5 });
  let cubes = new InstancedMesh(new BoxGeometry(1, 1, 1), material, 0);
  /** @type {Float32Array | null} */
  let shown = null;
  const root = { cubes };

  return {
    root,

    /**
     * @param {Float32Array | null} centres
     * @param {number} edge Millimetres.
     * @param {(before: InstancedMesh, after: InstancedMesh) => void} replace
     */
    set(centres, edge, replace) {
      if (centres === shown) return;
      shown = centres;
      const count = (centres?.length ?? 0) / 3;
      const next = new InstancedMesh(cubes.geometry, material, count);
      const matrix = new Matrix4();
      for (let i = 0; i < count; i += 1) {
        matrix.makeScale(edge, edge, edge).setPosition(...xyz(/** @type {Float32Array} */ (centres), i));
        next.setMatrixAt(i, matrix);
      }
      replace(cubes, next);
      cubes.dispose();
      cubes = next;
      root.cubes = next;
    },

    /** @param {(name: string) => Color} color */
    theme(color) {
      material.color.copy(color('--zone'));
    },
  };
}

/** @param {Float32Array} list @param {number} i @returns {[number, number, number]} */
function xyz(list, i) {
  return [list[3 * i], list[3 * i + 1], list[3 * i + 2]];
}
