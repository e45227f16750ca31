/** Looks the turning page's texts up, in the language that the whole page is in. */
import { language, prettify, switchLanguage } from '../text/index.js';
import en from '../text/turning.js';

/** Only who reads Chinese loads these. */
const [chinese, sentences] =
  language === 'zh'
    ? await Promise.all([import('../text/turning-zh.js'), import('../text/turning-said-zh.js')])
    : [];

/** @type {Record<string, string>} */
const table = { ...en, ...chinese?.default };

/**
 * The text with this id, its `{places}` filled; for an unknown id the text `fallback`, or the id.
 *
 * @param {string} id
 * @param {Record<string, string | number>} [places]
 * @param {string} [fallback]
 */
export function t(id, places = {}, fallback = id) {
  return (table[id] ?? fallback).replace(/\{(\w+)\}/g, (all, name) => String(places[name] ?? all));
}

/** Whether there is a text with this id. @param {string} id */
export const has = (id) => id in table;

/** What the planner says, in the language of the page. @param {string} message */
export const said = (message) => sentences?.said(message) ?? message;

export { language, prettify, switchLanguage };
