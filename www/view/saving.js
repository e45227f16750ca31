/** Hands a file to the browser's downloads. */
import { h } from './dom.js';

/** @param {Blob} blob @param {string} name */
export function save(blob, name) {
  const href = URL.createObjectURL(blob);
  h('a', { href, download: name }).click();
  // The browser has taken the blob by then.
  setTimeout(() => URL.revokeObjectURL(href), 10_000);
}
