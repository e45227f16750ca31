/**
 * The settings, made from the schema that the planner exports.
 *
 * @import { State, Schema, Group, Field, Spec } from './types.js'
 */
import { plain } from './format.js';
import { chosen, fault, fieldsOf, fitting, pointsOf, pointsText, read, shapeOf } from './spec.js';
import { has, prettify, t } from './text/index.js';
import { shownIn } from './units.js';
import { booleanControl, choiceControl, numberControl } from './view/controls.js';
import { createCutterSketch } from './view/cutter-sketch.js';
import { attribute, h, icon, say } from './view/dom.js';

/** Groups that are open at first: what most people set. */
const OPEN = new Set(['cutter', 'strategy', 'tolerance']);

/**
 * @typedef {HTMLInputElement | HTMLSelectElement | HTMLTextAreaElement} Control
 * @typedef {{ input: Control, row: HTMLElement, message: HTMLElement,
 *   field: Field }} Entry
 */

/**
 * @param {HTMLElement} root
 * @param {{ onEdit: (path: string, value: any) => void, onVariant: (group: Group, kind: string) => void,
 *   onChart: () => void, onPicking: (path: string) => void }} callbacks
 */
export function createForm(root, { onEdit, onVariant, onChart, onPicking }) {
  /** @type {Map<string, Entry>} */
  let entries = new Map();
  /** @type {Map<string, { body: HTMLElement, summary: HTMLElement, select: HTMLSelectElement | null }>} */
  const groups = new Map();
  const sketch = createCutterSketch();
  const chart = h(
    'button',
    { type: 'button', class: 'small', name: 'chart', onclick: onChart },
    icon('chart'),
    t('chart.open'),
  );
  let built = '';
  /** On a phone the groups are folded: the result stands below them. */
  const isWide = matchMedia('(width >= 760px)').matches;

  /** @param {Schema} schema */
  function build(schema) {
    root.replaceChildren(
      ...schema.groups.map((group) => {
        const summary = h('span', { class: 'brief' });
        const body = h('div', { class: 'fields' });
        groups.set(group.id, { body, summary, select: null });
        const title = t(`group.${group.id}`, {}, prettify(group.id));
        return h(
          'details',
          { class: 'panel', open: OPEN.has(group.id) && isWide, 'data-group': group.id },
          h('summary', {}, h('h2', {}, title), summary),
          body,
        );
      }),
    );
  }

  /** @param {Schema} schema @param {Spec} spec @param {string} shape */
  function fillGroups(schema, spec, shape) {
    entries = new Map();
    for (const group of schema.groups) {
      const parts = groups.get(group.id);
      if (!parts) continue;
      const rows = fieldsOf(group, spec).map((field) => fieldRow(group, field));
      const variants = fitting(group, shape);
      parts.select = variants.length > 0 ? variantSelect(group, variants) : null;
      const picker = parts.select
        ? h(
            'label',
            { class: 'field wide' },
            h('span', {}, t(`kind.${group.path}`, {}, t('kind'))),
            parts.select,
          )
        : null;
      const picture = group.id === 'cutter' ? sketch.element : null;
      const more = group.id === 'strategy' ? chart : null;
      parts.body.replaceChildren(.../** @type {Node[]} */ ([picture, picker, ...rows, more].filter(Boolean)));
    }
  }

  /** @param {Group} group @param {{ kind: string }[]} variants */
  function variantSelect(group, variants) {
    const options = variants.map(({ kind }) =>
      h('option', { value: kind }, t(`kind.${group.path}.${kind}`, {}, prettify(kind))),
    );
    return h(
      'select',
      {
        name: `${group.path}.kind`,
        onchange: (/** @type {Event} */ event) =>
          onVariant(group, /** @type {HTMLSelectElement} */ (event.target).value),
      },
      ...options,
    );
  }

  /** @param {Group} group @param {Field} field */
  function fieldRow(group, field) {
    const path = `${group.path}.${field.name}`;
    const id = `field-${path}`;
    const input = control(field, path);
    input.id = id;
    const picker =
      field.type === 'points'
        ? h(
            'button',
            {
              type: 'button',
              class: 'small',
              name: 'pick',
              'data-pick': path,
              onclick: () => onPicking(path),
            },
            t('action.pick'),
          )
        : null;
    const message = h('p', { class: 'message', id: `${id}-message`, 'aria-live': 'polite' });
    const unit = field.unit ? h('span', { class: 'unit' }, unitText(field)) : null;
    const help = has(`help.${path}`) ? h('p', { class: 'help', id: `${id}-help` }, t(`help.${path}`)) : null;
    const row = h(
      'div',
      { class: `field ${field.type}`, 'data-field': path },
      h('label', { for: id }, t(`field.${path}`, {}, prettify(field.name))),
      h('span', { class: 'value' }, input, unit),
      picker,
      help,
      message,
    );
    input.setAttribute('aria-describedby', `${help ? `${help.id} ` : ''}${message.id}`);
    entries.set(path, { input, row, message, field });
    return row;
  }

  /** @param {Field} field @param {string} path @returns {Control} */
  function control(field, path) {
    if (field.type === 'choice') {
      return choiceControl(path, (field.options ?? []).map(choice), (value) => onEdit(path, value));
    }
    if (field.type === 'points') {
      const area = h('textarea', {
        name: path,
        rows: 5,
        spellcheck: 'false',
        autocomplete: 'off',
        oninput: () => onEdit(path, pointsOf(area.value)),
      });
      return area;
    }
    if (field.type === 'boolean') return booleanControl(path, (value) => onEdit(path, value));
    const isInteger = field.type === 'integer';
    const range = {
      step: shownIn(field.unit)[0] !== 1 ? 'any' : (field.step ?? (isInteger ? 1 : 'any')),
      min: shown(field, field.min),
      max: shown(field, field.max),
      isInteger,
    };
    return numberControl(path, range, (typed) => onEdit(path, stored(field, typed)));
  }

  /** @param {State} state @param {Spec} spec */
  function showValues(state, spec) {
    for (const [path, { input, row, message, field }] of entries) {
      const value = read(spec, path);
      if (input instanceof HTMLInputElement && input.type === 'checkbox') input.checked = value === true;
      else if (input instanceof HTMLTextAreaElement) {
        // What is being written is left as it is.
        if (pointsText(pointsOf(input.value)) !== pointsText(value ?? []))
          input.value = pointsText(value ?? []);
        const button = row.querySelector('button');
        if (button) attribute(button, 'aria-pressed', String(state.picking === path));
      } else if (input instanceof HTMLInputElement) {
        const typed = Number.isNaN(input.valueAsNumber) ? null : input.valueAsNumber;
        const wanted = shown(field, value);
        if (typed !== (wanted ?? null))
          input.value = wanted === null || wanted === undefined ? '' : String(wanted);
      } else input.value = String(value);
      const own = faultText(field, value);
      const told = state.problem?.field === path ? state.problem.message : '';
      const text = own || told;
      say(message, text);
      row.classList.toggle('wrong', text !== '');
      attribute(input, 'aria-invalid', text === '' ? null : 'true');
    }
  }

  return {
    /** @param {State} state */
    update(state) {
      if (!state.schema || !state.draft) return;
      const { schema } = state;
      const { spec } = state.draft;
      const shape = shapeOf(state.draft);
      if (groups.size === 0) build(schema);
      const names = (/** @type {Group} */ group) => fieldsOf(group, spec).map((field) => field.name);
      const kinds = `${shape} ${schema.groups.map((group) => [chosen(group, spec)?.kind, ...names(group)]).join(' ')}`;
      if (kinds !== built) {
        const focused = /** @type {HTMLSelectElement | null} */ (document.activeElement)?.name;
        fillGroups(schema, spec, shape);
        built = kinds;
        const again = focused ? root.querySelector(`[name="${focused}"]`) : null;
        if (again instanceof HTMLElement) again.focus();
      }
      for (const group of schema.groups) {
        const parts = groups.get(group.id);
        if (!parts) continue;
        const kind = chosen(group, spec)?.kind;
        if (parts.select && kind) parts.select.value = kind;
        say(parts.summary, brief(group, spec));
      }
      showValues(state, spec);
      sketch.update(spec.cutter, state.outline);
    },

    /** Puts the cursor into a field and shows it. @param {string} path */
    focus(path) {
      const entry = entries.get(path);
      if (!entry) return false;
      const panel = entry.row.closest('details');
      if (panel) panel.open = true;
      entry.row.scrollIntoView({ block: 'center' });
      entry.input.focus({ preventScroll: true });
      return true;
    },
  };
}

