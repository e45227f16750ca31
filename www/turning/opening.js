/**
 * Opens what a person dropped or picked: a saved job, a table of heights, or a lathe's file.
 *
 * @import { State } from './types.js'
 */
import { bytes as size } from '../format.js';
import { PlannerError } from '../protocol.js';
import { inFile, nameOf } from './lathe.js';
import { t } from './text.js';

/** A table of some million heights. */
const LARGEST_FILE = 20e6;

/**
 * @param {ReturnType<import('../protocol.js').createPlanner>} planner
 * @param {() => State} read
 * @param {{ onSpec: (spec: any) => void, onLathe: (lathe: import('./types.js').Lathe) => void, onComplaint: (text: string) => void, onError: (error: unknown) => void }} callbacks
 */
export function createOpener(planner, read, { onSpec, onLathe, onComplaint, onError }) {
  /** @param {File[]} files */
  return async function open([file]) {
    if (!file) return;
    if (file.size > LARGEST_FILE) {
      const places = { name: file.name, size: size(file.size), limit: size(LARGEST_FILE) };
      onComplaint(t('error.too_big', places));
      return;
    }
    try {
      planner.cancel();
      if (file.name.toLowerCase().endsWith('.json')) {
        const text = await file.text();
        const name = nameOf(text);
        if (name === null) onSpec(await planner.call('complete', [text]));
        else {
          const spec = await planner.call('lathe', [read().draft, text]).catch((error) => {
            throw ofLathe(error);
          });
          onLathe({ name, text });
          onSpec(spec);
        }
        return;
      }
      const bytes = new Uint8Array(await file.arrayBuffer());
      const spec = await planner.call('table', [read().draft, bytes]);
      onSpec({ ...spec, name: file.name.replace(/\.[^.]*$/, '') });
    } catch (error) {
      onError(error);
    }
  };
}

/** What is wrong with a lathe's file has no field in the form, where its name might mean another. @param {unknown} error */
function ofLathe(error) {
  if (!(error instanceof PlannerError) || !error.field) return error;
  const { code, message, field } = error;
  return new PlannerError({ code, message: inFile(field, message) });
}
