/** A grid below the surface, for scale, with the three axes at its corner. */
import {
  Box3,
  BufferAttribute,
  BufferGeometry,
  Color,
  LineBasicMaterial,
  LineSegments,
  Vector3,
} from 'three';

/** At least as many squares along the longer side. */
const SQUARES = 8;

export function createGround() {
  const grid = new LineSegments(
    new BufferGeometry(),
    new LineBasicMaterial({ transparent: true, opacity: 0.5 }),
  );

  let z = 0;

  return {
    grid,

    /** Where the grid lies, millimetres along z. */
    height: () => z,

    /** Lays the grid under a box; returns the width of a square, millimetres. @param {Box3} box */
    set(box) {
      grid.geometry.dispose();
      grid.geometry = new BufferGeometry();
      if (box.isEmpty()) return 0;
      const size = box.getSize(new Vector3());
      const square = roundStep(Math.max(size.x, size.y, size.z) / SQUARES);
      z = box.min.z - Math.max(0.06 * Math.max(size.x, size.y), 0.2 * square);
      const [x0, x1] = [Math.floor(box.min.x / square) - 1, Math.ceil(box.max.x / square) + 1];
      const [y0, y1] = [Math.floor(box.min.y / square) - 1, Math.ceil(box.max.y / square) + 1];
      const lines = [];
      for (let i = x0; i <= x1; i += 1) lines.push(i * square, y0 * square, z, i * square, y1 * square, z);
      for (let j = y0; j <= y1; j += 1) lines.push(x0 * square, j * square, z, x1 * square, j * square, z);
      grid.geometry.setAttribute('position', new BufferAttribute(new Float32Array(lines), 3));
      return square;
    },

    /** @param {(name: string) => Color} color */
    theme(color) {
      grid.material.color.copy(color('--grid'));
    },
  };
}

/** The next of 1, 2, 5, 10, … at or above a length. @param {number} length */
function roundStep(length) {
  const power = 10 ** Math.floor(Math.log10(length || 1));
  return power * ([1, 2, 5, 10].find((step) => step * power >= length) ?? 10);
}
