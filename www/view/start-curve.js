/** The points of a start curve as they were given, with straight lines between them. */
import {
  BufferGeometry,
  Float32BufferAttribute,
  Group,
  Line,
  LineBasicMaterial,
  Points,
  PointsMaterial,
} from 'three';

/** Pixels. */
const DOT = 7;

export function createStartCurve() {
  // Drawn over what it lies in.
  const over = { depthTest: false, transparent: true };
  const line = new Line(new BufferGeometry(), new LineBasicMaterial(over));
  const dots = new Points(line.geometry, new PointsMaterial({ size: DOT, sizeAttenuation: false, ...over }));
  const group = new Group();
  group.add(line, dots);
  group.renderOrder = 1;
  /** @type {any} */
  let shown = null;

  return {
    group,

    /** @param {import('../types.js').Spec | undefined} spec */
    set(spec) {
      const points = spec?.strategy.start === 'curve' ? spec.strategy.start_points_mm : null;
      if (points === shown) return;
      shown = points;
      const whole = (points ?? []).filter(
        (/** @type {number[]} */ p) => p.length === 3 && p.every(Number.isFinite),
      );
      line.geometry.dispose();
      line.geometry = new BufferGeometry().setAttribute(
        'position',
        new Float32BufferAttribute(whole.flat(), 3),
      );
      dots.geometry = line.geometry;
    },

    /** @param {(name: string) => import('three').Color} color */
    theme(color) {
      line.material.color.copy(color('--accent'));
      dots.material.color.copy(color('--accent'));
    },
  };
}
