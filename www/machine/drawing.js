/**
 * The machine as simple solids, its axes where the playhead has them. The module says where everything stands; here it is only looked at.
 *
 * @import { State, Figure, Moment } from './types.js'
 */
import { attribute, h } from '../view/dom.js';
import { t } from './text.js';

/** From the right, the front, and a little above, radians. */
const VIEW = { yaw: -0.62, pitch: 0.42 };
/** Radians a pixel that is dragged, and a press of an arrow key. */
const DRAG = 0.01;
const PRESS = 0.15;
const SHARPEST = 2;
/** Share of the picture that the machine fills. */
const MARGIN = 0.9;
/** Where the light comes from, as seen: from the upper left, before the picture. */
const LIGHT = [-0.42, 0.64, 0.64];

/** @param {HTMLElement} root */
export function createDrawing(root) {
  const canvas = h('canvas', { tabindex: 0, role: 'img' });
  const name = h('p', { class: 'name' });
  const hide = h('button', {
    type: 'button',
    class: 'small quiet',
    name: 'machine-drawing',
    onclick: toggle,
  });
  root.append(h('div', { class: 'head' }, name, hide), canvas);
  let isFolded = matchMedia('(width < 760px)').matches;
  let { yaw, pitch } = VIEW;
  /** @type {Figure | null} */
  let figure = null;
  /** @type {Moment | null} */
  let moment = null;
  let scheduled = false;

  function toggle() {
    isFolded = !isFolded;
    fold();
  }

  function fold() {
    root.classList.toggle('folded', isFolded);
    canvas.hidden = isFolded;
    hide.textContent = isFolded ? '▸' : '×';
    const label = t(isFolded ? 'drawing.show' : 'drawing.hide');
    attribute(hide, 'aria-label', label);
    hide.title = label;
    draw();
  }

  function draw() {
    if (scheduled) return;
    scheduled = true;
    requestAnimationFrame(() => {
      scheduled = false;
      if (figure && moment && !isFolded) paint(canvas, figure, moment, yaw, pitch);
    });
  }

  /** @param {number} right @param {number} up */
  function turn(right, up) {
    yaw += right;
    pitch = Math.min(Math.max(pitch + up, -0.3), 1.5);
    draw();
  }

  canvas.addEventListener('pointermove', (event) => {
    if (event.buttons & 1) turn(event.movementX * DRAG, event.movementY * DRAG);
  });
  canvas.addEventListener('pointerdown', (event) => canvas.setPointerCapture(event.pointerId));
  canvas.addEventListener('keydown', (event) => {
    const by = {
      ArrowLeft: [-PRESS, 0],
      ArrowRight: [PRESS, 0],
      ArrowUp: [0, PRESS],
      ArrowDown: [0, -PRESS],
    };
    const turned = /** @type {Record<string, number[]>} */ (by)[event.key];
    if (!turned) return;
    event.preventDefault();
    turn(turned[0], turned[1]);
  });
  new ResizeObserver(draw).observe(canvas);
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', draw);
  fold();

  return {
    /** @param {State} state */
    update(state) {
      root.hidden = !state.work;
      if (!state.work) return;
      if (figure !== state.work.figure) {
        const called = state.work.report.machine;
        const known = state.machines.find((one) => one.name === called);
        const machine = t(`name.${known?.id}`, {}, called);
        name.textContent = machine;
        canvas.setAttribute('aria-label', t('drawing.label', { machine }));
      } else if (moment === state.moment) return;
      figure = state.work.figure;
      moment = state.moment;
      draw();
    },
  };
}

