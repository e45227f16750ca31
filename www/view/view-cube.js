/** A cube that turns with the picture: its faces are buttons that look from that side. */
import { Matrix4, Vector3 } from 'three';
import { t } from '../text/index.js';
import { h } from './dom.js';

/** The sides by name, each with the way out of it; z is up. @type {Record<string, [number, number, number]>} */
const SIDES = {
  top: [0, 0, 1],
  bottom: [0, 0, -1],
  front: [0, -1, 0],
  back: [0, 1, 0],
  left: [-1, 0, 0],
  right: [1, 0, 0],
};

/** How the text of a side lies. @type {Record<string, [number, number, number]>} */
const UP = {
  top: [0, 1, 0],
  bottom: [0, -1, 0],
  front: [0, 0, 1],
  back: [0, 0, 1],
  left: [0, 0, 1],
  right: [0, 0, 1],
};

/** Half an edge, pixels. */
const HALF = 22;

/**
 * @param {HTMLElement} root
 * @param {(side: string) => void} onSide
 */
export function createViewCube(root, onSide) {
  const faces = Object.entries(SIDES).map(([name, out]) => {
    const face = h(
      'button',
      { type: 'button', 'data-side': name, title: t(`canvas.${name}`), onclick: () => onSide(name) },
      t(`cube.${name}`),
    );
    const normal = new Vector3(...out);
    const up = new Vector3(...UP[name]);
    // The page's y runs down.
    const matrix = new Matrix4().makeBasis(up.clone().cross(normal), up.clone().negate(), normal);
    matrix.setPosition(normal.clone().multiplyScalar(HALF));
    face.style.transform = css(matrix);
    return { face, normal };
  });
  const cube = h('div', { class: 'cube' }, ...faces.map(({ face }) => face));
  root.append(cube);
  const flip = new Matrix4().makeScale(1, -1, 1);

  return {
    /** What it covers of the page, however it is turned; nothing while it is not shown. */
    box() {
      if (cube.getClientRects().length === 0) return new DOMRect();
      const { x, y } = cube.getBoundingClientRect();
      const reach = HALF * Math.sqrt(3);
      return new DOMRect(x - reach, y - reach, 2 * reach, 2 * reach);
    },

    /** @param {import('three').Camera} camera */
    turn(camera) {
      const view = new Matrix4().extractRotation(camera.matrixWorldInverse);
      cube.style.transform = css(flip.clone().multiply(view));
      const back = new Vector3().setFromMatrixColumn(camera.matrixWorld, 2);
      // What is turned away is not to be met by clicks or by the keyboard.
      for (const { face, normal } of faces) face.disabled = normal.dot(back) < 0.05;
    },
  };
}

/** @param {Matrix4} matrix */
const css = ({ elements }) => `matrix3d(${elements.map((x) => Number(x.toFixed(5))).join(',')})`;
