/**
 * The lens in space, coloured by residue, with the path on it.
 *
 * @import { Outcome } from './types.js'
 */
import { css } from '../view/colors.js';
import { residueAt } from './map.js';

/** Room around the part, as a share of the canvas. */
const ROOM = 0.9;
/** Light from above the left shoulder. */
const LIGHT = [-0.45, 0.35, 0.82];

/**
 * @param {CanvasRenderingContext2D} context
 * @param {Outcome} outcome
 * @param {(residue: number) => number[]} paint The colour of a residue, mm.
 * @param {{ yaw: number, pitch: number }} camera
 * @param {string | null} line Colour of the path, if it is shown.
 * @param {string} plain Colour of what is not proven.
 */
export function drawLens(context, { heights, residues, touches, farthest }, paint, camera, line, plain) {
  const { width, height } = context.canvas;
  const scale = (0.5 * ROOM * Math.min(width, height)) / farthest;
  const [cy, sy, cp, sp] = [
    Math.cos(camera.yaw),
    Math.sin(camera.yaw),
    Math.cos(camera.pitch),
    Math.sin(camera.pitch),
  ];
  const middle = heights.values.filter(Number.isFinite).reduce((sum, z, _, all) => sum + z / all.length, 0);
  /** Right, up and towards the eye. @param {number} x @param {number} y @param {number} z */
  const project = (x, y, z) => {
    const [right, away, up] = [x * cy - y * sy, x * sy + y * cy, z - middle];
    return [0.5 * width + right * scale, 0.5 * height - (away * sp + up * cp) * scale, up * sp - away * cp];
  };
  const { values, rays, rings } = heights;
  const place = (/** @type {number} */ ray, /** @type {number} */ ring) => {
    const z = values[(ray % rays) * rings + ring];
    const angle = (2 * Math.PI * ray) / rays;
    const rho = (farthest * ring) / (rings - 1);
    return [rho * Math.cos(angle), rho * Math.sin(angle), z];
  };
  const facets = [];
  for (let ray = 0; ray < rays; ray += 1) {
    for (let ring = 0; ring + 1 < rings; ring += 1) {
      const corners = [
        place(ray, ring),
        place(ray, ring + 1),
        place(ray + 1, ring + 1),
        place(ray + 1, ring),
      ];
      if (!corners.every(([, , z]) => Number.isFinite(z))) continue;
      const seen = corners.map(([x, y, z]) => project(x, y, z));
      facets.push({ corners, seen, depth: seen.reduce((sum, p) => sum + p[2], 0) });
    }
  }
  facets.sort((a, b) => a.depth - b.depth);
  for (const { corners, seen } of facets) {
    const [x, y] = [0, 1].map((k) => corners.reduce((sum, p) => sum + p[k] / 4, 0));
    const residue = residues ? residueAt(residues, farthest, x, y) : NaN;
    const color = Number.isFinite(residue) ? css(shaded(paint(residue), light(corners))) : plain;
    context.beginPath();
    for (const [px, py] of seen) context.lineTo(px, py);
    context.closePath();
    context.fillStyle = color;
    context.strokeStyle = color;
    context.fill();
    // Without its edges hairlines of the ground show between facets.
    context.stroke();
  }
  if (!line) return;
  context.beginPath();
  for (let i = 0; i < touches.length; i += 3) {
    const [px, py] = project(touches[i], touches[i + 1], touches[i + 2]);
    context.lineTo(px, py);
  }
  context.globalAlpha = 0.45;
  context.strokeStyle = line;
  context.lineWidth = 0.6;
  context.stroke();
  context.globalAlpha = 1;
}

/** How bright a facet is, 0.55 to 1. @param {number[][]} corners */
function light([a, b, c, d]) {
  const [u, v] = [
    [c[0] - a[0], c[1] - a[1], c[2] - a[2]],
    [d[0] - b[0], d[1] - b[1], d[2] - b[2]],
  ];
  const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
  const dot = n[0] * LIGHT[0] + n[1] * LIGHT[1] + n[2] * LIGHT[2];
  return 0.55 + 0.45 * Math.max(0, dot / (Math.hypot(...n) || 1));
}

/** @param {number[]} color @param {number} brightness */
const shaded = (color, brightness) => color.map((part) => part * brightness);
