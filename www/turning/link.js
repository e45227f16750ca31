/**
 * A turning job as a link: `#t1.` and then, in letters, four bytes of checksum and what they check, the job's JSON squeezed.
 *
 * Planning takes a moment, so nothing but the job travels. Links are kept and taught with: whatever follows version 1, its
 * links must open for ever.
 */
import { checksum } from '../share/checksum.js';
import { BadLink, MOST } from '../share/link.js';
import { deflate, inflate, joined, letters, unlettered } from '../share/squeeze.js';

const VERSION = '1';

/** Of what it holds, bytes. */
const MOST_INFLATED = 4e5;

/** The fragment of a link, with its `#`; it may be longer than {@link MOST}. @param {any} spec */
export async function linked(spec) {
  const squeezed = await deflate(new TextEncoder().encode(JSON.stringify(spec)));
  return `#t${VERSION}.${letters(joined([fourBytes(checksum(squeezed)), squeezed]))}`;
}

/** Whether an address has a fragment that means to be such a link. @param {string} fragment */
export const isLink = (fragment) => /^#t\d+\./.test(fragment);

/**
 * The job of a link, as it was written: whether it is one, the planner says. Throws {@link BadLink}.
 *
 * @param {string} fragment
 */
export async function opened(fragment) {
  if (fragment.length > 2 * MOST) throw new BadLink('large');
  const [, version, text] = fragment.match(/^#t(\d+)\.(.*)$/s) ?? [];
  if (version !== VERSION) throw new BadLink(Number(version) > Number(VERSION) ? 'new' : 'odd');
  const bytes = unlettered(text);
  if (!bytes || bytes.length < 5) throw new BadLink('cut');
  const squeezed = bytes.subarray(4);
  if (checksum(squeezed) !== new DataView(bytes.buffer).getUint32(0, true)) throw new BadLink('cut');
  const all = await inflate(squeezed, MOST_INFLATED);
  if (!all) throw new BadLink('large');
  try {
    const spec = JSON.parse(new TextDecoder().decode(all));
    if (typeof spec?.surface?.kind === 'string') return spec;
  } catch {
    // Told of below.
  }
  throw new BadLink('odd');
}

/** @param {number} value */
function fourBytes(value) {
  return Uint8Array.from([value, value >>> 8, value >>> 16, value >>> 24]);
}
