/**
 * What every link is wrapped in: `#`, a kind and a version, a point, and in letters four bytes of checksum and what they check,
 * squeezed.
 */
import { checksum } from './checksum.js';
import { deflate, inflate, joined, letters, unlettered } from './squeeze.js';

/** Why a link cannot be opened: `cut` (letters are missing or wrong), `new` (of a later version), `large`, or `odd`. */
export class BadLink extends Error {
  /** @param {'cut' | 'new' | 'large' | 'odd'} code */
  constructor(code) {
    super(code);
    this.code = code;
  }
}

/**
 * The fragment of a link, with its `#`.
 *
 * @param {string} kind Letters before the version; '' for a job of the planner.
 * @param {number} version
 * @param {Uint8Array} content
 */
export async function wrapped(kind, version, content) {
  const squeezed = await deflate(content);
  return `#${kind}${version}.${letters(joined([fourBytes(checksum(squeezed)), squeezed]))}`;
}

/** Whether a fragment means to be a link of a kind. @param {string} kind @param {string} fragment */
export const isWrapped = (kind, fragment) => new RegExp(`^#${kind}\\d+\\.`).test(fragment);

/**
 * What was wrapped. Throws {@link BadLink}; nothing in it is trusted.
 *
 * @param {string} kind
 * @param {number} version The last that is known.
 * @param {string} fragment
 * @param {{ letters: number, bytes: number }} most What is read of it, and of what it holds.
 */
export async function unwrapped(kind, version, fragment, most) {
  if (fragment.length > most.letters) throw new BadLink('large');
  const [, told, text] = fragment.match(new RegExp(`^#${kind}(\\d+)\\.(.*)$`, 's')) ?? [];
  if (told !== String(version)) throw new BadLink(Number(told) > version ? 'new' : 'odd');
  const bytes = unlettered(text);
  if (!bytes || bytes.length < 5) throw new BadLink('cut');
  const squeezed = bytes.subarray(4);
  if (checksum(squeezed) !== numberOf(bytes)) throw new BadLink('cut');
  const content = await inflate(squeezed, most.bytes);
  if (!content) throw new BadLink('large');
  return content;
}

/** Four bytes, low ones first. @param {number} value */
export function fourBytes(value) {
  return Uint8Array.from([value, value >>> 8, value >>> 16, value >>> 24]);
}

/** The number of the first four bytes. @param {Uint8Array} bytes */
export const numberOf = (bytes) => (bytes[0] | (bytes[1] << 8) | (bytes[2] << 16) | (bytes[3] << 24)) >>> 0;
