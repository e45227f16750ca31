/** @import { Schema, Group, Variant, Field, Spec, Draft, Problem } from './types.js' */

/**
 * The value at a dotted path, `undefined` where there is none.
 *
 * @param {any} object
 * @param {string} path
 */
export function read(object, path) {
  return path.split('.').reduce((value, key) => value?.[key], object);
}

/**
 * A copy of `object` with `value` at a dotted path; what is not on the path is shared.
 *
 * @template T
 * @param {T} object
 * @param {string} path
 * @param {any} value
 * @returns {T}
 */
export function write(object, path, value) {
  const [key, ...rest] = path.split('.');
  const inner =
    rest.length === 0 ? value : write(/** @type {any} */ (object)?.[key] ?? {}, rest.join('.'), value);
  return { .../** @type {any} */ (object), [key]: inner };
}

/**
 * The variant that a spec has chosen in a group.
 *
 * @param {Group} group
 * @param {Spec} spec
 * @returns {Variant | undefined}
 */
export function chosen(group, spec) {
  const kind = read(spec, group.path)?.kind;
  return group.variants?.find((variant) => variant.kind === kind);
}

/**
 * The fields that count in a group of a spec, in the order in which they are shown.
 *
 * @param {Group} group
 * @param {Spec} spec
 * @returns {Field[]}
 */
export function fieldsOf(group, spec) {
  const values = read(spec, group.path) ?? {};
  return [...(chosen(group, spec)?.fields ?? []), ...(group.fields ?? [])].filter(
    ({ when }) => !when || when.is.includes(values[when.field]),
  );
}

/**
 * The variants that fit the shape at hand.
 *
 * @param {Group} group
 * @param {string} shape 'surface' or 'mesh'
 */
export function fitting(group, shape) {
  return (group.variants ?? []).filter(({ for: shapes }) => !shapes?.length || shapes.includes(shape));
}

/**
 * The spec with another variant of a group: values of the same name stay, the others are defaults.
 *
 * @param {Spec} spec
 * @param {Group} group
 * @param {string} kind
 */
export function withVariant(spec, group, kind) {
  const before = read(spec, group.path) ?? {};
  const variant = group.variants?.find((v) => v.kind === kind);
  /** @type {Record<string, any>} */
  const after = { kind };
  for (const field of [...(variant?.fields ?? []), ...(group.fields ?? [])]) {
    after[field.name] = field.name in before ? before[field.name] : field.default;
  }
  return write(spec, group.path, after);
}

/**
 * The spec with what it leaves out: it may be of a planner that had fewer fields, or written by hand.
 *
 * @param {Schema} schema
 * @param {Spec} spec
 */
export function completed(schema, spec) {
  for (const group of schema.groups) {
    const kind = chosen(group, spec)?.kind;
    if (kind) spec = withVariant(spec, group, kind);
    const given = read(spec, group.path);
    const left = (group.variants?.length ? [] : (group.fields ?? [])).filter(
      ({ name }) => !(name in (given ?? {})),
    );
    for (const field of left) spec = write(spec, `${group.path}.${field.name}`, field.default);
  }
  return spec;
}

/**
 * What kind of shape a draft cuts: 'surface' or 'mesh'.
 *
 * @param {Draft} draft
 */
export function shapeOf(draft) {
  const faces = draft.source.info?.faces;
  return faces?.find((face) => face.index === draft.spec.source.face)?.kind ?? faces?.[0]?.kind ?? 'surface';
}

/**
 * The draft with a strategy that fits its shape: the one it has, or else the first that does.
 *
 * @param {Schema} schema
 * @param {Draft} draft
 * @returns {Draft}
 */
export function withFittingVariants(schema, draft) {
  const shape = shapeOf(draft);
  let spec = draft.spec;
  for (const group of schema.groups) {
    const fit = fitting(group, shape);
    const kind = read(spec, group.path)?.kind;
    if (fit.length > 0 && !fit.some((variant) => variant.kind === kind)) {
      // What needs another module is for whoever asks for it.
      spec = withVariant(spec, group, (fit.find(({ second }) => !second) ?? fit[0]).kind);
    }
  }
  return spec === draft.spec ? draft : { ...draft, spec };
}

/**
 * The first field whose value is wrong.
 *
 * @param {Schema} schema
 * @param {any} spec
 * @param {(field: Field, value: any) => string | null} [faultOf]
 * @returns {Problem | null}
 */
export function firstFault(schema, spec, faultOf = fault) {
  for (const group of schema.groups) {
    for (const field of fieldsOf(group, spec)) {
      const path = `${group.path}.${field.name}`;
      const code = faultOf(field, read(spec, path));
      if (code) return { code, message: '', field: path };
    }
  }
  return null;
}

/**
 * The first field whose value is none or out of its range, as the planner would name it.
 *
 * @param {Schema} schema
 * @param {Draft} draft
 * @returns {Problem | null}
 */
export function firstProblem(schema, draft) {
  const wrong = firstFault(schema, draft.spec);
  if (wrong) return wrong;
  const { info } = draft.source;
  if (info && info.unit === null && !draft.spec.source.unit) {
    return { code: 'unit', message: '', field: 'source.unit' };
  }
  return null;
}

/**
 * What is wrong with a field's value: 'missing', 'low', 'high', 'points', or nothing.
 *
 * @param {Field} field
 * @param {any} value
 */
export function fault(field, value) {
  if (value === null || value === undefined)
    return field.optional || field.default === null ? null : 'missing';
  if (field.type === 'points') {
    const isPoint = (/** @type {any[]} */ point) => point.length === 3 && point.every(Number.isFinite);
    return !Array.isArray(value) || value.length < 2 || !value.every(isPoint) ? 'points' : null;
  }
  if (typeof value !== 'number') return null;
  if (!Number.isFinite(value)) return 'missing';
  if (field.min !== undefined && field.min !== null && value < field.min) return 'low';
  if (field.max !== undefined && field.max !== null && value > field.max) return 'high';
  return null;
}

/**
 * The points that are written one a line, coordinates apart by commas or spaces; what is no number stays one that is none.
 *
 * @param {string} text
 * @returns {number[][]}
 */
export function pointsOf(text) {
  const lines = text.split('\n').map((line) => line.trim());
  return lines.filter((line) => line !== '').map((line) => line.split(/[\s,;]+/).map(Number));
}

/** Points as they are written. @param {number[][]} points */
export const pointsText = (points) => points.map((point) => point.join(', ')).join('\n');
