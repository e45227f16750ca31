/** The planner that knows more; whoever asks first loads it. */
import { compile } from '../compiling.js';
import { createPlanner } from '../protocol.js';
import address from '../wasm/study_bg.wasm?url';

/** A planner with a worker of its own, so that it can be stopped by itself. @param {string} name */
export const createStudyPlanner = (name) =>
  createPlanner(
    () => compiled(),
    () => new Worker(new URL('./worker.js', import.meta.url), { type: 'module', name }),
  );

/** @type {Promise<WebAssembly.Module> | null} */
let module = null;

/** Compiled once, however many workers hold it. */
function compiled() {
  module ??= compile(address);
  // Whoever asks again after a broken line shall get it then.
  module.catch(() => {
    module = null;
  });
  return module;
}
