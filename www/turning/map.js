/**
 * The map of residues as seen from the tool, x to the right and y up.
 *
 * @import { Outcome, RayMap } from './types.js'
 */
import { divergingColor, UNKNOWN } from '../view/colors.js';

/** Room around the part, as a share of the canvas. */
const ROOM = 0.94;
/** Colours that are told apart. */
const COLORS = 255;

/** Pixels a millimetre. @param {CanvasRenderingContext2D} context @param {number} farthest */
function zoom({ canvas }, farthest) {
  return (0.5 * ROOM * Math.min(canvas.width, canvas.height)) / farthest;
}

/**
 * The residue nearest to a place; not a number outside of the aperture.
 *
 * @param {RayMap} map
 * @param {number} farthest
 * @param {number} x
 * @param {number} y
 */
export function residueAt({ values, rays, rings }, farthest, x, y) {
  const ring = Math.round((Math.hypot(x, y) / farthest) * (rings - 1));
  if (ring >= rings) return NaN;
  const turn = Math.atan2(y, x) / (2 * Math.PI);
  const ray = Math.round((turn < 0 ? turn + 1 : turn) * rays) % rays;
  return values[ray * rings + ring];
}

/** @param {CanvasRenderingContext2D} context @param {Outcome} outcome @param {number} most mm at the ends of the colours. */
export function drawMap(context, { residues, heights, farthest }, most) {
  const { width, height } = context.canvas;
  const image = context.createImageData(width, height);
  const pixels = new Uint32Array(image.data.buffer);
  const pack = (/** @type {number[]} */ [r, g, b]) => (255 << 24) | (b << 16) | (g << 8) | r;
  const table = Array.from({ length: COLORS }, (_, i) =>
    pack(divergingColor((2 * i) / (COLORS - 1) - 1).map(Math.round)),
  );
  const unknown = pack(UNKNOWN);
  const map = residues ?? heights;
  const step = 1 / zoom(context, farthest);
  for (let row = 0; row < height; row += 1) {
    const y = (0.5 * height - row - 0.5) * step;
    for (let column = 0; column < width; column += 1) {
      const value = residueAt(map, farthest, (column + 0.5 - 0.5 * width) * step, y);
      if (Number.isNaN(value)) continue;
      const share = Math.max(-1, Math.min(1, value / most));
      const isKnown = residues !== null && Number.isFinite(value);
      pixels[row * width + column] = isKnown ? table[Math.round(((share + 1) / 2) * (COLORS - 1))] : unknown;
    }
  }
  context.putImageData(image, 0, 0);
}

/** Draws where the nose touches. @param {CanvasRenderingContext2D} context @param {Outcome} outcome @param {string} color */
export function drawTouches(context, { touches, farthest }, color) {
  const { width, height } = context.canvas;
  const scale = zoom(context, farthest);
  context.beginPath();
  for (let i = 0; i < touches.length; i += 3) {
    context.lineTo(0.5 * width + touches[i] * scale, 0.5 * height - touches[i + 1] * scale);
  }
  context.strokeStyle = color;
  context.lineWidth = Math.max(0.4, Math.min(1, 0.02 * scale));
  context.stroke();
}