/** @param {HTMLCanvasElement} canvas @param {Figure} figure @param {Moment} moment @param {number} yaw @param {number} pitch */
function paint(canvas, figure, moment, yaw, pitch) {
  const ratio = Math.min(devicePixelRatio, SHARPEST);
  const [width, height] = [canvas.clientWidth * ratio, canvas.clientHeight * ratio];
  if (canvas.width !== width || canvas.height !== height) [canvas.width, canvas.height] = [width, height];
  const pen = canvas.getContext('2d');
  if (!pen || width === 0) return;
  const style = getComputedStyle(canvas);
  const color = (/** @type {string} */ name) => style.getPropertyValue(`--machine-${name}`).trim();
  const look = camera(figure.hull, yaw, pitch, width, height);
  pen.clearRect(0, 0, width, height);
  pen.lineJoin = 'round';

  // Convex, so that far solids before near ones, and of each the faces that look here, make the picture.
  const solids = figure.solids.map((solid) => {
    const points = placed(moment.bodies, solid.body, solid.corners).map(look);
    const depth = points.reduce((sum, [, , z]) => sum + z, 0) / points.length;
    return { solid, points, depth };
  });
  const line = placed(moment.bodies, figure.line.body, figure.line.points).map(look);
  const middle = line.reduce((sum, [, , z]) => sum + z, 0) / Math.max(line.length, 1);
  let isLineDrawn = line.length === 0;
  const drawLine = () => {
    isLineDrawn = true;
    pen.strokeStyle = color('line');
    pen.lineWidth = 0.7 * ratio;
    pen.beginPath();
    for (const [x, y] of line) pen.lineTo(x, y);
    pen.stroke();
  };
  for (const { solid, points, depth } of solids.sort((a, b) => a.depth - b.depth)) {
    if (!isLineDrawn && solid.part !== 'table' && solid.part !== 'drum' && depth > middle) drawLine();
    for (const face of solid.faces) {
      const corners = face.map((k) => points[k]);
      const normal = across(corners);
      if (normal[2] <= 0) continue;
      const light = Math.max(0, normal[0] * LIGHT[0] + normal[1] * LIGHT[1] + normal[2] * LIGHT[2]);
      pen.beginPath();
      for (const [x, y] of corners) pen.lineTo(x, y);
      pen.closePath();
      for (const fill of [color(solid.part), `rgb(0 0 0 / ${(0.4 * (1 - light)).toFixed(3)})`]) {
        pen.fillStyle = fill;
        pen.fill();
      }
      if (face.length === 4 && solid.faces.length < 10) {
        pen.strokeStyle = color('edge');
        pen.lineWidth = 0.6 * ratio;
        pen.stroke();
      }
    }
  }
  if (!isLineDrawn) drawLine();
  pen.font = `600 ${11 * ratio}px ${style.fontFamily}`;
  pen.textAlign = 'center';
  pen.textBaseline = 'middle';
  for (const { letter, body, at } of figure.labels) {
    const [x, y] = look(placed(moment.bodies, body, at)[0]);
    pen.beginPath();
    pen.arc(x, y, 8.5 * ratio, 0, 2 * Math.PI);
    pen.fillStyle = color('label');
    pen.fill();
    pen.strokeStyle = color('edge');
    pen.lineWidth = ratio;
    pen.stroke();
    pen.fillStyle = color('letter');
    pen.fillText(letter, x, y + 0.5 * ratio);
  }
}

/** Points of a body where it stands. @param {Float32Array} bodies @param {number} body @param {number[]} flat */
function placed(bodies, body, flat) {
  const m = bodies.subarray(12 * body, 12 * body + 12);
  const points = [];
  for (let i = 0; i + 2 < flat.length; i += 3) {
    const [x, y, z] = [flat[i], flat[i + 1], flat[i + 2]];
    points.push([0, 1, 2].map((k) => m[k] * x + m[3 + k] * y + m[6 + k] * z + m[9 + k]));
  }
  return points;
}

/**
 * From the machine frame to pixels and a depth that grows towards the eye.
 *
 * @param {number[]} hull Points of all that is to be seen, three numbers each.
 * @param {number} yaw @param {number} pitch @param {number} width @param {number} height
 */
function camera(hull, yaw, pitch, width, height) {
  const [sy, cy, sp, cp] = [Math.sin(yaw), Math.cos(yaw), Math.sin(pitch), Math.cos(pitch)];
  /** @param {number[]} point */
  const seen = ([x, y, z]) => {
    const [right, back] = [cy * x - sy * y, sy * x + cy * y];
    return [right, cp * z + sp * back, sp * z - cp * back];
  };
  const low = [Infinity, Infinity];
  const high = [-Infinity, -Infinity];
  for (let i = 0; i + 2 < hull.length; i += 3) {
    const at = seen([hull[i], hull[i + 1], hull[i + 2]]);
    for (const k of [0, 1]) {
      low[k] = Math.min(low[k], at[k]);
      high[k] = Math.max(high[k], at[k]);
    }
  }
  const scale = Math.min(
    (MARGIN * width) / (high[0] - low[0] || 1),
    (MARGIN * height) / (high[1] - low[1] || 1),
  );
  return (/** @type {number[]} */ point) => {
    const [x, y, z] = seen(point);
    return [
      width / 2 + scale * (x - (low[0] + high[0]) / 2),
      height / 2 - scale * (y - (low[1] + high[1]) / 2),
      scale * z,
    ];
  };
}

/** The unit normal of a face as it is seen: x to the right, y up, z to the eye. @param {number[][]} corners */
function across(corners) {
  const [a, b, c] = [corners[0], corners[1], corners[2]];
  const u = [b[0] - a[0], a[1] - b[1], b[2] - a[2]];
  const v = [c[0] - b[0], b[1] - c[1], c[2] - b[2]];
  const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
  const size = Math.hypot(n[0], n[1], n[2]) || 1;
  return n.map((x) => x / size);
}
