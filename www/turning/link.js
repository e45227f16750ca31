/**
 * A turning job as a link: `#t1.` and the job's JSON in an envelope.
 *
 * Planning takes a moment, so nothing but the job travels. Links are kept and taught with: whatever follows version 1, its
 * links must open for ever.
 */
import { BadLink, isWrapped, unwrapped, wrapped } from '../share/envelope.js';
import { MOST } from '../share/link.js';

const KIND = 't';
const VERSION = 1;

/** Letters that are read, and bytes that they may hold. */
const MOST_READ = { letters: 2 * MOST, bytes: 4e5 };

/** The fragment of a link, with its `#`; it may be longer than {@link MOST}. @param {any} spec */
export const linked = (spec) => wrapped(KIND, VERSION, new TextEncoder().encode(JSON.stringify(spec)));

/** Whether an address has a fragment that means to be such a link. @param {string} fragment */
export const isLink = (fragment) => isWrapped(KIND, fragment);

/**
 * The job of a link, as it was written: whether it is one, the planner says. Throws {@link BadLink}.
 *
 * @param {string} fragment
 */
export async function opened(fragment) {
  const content = await unwrapped(KIND, VERSION, fragment, MOST_READ);
  try {
    const spec = JSON.parse(new TextDecoder().decode(content));
    if (typeof spec?.surface?.kind === 'string') return spec;
  } catch {
    // Told of below.
  }
  throw new BadLink('odd');
}
