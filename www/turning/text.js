/** Looks the turning page's texts up. */
import { prettify } from '../text/index.js';
import en from '../text/turning.js';

/** @type {Record<string, string>} */
const table = en;

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
