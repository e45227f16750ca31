/** Copies what stands in a field, and says so on the button. */
import { say } from './dom.js';

/** How long it is said, ms. */
const SAID = 2000;

/** @param {HTMLTextAreaElement} area @param {HTMLButtonElement} button @param {{ copy: string, copied: string }} texts */
export async function toClipboard(area, button, { copy, copied }) {
  area.select();
  try {
    await navigator.clipboard.writeText(area.value);
  } catch {
    // Without the permission the text is selected: the keys do it.
    return;
  }
  say(button, copied);
  setTimeout(() => say(button, copy), SAID);
}
