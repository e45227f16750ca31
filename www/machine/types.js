/**
 * The shapes that the page and the module of machines exchange. The module's own documentation is the authority.
 *
 * @typedef {{ matter: string, axis?: string, share?: number, degrees?: number, left?: number, unit?: string, lead?: number,
 *   needed?: number, first: number, last: number, text: string }} Note
 * @typedef {{ letter: string, unit: string, limits: number[] | null, speed: number, least: number, greatest: number }} Axis
 * Millimetres or degrees, and these a second.
 * @typedef {{ rpm: number, feed_mm_per_min: number | null, feed_per_tooth_mm: number | null, diameters_mm: number[],
 *   speeds_m_per_min: number[], least_diameter_mm: number, least_speed_m_per_min: number, least_lead_deg: number,
 *   clearing_lead_deg: number }} Cutting
 * @typedef {{ machine: string, tool_length_mm: number, blocks: number, turn_overs: number,
 *   seconds: { total: number, cut: number, link: number, rapid: number, shown: number },
 *   deviation: { tip_mm: number, axis_deg: number }, cutting: Cutting | null, axes: Axis[], notes: Note[] }} Report
 * @typedef {import('../types.js').Verified} Verified
 * @typedef {{ planned: Verified, posted: Verified, largest_change_mm: number, allowed_mm: number, samples: number }} Kept
 *
 * @typedef {{ body: number, part: string, corners: number[], faces: number[][] }} Solid
 * @typedef {{ solids: Solid[], labels: { letter: string, body: number, at: number[] }[], hull: number[],
 *   line: { body: number, points: number[] } }} Figure
 * @typedef {{ report: Report, figure: Figure, files: { program: Blob, back: Blob, report: Blob } }} Work
 * @typedef {{ seconds: number, positions: number[], bodies: Float32Array }} Moment
 *
 * @typedef {{ id: string, name: string, text: string }} Machine
 * @typedef {{ machines: Machine[], schema: import('../types.js').Schema | null, chosen: string, options: any,
 *   job: { op: string, phase: string, fraction: number } | null, problem: import('../types.js').Problem | null,
 *   work: Work | null, kept: Kept | null, madeOf: unknown, dialect: string, moment: Moment | null,
 *   outcome: import('../types.js').Outcome | null, planned: import('../types.js').Draft | null, at: number }} State
 * `madeOf` is the path (of an outcome) that `work` was made of; `dialect` what it is written in.
 */
export {};
