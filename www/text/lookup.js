/** Looks texts up in a table. */

/** @typedef {Record<string, string>} Table */

/** @param {Table} table */
export function lookup(table) {
  return {
    /**
     * The text with this id, its `{places}` filled; for an unknown id the text `fallback`, or the id.
     *
     * @param {string} id
     * @param {Record<string, string | number>} [places]
     * @param {string} [fallback]
     */
    t: (id, places = {}, fallback = id) =>
      (table[id] ?? fallback).replace(/\{(\w+)\}/g, (all, name) => String(places[name] ?? all)),

    /** Whether there is a text with this id. @param {string} id */
    has: (id) => id in table,
  };
}
