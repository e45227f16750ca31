/**
 * A job as a link: everything behind the `#`, which browsers keep to themselves.
 *
 * `#1.` and then, in letters, four bytes of checksum and what they check: squeezed, the length of a JSON text (four bytes,
 * low ones first), that text in UTF-8, and a preview of the path. Links are kept and taught with: whatever follows version 1,
 * its links must open for ever.
 *
 * @import { Outcome, Picture, Report, Spec } from '../types.js'
 */
import { BadLink, fourBytes, isWrapped, numberOf, unwrapped, wrapped } from './envelope.js';
import { packed, unpacked } from './preview.js';
import { joined } from './squeeze.js';

export { BadLink };

const VERSION = 1;

/** Letters that people and their programs still pass on. */
export const WISHED = 8000;
/** With more, a file is better. */
export const MOST = 30_000;
/** Nobody's link has more letters, nor more bytes in them. */
const MOST_READ = { letters: 65_536, bytes: 2e6 };
const MOST_JSON = 4e5;
const LONGEST_NAME = 200;

/** Steps of the preview's grid and cells of its shape, as parts of its diagonal, from fine to coarse. */
const FINENESS = [
  [16_384, 40],
  [8192, 32],
  [4096, 26],
  [2048, 20],
  [1024, 16],
  [512, 12],
  [256, 8],
];

/**
 * @typedef {{ spec: Spec, outcome: Outcome | null, isPreview: boolean, name: string }} Shared
 * `isPreview` if what is cut was too much to travel: then there is nothing to plan from.
 */

/**
 * The fragment of a link, with its `#`: as fine a preview as {@link WISHED} letters hold.
 *
 * @param {{ spec: Spec, name: string, outcome: Outcome | null, picture: Picture | null, isPreview: boolean }} job
 *   `outcome` only if it belongs to `spec`.
 * @returns {Promise<{ fragment: string, precision: number | null }>} The preview's grid, mm.
 */
export async function linked({ spec, name, outcome, picture, isPreview }) {
  const about = { spec, name: name.slice(0, LONGEST_NAME), ...(isPreview ? { isPreview } : {}) };
  if (!outcome) return { fragment: await fragmentOf(about, new Uint8Array()), precision: null };
  const size = diagonal(outcome.contacts);
  let best = { fragment: '', precision: /** @type {number | null} */ (null) };
  for (const [steps, cells] of FINENESS) {
    const { grid, bytes } = packed(outcome, picture, size / steps, size / cells);
    const told = { ...about, grid, report: outcome.report, outline: [...outcome.outline].map(round) };
    best = { fragment: await fragmentOf(told, bytes), precision: grid.step };
    if (best.fragment.length <= WISHED) break;
  }
  return best;
}

/** @param {object} about @param {Uint8Array} preview */
async function fragmentOf(about, preview) {
  const text = new TextEncoder().encode(JSON.stringify(about));
  return wrapped('', VERSION, joined([fourBytes(text.length), text, preview]));
}

/** Whether an address has a fragment that means to be a link. @param {string} fragment */
export const isLink = (fragment) => isWrapped('', fragment);

/**
 * What a link holds. Throws {@link BadLink}; nothing in it is trusted.
 *
 * @param {string} fragment
 * @returns {Promise<Shared>}
 */
export async function opened(fragment) {
  const all = await unwrapped('', VERSION, fragment, MOST_READ);
  if (all.length < 4) throw new BadLink('odd');
  const length = numberOf(all);
  if (length > MOST_JSON || length > all.length - 4) throw new BadLink('large');
  try {
    return understood(
      JSON.parse(new TextDecoder().decode(all.subarray(4, 4 + length))),
      all.subarray(4 + length),
    );
  } catch {
    throw new BadLink('odd');
  }
}

/** @param {any} about @param {Uint8Array} preview @returns {Shared} */
function understood({ spec, name, isPreview, grid, report, outline }, preview) {
  if (typeof spec !== 'object' || typeof spec?.source?.kind !== 'string') throw new BadLink('odd');
  const shared = { spec, name: String(name ?? '').slice(0, LONGEST_NAME), isPreview: isPreview === true };
  if (!grid) return { ...shared, outcome: null };
  const numbers = [...grid.low, grid.step, grid.scale, ...outline];
  if (grid.low.length !== 3 || !numbers.every(Number.isFinite)) throw new BadLink('odd');
  const drawn = unpacked(grid, preview);
  return {
    ...shared,
    outcome: {
      report: checkedReport(report),
      seconds: 0,
      proofSeconds: null,
      ...drawn,
      postures: new Float32Array((drawn.path.length / 8) * 4).fill(Number.NaN),
      zones: new Float32Array(),
      zoneEdge: 1,
      outline: Float32Array.from(outline),
      isPreview: true,
      files: null,
    },
  };
}

/** Every figure that a report must have is a number, or nothing where nothing is allowed. @param {any} report @returns {Report} */
function checkedReport(report) {
  const { length, unreachable, verified } = report;
  const needed = [
    length.cut_mm,
    length.link_mm,
    length.rapid_mm,
    report.passes,
    report.points,
    report.time_min,
  ];
  needed.push(
    report.area_mm2,
    unreachable.area_mm2,
    unreachable.cell_mm,
    unreachable.unseen_mm2,
    report.scallop_mm,
  );
  if (verified) needed.push(verified.share_within, verified.uncut_area_mm2, verified.samples);
  const free = Object.entries(verified ?? {}).filter(([name]) => !name.endsWith('_at'));
  const isFigure = (/** @type {unknown} */ x) => typeof x === 'number' && Number.isFinite(x);
  if (!needed.every(isFigure) || !free.every(([, x]) => x === null || isFigure(x))) throw new BadLink('odd');
  const warnings = Array.isArray(report.warnings) ? report.warnings.map(String).slice(0, 20) : [];
  return {
    ...report,
    name: String(report.name),
    strategy: String(report.strategy),
    verified: verified ?? null,
    warnings,
  };
}

/** A tenth of a micrometre. @param {number} mm */
const round = (mm) => Math.round(mm * 1e4) / 1e4;

/** Of the box around points, mm. @param {Float32Array} points */
function diagonal(points) {
  const low = [Infinity, Infinity, Infinity];
  const high = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < points.length; i += 1) {
    low[i % 3] = Math.min(low[i % 3], points[i]);
    high[i % 3] = Math.max(high[i % 3], points[i]);
  }
  return Math.hypot(...low.map((from, k) => high[k] - from)) || 1;
}
