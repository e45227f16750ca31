/**
 * The settings, made from the schema that the planner exports.
 *
 * @import { State } from './types.js'
 * @import { Schema, Group, Field } from '../types.js'
 */
import { count, plain } from '../format.js';
import { chosen, fault, fieldsOf, pointsOf, pointsText, read } from '../spec.js';
import { booleanControl, choiceControl, numberControl } from '../view/controls.js';
import { attribute, h, say } from '../view/dom.js';
import { has, prettify, t } from './text.js';

/** Groups that are open at first: what most people set. */
const OPEN = new Set(['surface', 'aperture', 'tool', 'guide', 'points', 'tolerance']);

/** Longer lists come from a file and are not shown. */
const MOST_WRITTEN = 2000;

/** @typedef {HTMLInputElement | HTMLSelectElement | HTMLTextAreaElement} Control */
/** @typedef {{ input: Control, row: HTMLElement, note: HTMLElement, message: HTMLElement, field: Field }} Entry */

/**
 * @param {HTMLElement} root
 * @param {{ onEdit: (path: string, value: any) => void, onVariant: (group: Group, kind: string) => void,
 *   onPick: () => void, above: Record<string, HTMLElement> }} callbacks `onPick` when somebody wants to open a file; `above` is what stands
 *   above the settings of a group.
 */
export function createForm(root, { onEdit, onVariant, onPick, above }) {
  /** @type {Map<string, Entry>} */
  let entries = new Map();
  /** @type {Map<string, HTMLElement>} */
  const bodies = new Map();
  let shown = '';

  /** @param {Schema} schema */
  function build(schema) {
    root.replaceChildren(
      ...schema.groups.map((group) => {
        const body = h('div', { class: 'fields' });
        bodies.set(group.path, body);
        const title = h('h2', {}, t(`group.${group.path}`, {}, prettify(group.path)));
        return h(
          'details',
          { class: 'panel', open: OPEN.has(group.path), 'data-group': group.path },
          h('summary', {}, title),
          above[group.path] ?? null,
          body,
        );
      }),
    );
  }

  /** @param {Group} group @param {any} spec */
  function kinds(group, spec) {
    if (!group.variants?.length) return null;
    const now = chosen(group, spec)?.kind;
    const options = group.variants.map(({ kind }) =>
      h('option', { value: kind, selected: kind === now }, t(`choice.${kind}`, {}, prettify(kind))),
    );
    const select = h(
      'select',
      { name: `${group.path}.kind`, onchange: () => onVariant(group, select.value) },
      ...options,
    );
    return h('label', { class: 'field wide' }, h('span', {}, t('kind')), select);
  }

  /** @param {Group} group @param {Field} field */
  function row(group, field) {
    const path = `${group.path}.${field.name}`;
    const id = `field-${path}`;
    const input = control(field, path);
    input.id = id;
    const unit = field.unit ? h('span', { class: 'unit' }, t(`unit.${field.unit}`, {}, field.unit)) : null;
    const pick =
      path === 'surface.heights_mm'
        ? h(
            'button',
            { type: 'button', class: 'small', name: 'heights', onclick: onPick },
            t('action.heights'),
          )
        : null;
    const help = has(`help.${path}`) ? h('p', { class: 'help', id: `${id}-help` }, t(`help.${path}`)) : null;
    const note = h('p', { class: 'help' });
    const message = h('p', { class: 'message', id: `${id}-message`, 'aria-live': 'polite' });
    input.setAttribute('aria-describedby', `${help ? `${help.id} ` : ''}${message.id}`);
    const element = h(
      'div',
      { class: `field ${field.type}`, 'data-field': path },
      h('label', { for: id }, t(`field.${path}`, {}, prettify(field.name))),
      h('span', { class: 'value' }, input, unit),
      note,
      pick,
      help,
      message,
    );
    entries.set(path, { input, row: element, note, message, field });
    return element;
  }

  /** @param {Field} field @param {string} path @returns {Control} */
  function control(field, path) {
    const type = /** @type {string} */ (field.type);
    if (type === 'choice') {
      return choiceControl(path, (field.options ?? []).map(choice), (value) => onEdit(path, value));
    }
    if (type === 'points' || type === 'numbers') {
      const value = type === 'points' ? pointsOf : numbersOf;
      const area = h('textarea', { name: path, rows: 4, spellcheck: 'false', autocomplete: 'off' });
      area.addEventListener('input', () => onEdit(path, value(area.value)));
      return area;
    }
    if (type === 'boolean') return booleanControl(path, (value) => onEdit(path, value));
    if (type === 'text') {
      const text = h('input', { type: 'text', name: path, oninput: () => onEdit(path, text.value) });
      return text;
    }
    return numberControl(path, field, (value) => onEdit(path, value));
  }

  /** @param {State} state */
  function showValues({ draft: spec, problem }) {
    for (const [path, { input, row, note, message, field }] of entries) {
      const value = read(spec, path);
      showValue(input, field, value);
      say(note, input.hidden ? t('form.many', { count: count(value.length) }) : '');
      note.hidden = !input.hidden;
      const text = faultText(field, value) || (problem?.field === path ? problem.message : '');
      say(message, text);
      row.classList.toggle('wrong', text !== '');
      attribute(input, 'aria-invalid', text === '' ? null : 'true');
    }
  }

  return {
    /** Opens the section of a field and goes there. @param {string} path */
    focus(path) {
      const entry = entries.get(path);
      // What concerns a whole section is said at the button.
      if (!entry) return;
      entry.row.closest('details')?.setAttribute('open', '');
      entry.input.focus();
    },

    /** @param {State} state */
    update(state) {
      const { schema, draft: spec } = state;
      if (!schema || !spec) return;
      if (bodies.size === 0) build(schema);
      const list = (/** @type {Group} */ group) =>
        fieldsOf(group, spec).filter(({ name }) => name !== 'path');
      const key = schema.groups
        .map((group) => [chosen(group, spec)?.kind, ...list(group).map(({ name }) => name)])
        .join(' ');
      if (key !== shown) {
        shown = key;
        entries = new Map();
        const focused = /** @type {HTMLSelectElement | null} */ (document.activeElement)?.name;
        for (const group of schema.groups) {
          const rows = list(group).map((field) => row(group, field));
          const all = [kinds(group, spec), ...rows].filter((part) => part !== null);
          bodies.get(group.path)?.replaceChildren(...all);
        }
        const again = focused ? root.querySelector(`[name="${focused}"]`) : null;
        if (again instanceof HTMLElement) again.focus();
      }
      showValues(state);
    },
  };
}

