/**
 * Opens what a person dropped or picked: a surface file, a saved job, or both.
 *
 * @import { Draft, Source, Spec } from './types.js'
 */
import { bytes as size } from './format.js';
import { completed } from './spec.js';
import { t } from './text/index.js';

/** Larger files than this do not fit the planner's memory together with what is computed from them. */
export const LARGEST_FILE = 128e6;

/** The file that a job brought along. @param {{ name: unknown, base64: unknown }} inside */
function fileOf({ name, base64 }) {
  const text = atob(String(base64));
  return new File([Uint8Array.from(text, (letter) => letter.charCodeAt(0))], String(name));
}

/**
 * @param {ReturnType<import('./protocol.js').createPlanner>} planner
 * @param {ReturnType<import('./state.js').createState>} state
 * @param {{ onDraft: (draft: Draft) => void, onComplaint: (text: string) => void,
 *   onSurface: (name: string, bytes: Uint8Array) => void, onError: (error: unknown) => void }} callbacks
 */
export function createOpener(planner, state, { onDraft, onComplaint, onSurface, onError }) {
  /**
   * The job in a file, completed by the settings in force, and its surface's file if it brings that; `null` if it holds none.
   *
   * @param {File} file
   * @returns {Promise<{ job: Spec, surface: File | null } | null>}
   */
  async function readJob(file) {
    if (!file.name.toLowerCase().endsWith('.json')) return null;
    try {
      const { file: inside, ...spec } = JSON.parse(await file.text());
      const { schema, draft } = state.get();
      const known = typeof spec?.source?.kind === 'string' && spec.version === (schema?.version ?? 1);
      if (!known || !draft || !schema) return null;
      return { job: completed(schema, { ...draft.spec, ...spec }), surface: inside ? fileOf(inside) : null };
    } catch {
      return null;
    }
  }

  /** @param {Spec} spec @param {string} name */
  function openJob(spec, name) {
    const { draft } = state.get();
    if (spec.source.kind !== 'file') onDraft({ spec, source: { id: null, name, bytes: null, info: null } });
    else if (draft?.source.bytes && draft.source.name === spec.source.path)
      onDraft({ spec, source: draft.source });
    else onComplaint(t('error.job_file', { name: String(spec.source.path) }));
  }

  /** @param {File} file @param {Spec | null} job */
  async function openSurface(file, job) {
    const bytes = new Uint8Array(await file.arrayBuffer());
    planner.cancel();
    const info = await planner.call('inspect', [file.name, bytes]);
    const { draft } = state.get();
    if (!draft) return;
    if (info.faces.length === 0) {
      onComplaint(t('error.no_face', { name: file.name }));
      return;
    }
    const scale = info.faces[0].suggested_scale;
    // A factor of 1 goes without saying.
    const scaled = scale?.some((/** @type {number} */ factor) => factor !== 1) ? { scale } : {};
    const fresh = {
      kind: 'file',
      ...scaled,
      path: file.name,
      face: info.faces[0].index,
      unit: info.unit,
      side: 'front',
    };
    /** @type {Source} */
    const opened = { id: null, name: file.name, bytes, info };
    const spec = job ?? { ...draft.spec, name: file.name.replace(/\.[^.]*$/, '') };
    const from = job?.source.kind === 'file' ? { ...fresh, ...job.source, path: file.name } : fresh;
    onDraft({ spec: { ...spec, source: from }, source: opened });
    onSurface(file.name, bytes);
  }

  /** @param {File[]} files */
  return async function open(files) {
    const tooBig = files.find((file) => file.size > LARGEST_FILE);
    if (tooBig) {
      const places = { name: tooBig.name, size: size(tooBig.size), limit: size(LARGEST_FILE) };
      onComplaint(t('error.too_big', places));
      return;
    }
    state.set({ problem: null });
    try {
      const jobs = await Promise.all(files.map(readJob));
      const found = jobs.find((one) => one !== null) ?? null;
      // Whatever is no job is a surface: the planner says if it is not.
      const surface = files.find((_, i) => jobs[i] === null) ?? found?.surface;
      if (surface) await openSurface(surface, found?.job ?? null);
      else if (found) openJob(found.job, files[jobs.indexOf(found)].name);
    } catch (error) {
      onError(error);
    }
  };
}
