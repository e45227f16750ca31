/** Looks the texts of machines up. Only who asks for a machine loads them. */
import { language, prettify } from '../text/index.js';
import en from './machine-en.js';

/** @type {Record<string, string>} */
const table = language === 'zh' ? { ...en, ...(await import('./machine-zh.js')).default } : en;

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

export { prettify };
