/**
 * The shapes that page, worker and planner exchange. The planner's own documentation is the authority.
 *
 * @typedef {{ name: string, type: 'number' | 'integer' | 'boolean' | 'choice' | 'points', unit?: string, min?: number,
 *   max?: number, step?: number, default: any, options?: string[], optional?: boolean,
 *   when?: { field: string, is: string[] } }} Field
 * A field counts only `when` the choice beside it is one of these words. The value of `points` is a list of `[x, y, z]`, mm.
 * @typedef {{ kind: string, fields: Field[], for?: string[], second?: boolean }} Variant
 * A `second` variant is planned by the page's second module.
 * @typedef {{ id: string, path: string, variants?: Variant[], fields?: Field[] }} Group
 * @typedef {{ version: number, groups: Group[] }} Schema
 *
 * @typedef {{ version: number, name: string, source: any, [group: string]: any }} Spec
 * @typedef {{ id: string, spec: Spec }} GalleryItem
 * @typedef {{ index: number, name: string, kind: string, detail?: string, suggested_scale?: number[],
 *   bounds_mm: [number[], number[]] }} Face
 * @typedef {{ format: string, unit: string | null, warnings: string[], faces: Face[] }} Inspection
 *
 * @typedef {{ positions: Float32Array, normals: Float32Array, indices: Uint32Array }} Picture
 * Positions in millimetres, three numbers a vertex.
 *
 * @typedef {{ version: number, name: string, strategy: string,
 *   length: { cut_mm: number, link_mm: number, rapid_mm: number }, passes: number, points: number,
 *   time_min: number, area_mm2: number,
 *   unreachable: { area_mm2: number, cell_mm: number, unseen_mm2: number },
 *   verified: Verified | null, scallop_mm: number, warnings: string[] }} Report
 * @typedef {{ largest_excess_mm: number | null, largest_excess_at: number[] | null,
 *   largest_gouge_mm: number | null, largest_gouge_at: number[] | null, sampling_error_mm: number | null,
 *   median_mm: number | null, q95_mm: number | null, q99_mm: number | null, share_within: number,
 *   uncut_area_mm2: number, samples: number, excluded_area_mm2: number,
 *   excluded_gouge_mm: number }} Verified
 * A gouge is 0 or negative; what is `null` has no bound, or was not cut.
 *
 * @typedef {{ report: Report, seconds: number, proofSeconds: number | null, path: Float32Array,
 *   contacts: Float32Array, postures: Float32Array, zones: Float32Array, zoneEdge: number, outline: Float32Array, picture: Picture | null, excess: Float32Array | null, histogram?: Float32Array | null,
 *   files: { apt: Blob, nc: Blob | null, csv: Blob, report: Blob } | null, isPreview?: boolean }} Outcome
 * A preview came by link: it has no files, tips at the contacts, and a path that is simplified.
 * `path` has eight numbers a point: tip x, y, z, axis i, j, k, kind (0 cut, 1 link, 2 rapid), length so far.
 * `contacts` has three: where the cutter touches, or the tip on links. `postures` has four: lead and yaw in degrees, the width of
 * the strip in millimetres, and the number of what keeps the lead from being less; not numbers where it touches nothing. `excess` has one a vertex of the picture; both come with
 * the proof. `zones` has the middles of cubes with edges of `zoneEdge` millimetres. `outline` has the cutter's radius and height a point.
 *
 * @typedef {{ radius_mm: number | null, tilt_deg: number[], circle_mm: (number | null)[], lead_mm: (number | null)[],
 *   lateral_mm: (number | null)[], two_contact_mm: (number | null)[], matching_deg: number | null,
 *   widest: { lead_deg: number, lift_mm: number, stepover_mm: number } | null }} StepoverCurves
 * @typedef {{ scallop_mm: number, curves: StepoverCurves[] }} Stepovers
 * Stepover against tilt, for the chosen radius of the surface and for a plane; `null` where there is none.
 *
 * @typedef {{ isOpen: boolean, radius: number, stepovers: Stepovers | null, hasFailed: boolean }} Chart
 * The radius is in millimetres, above 0 for a hollow, below 0 for a ridge, 0 for a plane.
 *
 * @typedef {{ code: string, message: string, field?: string }} Problem
 * @typedef {{ id: string | null, name: string, bytes: Uint8Array | null, info: Inspection | null }} Source
 * What is to be cut: an item of the gallery (`id`) or a file (`bytes`).
 *
 * @typedef {{ spec: Spec, source: Source }} Draft
 * Everything that a person edits, and what undo goes back to.
 *
 * @typedef {{ id: number, draft: Draft, report: Report, contacts: Float32Array, path: Float32Array, floor: number | null,
 *   isLaid: boolean }} Run
 * A path that was planned and proven in this visit; `floor` is the length that no path of its postures stays below, mm.
 *
 * @typedef {{ u: number, v: number, least_curvature: number | null, most_curvature: number | null,
 *   point: number[], excess: number | null }} Picked A place that somebody clicked.
 * @typedef {{ outcome: Outcome, steps: Uint32Array, vertices: Uint32Array, excess: Float32Array }} Removal
 * What the path cuts when: the move, the vertex of the proof's picture and what is left there from then on.
 *
 * @typedef {{ op: string, phase: string, fraction: number, draft: Draft }} Job
 * @typedef {{ passes: boolean, links: boolean, rapids: boolean, tint: TintName, zones: boolean, side: boolean,
 *   cutter: boolean }} Layers
 * @typedef {'none' | 'excess' | 'gouge' | 'lead' | 'yaw' | 'strip' | 'feed' | 'pass'} TintName
 * @typedef {{ values: Float32Array, low: number, high: number, color: (value: number) => number[] }} Tint
 * A number for each vertex of the picture, and sRGB for numbers, of which `low` is −1 and `high` 1.
 * @typedef {{ schema: Schema | null, gallery: GalleryItem[], draft: Draft | null, canUndo: boolean,
 *   canRedo: boolean, picture: Picture | null, outline: Float32Array | null, faces: Map<number, Picture>, outcome: Outcome | null, planned: Draft | null,
 *   job: Job | null, problem: Problem | null, chart: Chart, layers: Layers, at: number, dragging: boolean,
 *   picking: string | null, runs: Run[], comparison: { name: string, fraction: number } | null,
 *   unfit: { name: string, message: string }[], removal: Removal | null,
 *   removing: number | null, picked: Picked | null, range: [number, number] | null, isFlat: boolean,
 *   recent: { name: string, size: number }[], domain: import('./study/study.js').DomainPicture | null }} State
 * `unfit` are the strategies that the comparison could not plan; `removing` is how far the search for what is cut when has come; `range` is the part of the colours' scale that is spread over all of
 * them; `isFlat` tells that the domain of the parameters is on show.
 * `picking` is the path of the field to which clicks on the surface append points. `planned` is the draft that `outcome` belongs to; `at` is the share of the path that is shown, 0 to 1; `faces` are the
 * pictures of a file's faces as far as they are made.
 */
export {};
