/** Texts of the lessons, in the language that was chosen. */
import { language } from '../text/index.js';
import en from './texts/en.js';

/** @typedef {{ id: string, title: string, blocks: ([string] | [string, string] | [string, string, string])[] }} Lesson */

/** @type {{ table: Record<string, string>, lessons: Lesson[] }} */
const { table, lessons } = language === 'zh' ? (await import('./texts/zh.js')).default : en;

export { lessons };

/** The text with this id, its `{places}` filled. @param {string} id @param {Record<string, string | number>} [places] */
export function t(id, places = {}) {
  return (table[id] ?? en.table[id] ?? id).replace(/\{(\w+)\}/g, (all, name) => String(places[name] ?? all));
}