/** @param {Control} input @param {Field} field @param {any} value */
function showValue(input, field, value) {
  if (input instanceof HTMLInputElement && input.type === 'checkbox') input.checked = value === true;
  else if (input instanceof HTMLTextAreaElement) {
    // A million numbers are no text that anybody writes.
    input.hidden = (value ?? []).length > MOST_WRITTEN;
    if (input.hidden) return;
    const isPoints = field.type === 'points';
    const same = isPoints
      ? pointsText(pointsOf(input.value)) === pointsText(value ?? [])
      : String(numbersOf(input.value)) === String(value ?? []);
    // What is being written is left as it is.
    if (!same) input.value = isPoints ? pointsText(value ?? []) : (value ?? []).join(', ');
  } else if (input instanceof HTMLInputElement && input.type === 'number') {
    const typed = Number.isNaN(input.valueAsNumber) ? null : input.valueAsNumber;
    if (typed !== (value ?? null)) input.value = value === null || value === undefined ? '' : String(value);
  } else if (input.value !== String(value ?? '')) input.value = String(value ?? '');
}

/** An option and what a person reads. @param {string} option @returns {[string, string]} */
function choice(option) {
  return [option, t(`choice.${option}`, {}, prettify(option))];
}

/** The numbers of a text between commas, blanks or line ends. @param {string} text */
function numbersOf(text) {
  return text
    .split(/[\s,;]+/)
    .filter((cell) => cell !== '')
    .map(Number);
}

/** What is wrong with a value, in words; '' if nothing. @param {Field} field @param {any} value */
function faultText(field, value) {
  const type = /** @type {string} */ (field.type);
  if (type === 'points') {
    const isTerm = (/** @type {any[]} */ term) => term.length === 3 && term.every(Number.isFinite);
    return (value ?? []).every(isTerm) ? '' : t('fault.points');
  }
  if (type === 'numbers') return (value ?? []).every(Number.isFinite) ? '' : t('fault.numbers');
  if (type === 'text') return '';
  const code = fault(field, value);
  if (!code) return '';
  const bound = (/** @type {number | undefined} */ at) =>
    at === undefined ? '' : `${plain(at)} ${field.unit ?? ''}`.trim();
  return t(`fault.${code}`, { min: bound(field.min), max: bound(field.max) });
}
