/** A worker that holds a module: takes requests, tells of progress, answers. */

/** Messages to the page are no use faster than it draws. */
const PROGRESS_EVERY_MS = 30;

/** @typedef {(phase: string, fraction: number) => void} Progress */
/** @typedef {{ result: any, transfer: Transferable[] }} Answer */
/** @typedef {Record<string, (args: any[], progress: Progress) => Answer | Promise<Answer>>} Operations */

/**
 * The planner throws a text that holds `{code, message, field?}`; anything else is a fault of its own.
 *
 * @param {unknown} thrown
 */
function problem(thrown) {
  if (typeof thrown === 'string') {
    try {
      return JSON.parse(thrown);
    } catch {
      return { code: 'planner', message: thrown };
    }
  }
  return { code: 'trap', message: thrown instanceof Error ? thrown.message : String(thrown) };
}

/** @param {number} id @returns {Progress} */
function reporter(id) {
  let last = { time: -PROGRESS_EVERY_MS, phase: '' };
  return (phase, fraction) => {
    const time = performance.now();
    if (phase === last.phase && time - last.time < PROGRESS_EVERY_MS) return;
    last = { time, phase };
    postMessage({ id, type: 'progress', phase, fraction });
  };
}

/**
 * Answers the page's requests; the first message brings the module.
 *
 * @param {(module: { module_or_path: WebAssembly.Module }) => Promise<unknown>} init
 * @param {Operations} operations
 */
export function serve(init, operations) {
  /** @type {(module: WebAssembly.Module) => void} */
  let provide;
  /** The module arrives as a message, and requests may arrive before it. */
  const ready = new Promise((resolve) => {
    provide = resolve;
  }).then((module) => init({ module_or_path: /** @type {WebAssembly.Module} */ (module) }));
  /** @param {MessageEvent} event */
  globalThis.onmessage = async ({ data }) => {
    if (data.module) {
      provide(data.module);
      return;
    }
    const { id, op, args } = data;
    try {
      await ready;
      const { result, transfer } = await operations[op](args, reporter(id));
      postMessage({ id, type: 'done', result }, { transfer });
    } catch (thrown) {
      postMessage({ id, type: 'error', ...problem(thrown) });
    }
  };
}