/** The unit that a field is shown in. @param {Field} field */
function unitText({ unit }) {
  const [, shown] = shownIn(unit);
  return t(`unit.${shown}`, {}, shown);
}

/** An option and what a person reads. @param {string} option @returns {[string, string]} */
function choice(option) {
  return [option, t(`choice.${option}`, {}, prettify(option))];
}

/** A field's value in the unit that is shown; what is no number stays as it is. @param {Field} field @param {any} value */
function shown({ unit }, value) {
  const [factor] = shownIn(unit);
  return typeof value === 'number' && factor !== 1 ? Number((value * factor).toPrecision(6)) : value;
}

/** What was typed, in the unit of the field; nothing if it is no number. @param {Field} field @param {number | null} typed */
function stored({ unit }, typed) {
  const [factor] = shownIn(unit);
  return typed === null || factor === 1 ? typed : Number((typed / factor).toPrecision(12));
}

/** What is wrong with a value, in words; '' if nothing. @param {Field} field @param {any} value */
function faultText(field, value) {
  const code = fault(field, value);
  if (!code) return '';
  const unit = field.unit ? ` ${unitText(field)}` : '';
  const bound = (/** @type {number | undefined} */ at) =>
    at === undefined ? '' : plain(shown(field, at)) + unit;
  return t(`fault.${code}`, { min: bound(field.min), max: bound(field.max) });
}

/** A group in a few words, for when it is folded. @param {Group} group @param {Spec} spec */
function brief(group, spec) {
  const kind = chosen(group, spec)?.kind;
  const words = kind ? [t(`kind.${group.path}.${kind}`, {}, prettify(kind))] : [];
  for (const field of fieldsOf(group, spec)) {
    const value = read(spec, `${group.path}.${field.name}`);
    if (words.length >= 2) break;
    if (typeof value === 'number' && Number.isFinite(value)) {
      const unit = field.unit ? ` ${unitText(field)}` : '';
      words.push(plain(shown(field, value)) + unit);
    } else if (typeof value === 'string' && kind === undefined) {
      words.push(t(`choice.${value}`, {}, prettify(value)));
    }
  }
  return words.join(' · ');
}
