/** Jobs of the lessons. */

/**
 * One contact: the cutter by its centre circle and its corner, mm.
 *
 * @param {number} center @param {number} corner @param {number} scallop mm
 */
export const contactJob = (center, corner, scallop) => ({
  version: 1,
  name: 'Plane',
  source: { kind: 'plane', size_mm: [60, 40] },
  cutter: { kind: 'bull_nose', diameter_mm: 2 * (center + corner), corner_radius_mm: corner, height_mm: 60 },
  strategy: { kind: 'iso_parametric', along: 'u', rule: 'fixed', lead_deg: 8 },
  tolerance: { scallop_mm: scallop, chord_mm: Math.min(0.001, scallop / 10) },
});

/** Rows of a table: at most about this many of a long list, both ends among them. @param {number} length @param {number} most */
export const some = (length, most) => {
  const step = Math.max(1, Math.ceil((length - 1) / most));
  const list = [];
  for (let i = 0; i < length - 1; i += step) list.push(i);
  return length > 0 ? [...list, length - 1] : [];
};

/** @param {number | null | undefined} value @param {number} [digits] */
export const cell = (value, digits = 3) =>
  value === null || value === undefined ? '–' : value.toFixed(digits);
