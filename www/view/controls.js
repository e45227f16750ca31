/** What settings are edited with; each is named after its setting's path. */
import { h } from './dom.js';

/**
 * One of some options, each a value and what a person reads.
 *
 * @param {string} path @param {[string, string][]} options @param {(value: string) => void} onEdit
 */
export function choiceControl(path, options, onEdit) {
  const shown = options.map(([value, text]) => h('option', { value }, text));
  const select = h('select', { name: path, onchange: () => onEdit(select.value) }, ...shown);
  return select;
}

/** @param {string} path @param {(value: boolean) => void} onEdit */
export function booleanControl(path, onEdit) {
  const box = h('input', { type: 'checkbox', name: path, onchange: () => onEdit(box.checked) });
  return box;
}

/**
 * A number; null while what is typed is none. The step is for the arrow keys; values between the steps are as good.
 *
 * @param {string} path
 * @param {{ step?: number | string, min?: number, max?: number, isInteger?: boolean }} range
 * @param {(value: number | null) => void} onEdit
 */
export function numberControl(path, { step = 'any', min, max, isInteger = false }, onEdit) {
  const input = h('input', {
    type: 'number',
    name: path,
    step,
    min,
    max,
    inputmode: isInteger ? 'numeric' : 'decimal',
    autocomplete: 'off',
    oninput: () => onEdit(Number.isNaN(input.valueAsNumber) ? null : input.valueAsNumber),
  });
  return input;
}
