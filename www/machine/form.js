/**
 * The settings of a program, made from the schema that the module exports.
 *
 * @import { State } from './types.js'
 * @import { Field, Group } from '../types.js'
 */
import { plain } from '../format.js';
import { fault, fieldsOf, read } from '../spec.js';
import { booleanControl, choiceControl, numberControl } from '../view/controls.js';
import { attribute, h, say } from '../view/dom.js';
import { has, prettify, t } from './text.js';

/** @typedef {{ input: HTMLInputElement | HTMLSelectElement, row: HTMLElement, message: HTMLElement, field: Field }} Entry */

/** Shown beside the machine, and not among the settings. */
const APART = 'program.dialect';

/**
 * @param {{ dialect: HTMLElement, more: HTMLElement }} roots
 * @param {{ onEdit: (path: string, value: any) => void }} callbacks
 */
export function createForm({ dialect, more }, { onEdit }) {
  /** @type {Map<string, Entry>} */
  let entries = new Map();
  let shown = '';

  /** @param {Field} field @param {string} path */
  function control(field, path) {
    const edit = (/** @type {any} */ value) => onEdit(path, value);
    if (field.type === 'choice') return choiceControl(path, (field.options ?? []).map(choice), edit);
    return field.type === 'boolean' ? booleanControl(path, edit) : numberControl(path, field, edit);
  }

  /** @param {Group} group @param {Field} field */
  function fieldRow(group, field) {
    const path = `${group.path}.${field.name}`;
    const id = `machine-${path}`;
    const input = control(field, path);
    input.id = id;
    const help = has(`help.${path}`) ? h('p', { class: 'help', id: `${id}-help` }, t(`help.${path}`)) : null;
    const message = h('p', { class: 'message', id: `${id}-message`, 'aria-live': 'polite' });
    input.setAttribute('aria-describedby', `${help ? `${help.id} ` : ''}${message.id}`);
    const unit = field.unit
      ? h('span', { class: 'unit' }, field.unit === '1/min' ? 'rpm' : field.unit)
      : null;
    const row = h(
      'div',
      { class: `field ${field.type}`, 'data-field': path },
      h('label', { for: id }, t(`field.${path}`, {}, prettify(field.name))),
      h('span', { class: 'value' }, input, unit),
      help,
      message,
    );
    entries.set(path, { input, row, message, field });
    return row;
  }

  return {
    /** @param {State} state */
    update({ schema, options, problem }) {
      if (!schema) return;
      const list = (/** @type {Group} */ group) => fieldsOf(group, options);
      const key = schema.groups.flatMap((group) => list(group).map(({ name }) => name)).join(' ');
      if (key !== shown) {
        shown = key;
        entries = new Map();
        const focused = /** @type {HTMLInputElement | null} */ (document.activeElement)?.name;
        const rows = schema.groups.map((group) => list(group).map((field) => fieldRow(group, field)));
        const isApart = (/** @type {HTMLElement} */ row) => row.dataset.field === APART;
        const sections = schema.groups.map((group, k) => {
          const title = h('h3', {}, t(`group.${group.path}`, {}, prettify(group.path)));
          return h('div', { class: 'group' }, title, ...rows[k].filter((row) => !isApart(row)));
        });
        dialect.replaceChildren(...rows.flat().filter(isApart));
        more.replaceChildren(...sections);
        const again = focused ? document.getElementById(`machine-${focused}`) : null;
        again?.focus();
      }
      for (const [path, { input, row, message, field }] of entries) {
        const value = read(options, path);
        if (input instanceof HTMLInputElement && input.type === 'checkbox') input.checked = value === true;
        else if (input instanceof HTMLInputElement) {
          const typed = Number.isNaN(input.valueAsNumber) ? null : input.valueAsNumber;
          if (typed !== (value ?? null)) input.value = String(value ?? '');
        } else if (input.value !== String(value)) input.value = String(value);
        const text = faultText(field, value) || (problem?.field === path ? problem.message : '');
        say(message, text);
        row.classList.toggle('wrong', text !== '');
        attribute(input, 'aria-invalid', text === '' ? null : 'true');
      }
    },
  };
}

/** An option and what a person reads. @param {string} option @returns {[string, string]} */
function choice(option) {
  return [option, t(`choice.${option}`, {}, prettify(option))];
}

/** What is wrong with a value, in words; '' if nothing. @param {Field} field @param {any} value */
function faultText(field, value) {
  const code = fault(field, value);
  if (!code) return '';
  const bound = (/** @type {number | undefined} */ at) =>
    at === undefined ? '' : `${plain(at)} ${field.unit ?? ''}`.trim();
  return t(`fault.${code}`, { min: bound(field.min), max: bound(field.max) });
}
