/**
 * The map of residues as seen from the tool, x to the right and y up.
 *
 * @import { Outcome, RayMap } from './types.js'
 */
import { divergingColor, UNKNOWN } from '../view/colors.js';

/** Room around the part, as a share of the canvas. */
const ROOM = 0.9;
/** Colours that are told apart. */
const COLORS = 255;
/** Within a tolerance band colours go so far and no farther: what is beyond is the end of the scale, at one look. */
const WITHIN = 0.36;

/** Pixels a millimetre. @param {HTMLCanvasElement} canvas @param {number} farthest */
export const zoom = ({ width, height }, farthest) => (0.5 * ROOM * Math.min(width, height)) / farthest;

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

/**
 * The colour of a residue.
 *
 * @param {number} residue mm
 * @param {number} most mm at the ends of the colours, or the tolerance of a band.
 * @param {boolean} isBand Whether what is beyond `most` shall stand out, as the paper's figures have it.
 */
export function residueColor(residue, most, isBand) {
  const share = residue / most;
  return divergingColor(isBand && Math.abs(share) <= 1 ? WITHIN * share : share);
}

/**
 * @param {CanvasRenderingContext2D} context
 * @param {Outcome} outcome
 * @param {number} most mm, as in {@link residueColor}.
 * @param {boolean} isBand
 */
export function drawMap(context, { residues, heights, farthest }, most, isBand) {
  const { width, height } = context.canvas;
  const image = context.createImageData(width, height);
  const pixels = new Uint32Array(image.data.buffer);
  const pack = (/** @type {number[]} */ [r, g, b]) => (255 << 24) | (b << 16) | (g << 8) | r;
  // Two ends beyond the limit, so that what is on it counts as within.
  const table = Array.from({ length: COLORS + 2 }, (_, i) =>
    pack(residueColor(((2 * (i - 1)) / (COLORS - 1) - 1) * most, most, isBand).map(Math.round)),
  );
  const unknown = pack(UNKNOWN);
  const map = residues ?? heights;
  const step = 1 / zoom(context.canvas, farthest);
  for (let row = 0; row < height; row += 1) {
    const y = (0.5 * height - row - 0.5) * step;
    for (let column = 0; column < width; column += 1) {
      const value = residueAt(map, farthest, (column + 0.5 - 0.5 * width) * step, y);
      if (Number.isNaN(value)) continue;
      const share = value / most;
      const within = Math.round(((share + 1) / 2) * (COLORS - 1)) + 1;
      const place = Math.abs(share) > 1 ? (share > 0 ? COLORS + 1 : 0) : within;
      const isKnown = residues !== null && Number.isFinite(value);
      pixels[row * width + column] = isKnown ? table[place] : unknown;
    }
  }
  context.putImageData(image, 0, 0);
}

/** Draws where the nose touches. @param {CanvasRenderingContext2D} context @param {Outcome} outcome @param {string} color */
export function drawTouches(context, { touches, farthest }, color) {
  const { width, height } = context.canvas;
  const scale = zoom(context.canvas, farthest);
  context.beginPath();
  for (let i = 0; i < touches.length; i += 3) {
    context.lineTo(0.5 * width + touches[i] * scale, 0.5 * height - touches[i + 1] * scale);
  }
  context.globalAlpha = 0.55;
  context.strokeStyle = color;
  context.lineWidth = Math.max(0.4, Math.min(0.8, 0.02 * scale));
  context.stroke();
  context.globalAlpha = 1;
}

/**
 * Rings around the places of the largest residue and of the deepest overcut.
 *
 * @param {CanvasRenderingContext2D} context
 * @param {Outcome} outcome
 * @param {[string, string]} colors Of the rings, and of what lifts them off the map.
 * @param {number} ratio Pixels of the canvas in one of the page.
 */
export function drawExtremes(context, { report, farthest }, [ink, ground], ratio) {
  const { width, height } = context.canvas;
  const scale = zoom(context.canvas, farthest);
  const { residue, overcut } = report.verified ?? {};
  context.fillStyle = ink;
  context.lineJoin = 'round';
  context.font = `${12 * ratio}px system-ui, sans-serif`;
  context.textBaseline = 'middle';
  for (const place of [residue, overcut]) {
    if (!place) continue;
    const [x, y] = [0.5 * width + place.x_mm * scale, 0.5 * height - place.y_mm * scale];
    const text = `${place.mm > 0 ? '+' : '−'}${Math.abs(place.mm * 1000).toPrecision(3)}`;
    const isRight = x > 0.7 * width;
    context.textAlign = isRight ? 'right' : 'left';
    const beside = x + (isRight ? -10 : 10) * ratio;
    context.beginPath();
    context.arc(x, y, 6 * ratio, 0, 2 * Math.PI);
    context.strokeStyle = ground;
    context.lineWidth = 4 * ratio;
    context.stroke();
    context.strokeText(text, beside, y);
    context.strokeStyle = ink;
    context.lineWidth = 1.6 * ratio;
    context.stroke();
    context.fillText(text, beside, y);
  }
}
