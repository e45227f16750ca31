/**
 * Opens what a person dropped or picked: a saved job, or a table of heights.
 *
 * @import { State } from './types.js'
 */
import { bytes as size } from '../format.js';
import { t } from './text.js';

/** A table of some million heights. */
const LARGEST_FILE = 20e6;

/**
 * @param {ReturnType<import('../protocol.js').createPlanner>} planner
 * @param {() => State} read
 * @param {{ onSpec: (spec: any) => void, onComplaint: (text: string) => void, onError: (error: unknown) => void }} callbacks
 */
export function createOpener(planner, read, { onSpec, onComplaint, onError }) {
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
        onSpec(await planner.call('complete', [await file.text()]));
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
