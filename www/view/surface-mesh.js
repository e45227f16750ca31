/**
 * The surface: shaded, tinted where it is seen from the side that is not cut, coloured by numbers, with arrows on
 * the side that is cut.
 *
 * @import { Picture, Tint } from '../types.js'
 */
import {
  Box3,
  BufferAttribute,
  BufferGeometry,
  Color,
  DoubleSide,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshPhongMaterial,
  Vector3,
} from 'three';
import { UNKNOWN } from './colors.js';

/** Cells across the picture, an arrow in each, and an arrow's length, as shares of the picture's size. */
const CELLS = 11;
const ARROW = 0.035;

export function createSurfaceMesh() {
  const back = { value: new Color() };
  const material = new MeshPhongMaterial({
    side: DoubleSide,
    specular: 0x1c1c1c,
    shininess: 24,
    // Lines that lie on the surface are drawn in front of it.
    polygonOffset: true,
    polygonOffsetFactor: 1.5,
    polygonOffsetUnits: 2,
  });
  // Which side is seen is told by the normals, not by the triangles' order, which files get wrong.
  material.onBeforeCompile = (shader) => {
    shader.uniforms.backColor = back;
    shader.fragmentShader = shader.fragmentShader
      .replace('#include <common>', '#include <common>\nuniform vec3 backColor;')
      .replace(
        '#include <normal_fragment_begin>',
        `vec3 normal = normalize(vNormal);
        vec3 toEye = isOrthographic ? vec3(0.0, 0.0, 1.0) : vViewPosition;
        if (dot(normal, toEye) < 0.0) {
          normal = -normal;
          diffuseColor.rgb = mix(diffuseColor.rgb, backColor, 0.75);
        }
        vec3 nonPerturbedNormal = normal;`,
      );
  };
  const mesh = new Mesh(new BufferGeometry(), material);
  const arrows = new LineSegments(new BufferGeometry(), new LineBasicMaterial());
  mesh.visible = false;
  const group = new Group();
  group.add(mesh, arrows);
  /** @type {Picture | null} */
  let shown = null;
  /** @type {Tint | null} */
  let painted = null;
  const plain = new Color();
  const box = new Box3();

  return {
    group,
    mesh,
    box,

    /** @param {Picture | null} picture Whether it is another one. */
    set(picture) {
      if (picture === shown) return false;
      shown = picture;
      mesh.geometry.dispose();
      arrows.geometry.dispose();
      mesh.geometry = new BufferGeometry();
      arrows.geometry = new BufferGeometry();
      box.makeEmpty();
      // Without normals there is nothing to shade.
      mesh.visible = picture !== null;
      if (!picture) return true;
      mesh.geometry.setAttribute('position', new BufferAttribute(picture.positions, 3));
      mesh.geometry.setAttribute('normal', new BufferAttribute(picture.normals, 3));
      mesh.geometry.setIndex(new BufferAttribute(picture.indices, 1));
      mesh.geometry.computeBoundingBox();
      box.copy(mesh.geometry.boundingBox ?? box);
      arrows.geometry.setAttribute('position', new BufferAttribute(arrowLines(picture, box), 3));
      return true;
    },

    /**
     * Colours by `tint`, or plainly with `null`.
     *
     * @param {Tint | null} tint
     */
    paint(tint) {
      const coloured =
        tint !== null &&
        tint.values.length > 0 &&
        shown !== null &&
        tint.values.length * 3 === shown.positions.length;
      painted = coloured ? tint : null;
      if (coloured) {
        const colors = new Uint8Array(tint.values.length * 3);
        paintVertices(tint, colors, tint.values.keys());
        mesh.geometry.setAttribute('color', new BufferAttribute(colors, 3, true));
      } else {
        mesh.geometry.deleteAttribute('color');
      }
      if (material.vertexColors !== coloured) material.needsUpdate = true;
      material.vertexColors = coloured;
      material.color.copy(coloured ? new Color(1, 1, 1) : plain);
    },

    /** Colours again what changed among the values of the tint. @param {Iterable<number>} vertices */
    repaint(vertices) {
      const colors = mesh.geometry.getAttribute('color');
      if (!painted || !colors) return;
      paintVertices(painted, /** @type {Uint8Array} */ (colors.array), vertices);
      colors.needsUpdate = true;
    },

    /** @param {boolean} visible */
    showArrows(visible) {
      arrows.visible = visible;
    },

    /** @param {(name: string) => Color} color */
    theme(color) {
      plain.copy(color('--surface-front'));
      if (!material.vertexColors) material.color.copy(plain);
      back.value.copy(color('--surface-back'));
      arrows.material.color.copy(color('--surface-arrow'));
    },
  };
}

/** The renderer takes vertex colours as linear light. */
const LINEAR = Array.from({ length: 256 }, (_, i) =>
  Math.round(new Color().setRGB(i / 255, 0, 0, 'srgb').r * 255),
);

/** @param {Tint} tint @param {Uint8Array} colors @param {Iterable<number>} vertices */
function paintVertices({ values, low, high, color: colorOf }, colors, vertices) {
  // Numbers that are all the same have the colour of the middle.
  const [middle, half] = [0.5 * (low + high), 0.5 * (high - low) || 1];
  for (const i of vertices) {
    const color = Number.isNaN(values[i]) ? UNKNOWN : colorOf((values[i] - middle) / half);
    for (let k = 0; k < 3; k += 1) colors[3 * i + k] = LINEAR[Math.round(color[k])];
  }
}

/**
 * Arrows on the side that is cut, one for each cell of a coarse grid that the surface passes through.
 *
 * @param {Picture} picture
 * @param {Box3} box
 */
function arrowLines({ positions, normals }, box) {
  const size = box.getSize(new Vector3()).length();
  const cell = size / CELLS;
  /** @type {Map<string, { vertex: number, off: number }>} */
  const nearest = new Map();
  const point = new Vector3();
  const middle = new Vector3();
  for (let i = 0; i < positions.length / 3; i += 1) {
    point
      .fromArray(positions, 3 * i)
      .sub(box.min)
      .divideScalar(cell);
    middle.copy(point).floor();
    const key = middle.toArray().join();
    const off = point.distanceToSquared(middle.addScalar(0.5));
    const best = nearest.get(key);
    if (!best || off < best.off) nearest.set(key, { vertex: i, off });
  }
  const lines = [];
  for (const { vertex } of nearest.values()) lines.push(...arrow(positions, normals, vertex, size * ARROW));
  return new Float32Array(lines);
}

/** @param {Float32Array} positions @param {Float32Array} normals @param {number} i @param {number} length */
function arrow(positions, normals, i, length) {
  const root = new Vector3().fromArray(positions, 3 * i);
  const normal = new Vector3().fromArray(normals, 3 * i);
  const tip = root.clone().addScaledVector(normal, length);
  const across = new Vector3(normal.y, -normal.x, 0);
  if (across.lengthSq() < 1e-6) across.set(1, 0, 0);
  across.normalize().multiplyScalar(length * 0.16);
  const head = tip.clone().addScaledVector(normal, -length * 0.3);
  const [left, right] = [head.clone().add(across), head.sub(across)];
  return [...root, ...tip, ...tip, ...left, ...tip, ...right];
}
