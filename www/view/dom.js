/** Small helpers for building elements. Text goes in as text, never as markup. */

const SVG = 'http://www.w3.org/2000/svg';

/**
 * An element with attributes, listeners (`onclick: f`) and children; `null` and `false` are left out.
 *
 * @template {keyof HTMLElementTagNameMap} K
 * @param {K} tag
 * @param {Record<string, any>} [attributes]
 * @param {...(Node | string | null | false)} children
 * @returns {HTMLElementTagNameMap[K]}
 */
export function h(tag, attributes = {}, ...children) {
  return fill(document.createElement(tag), attributes, children);
}

/**
 * The same for SVG.
 *
 * @template {keyof SVGElementTagNameMap} K
 * @param {K} tag
 * @param {Record<string, any>} [attributes]
 * @param {...(Node | string | null | false)} children
 * @returns {SVGElementTagNameMap[K]}
 */
export function s(tag, attributes = {}, ...children) {
  return fill(document.createElementNS(SVG, tag), attributes, children);
}

/**
 * @template {Element} E
 * @param {E} element
 * @param {Record<string, any>} attributes
 * @param {(Node | string | null | false)[]} children
 */
function fill(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith('on')) element.addEventListener(name.slice(2), value);
    else element.setAttribute(name, value === true ? '' : String(value));
  }
  element.append(
    .../** @type {(Node | string)[]} */ (children.filter((child) => child !== null && child !== false)),
  );
  return element;
}

/** The element of the page with this id. @param {string} id */
export function place(id) {
  const element = document.getElementById(id);
  if (!element) throw new Error(`no element #${id}`);
  return element;
}

/** Sets or removes an attribute. @param {Element} element @param {string} name @param {string | null} value */
export function attribute(element, name, value) {
  if (value === null) element.removeAttribute(name);
  else if (element.getAttribute(name) !== value) element.setAttribute(name, value);
}

/** Changes a text only when it differs, so that screen readers are not told twice. @param {Element} element @param {string} text */
export function say(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

/**
 * A line icon of 20 by 20.
 *
 * @param {keyof typeof ICONS} name
 */
export function icon(name) {
  return s(
    'svg',
    { viewBox: '0 0 20 20', class: 'icon', 'aria-hidden': 'true' },
    s('path', { d: ICONS[name] }),
  );
}

const ICONS = {
  undo: 'M7 4 3 8l4 4M3.5 8H12a4.5 4.5 0 0 1 0 9H8',
  redo: 'm13 4 4 4-4 4M16.500 8H8a4.5 4.5 0 0 0 0 9h4',
  open: 'M10 13V3M6 6.500 10 3l4 3.500M3 13v4h14v-4',
  save: 'M10 3v10M6 9.500 10 13l4-3.500M3 13v4h14v-4',
  close: 'm5 5 10 10M15 5 5 15',
  flip: 'M3 10h14M10 7V2M7.500 4 10 1.500 12.500 4M10 13v5M7.500 16l2.500 2.500 2.500-2.500',
  play: 'M6 3.500v13l10-6.500z',
  pause: 'M6.500 4v12M13.500 4v12',
  back: 'M14.500 4v12L7 10zM5 4v12',
  on: 'M5.500 4v12L13 10zM15 4v12',
  fit: 'M3 7V3h4M13 3h4v4M17 13v4h-4M7 17H3v-4',
  chart: 'M3 3v14h14M5.500 6c1 5 4 6.500 10.500 7',
  share:
    'M7.500 12.500 12.500 7.500M9 5.500l2-2a3.500 3.500 0 0 1 5 5l-2 2M11 14.500l-2 2a3.500 3.500 0 0 1-5-5l2-2',
  good: 'm4 10.500 4 4 8-9',
  bad: 'M10 4v7.500M10 15v.5',
};
