/**
 * The shapes that the turning page exchanges with the planner. The planner's own documentation is the authority.
 *
 * @import { Schema, Problem } from '../types.js'
 *
 * @typedef {{ mm: number, x_mm: number, y_mm: number }} Place
 * @typedef {{ value: number, limit: number, x_mm: number, c_deg: number }} Asked
 * @typedef {{ velocity: Asked, acceleration: Asked, jerk: Asked }} Axis
 * @typedef {{ body: string, residue: Place | null, overcut: Place | null, peak_to_valley_mm: number, mean_mm: number,
 *   rms_mm: number, bands: { limit_mm: number, within: number, over: number, under: number }[], uncut: number,
 *   samples: number, sagittas: { direction_deg: number, chord_mm: number, nominal_mm: number, cut_mm: number }[],
 *   sagittas_pass: boolean, chord_left: Place | null, chord_dug: Place | null }} Verified
 * @typedef {{ name: string, points: number, turns: number, step_mm: number, angle_deg: number | null,
 *   arc_mm: number | null, interpolation: string, innermost_mm: number, outermost_mm: number, farthest_mm: number, cusp: Place,
 *   chord_left: Place, chord_dug: Place, effective_deg: number[] | null, time_s: number, rim_rpm: number, highest_rpm: number, x: Axis, z: Axis,
 *   c: Axis, strictest: string | null, reserve: number | null, verified: Verified | null,
 *   warnings: string[] }} Report
 *
 * @typedef {{ values: Float32Array, rays: number, rings: number }} RayMap Numbers ray by ray from the axis outwards.
 * @typedef {{ report: Report, farthest: number, heights: RayMap, touches: Float32Array, turns: Float32Array,
 *   residues: RayMap | null, extension: string,
 *   files: { program: Blob, csv: Blob, turns: Blob, apt: Blob, report: Blob } }} Outcome
 * `touches` has x, y, z a point. `turns` has 14 numbers a turn: distance from the axis (mm), speed (1/min), then for X, Z and C the
 * stroke and the largest velocity, acceleration and jerk; mm, degrees and seconds.
 *
 * @typedef {{ name: string, text: string }} Lathe A machine's file.
 * @typedef {'x' | 'z' | 'c'} AxisName
 * @typedef {{ guide: string, points: string, report: Report }} Compared
 * @typedef {{ schema: Schema | null, draft: any, canUndo: boolean, canRedo: boolean, outcome: Outcome | null, planned: any,
 *   motion: Float32Array | null, radius: number, axis: AxisName, job: { op: string, phase: string, fraction: number } | null,
 *   problem: Problem | null, view: 'map' | 'lens', path: boolean, range: 'own' | 'fine' | 'wide', compared: Compared[],
 *   dragging: boolean, lathe: Lathe | null }} State
 * `draft` is the specification that is edited, `planned` the one that `outcome` belongs to. `motion` has 13 numbers a point of one
 * turn: angle (degrees), then position, velocity, acceleration and jerk of X, Z and C.
 */
export {};
