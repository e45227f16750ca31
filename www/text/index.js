/** Looks texts up: in the language that was chosen, or else the system's. */
import en from './en.js';
import { lookup } from './lookup.js';

const KEY = 'language';

/** @returns {'en' | 'zh'} */
function preferred() {
  try {
    const stored = localStorage.getItem(KEY);
    if (stored === 'en' || stored === 'zh') return stored;
  } catch {
    // Where nothing may be stored, the system says.
  }
  return navigator.language.toLowerCase().startsWith('zh') ? 'zh' : 'en';
}

export const language = preferred();

/** Only who reads Chinese loads it. @type {Record<string, string>} */
const table = language === 'zh' ? { ...en, ...(await import('./zh.js')).default } : en;

/** Goes over to the other language; the work is kept. */
export function switchLanguage() {
  try {
    localStorage.setItem(KEY, language === 'zh' ? 'en' : 'zh');
  } catch {
    return;
  }
  location.reload();
}

export const { t, has } = lookup(table);

/**
 * A readable form of a name that the table does not know: `corner_radius_mm` is “Corner radius”.
 *
 * @param {string} name
 */
export function prettify(name) {
  const words = name.replace(/_(mm2|mm_min|mm|um|deg|rad|rpm|min|percent)$/, '').replaceAll('_', ' ');
  return words.charAt(0).toUpperCase() + words.slice(1);
}
