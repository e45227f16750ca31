/** Holds the module of machines: the only file that knows its functions. */
import init, * as machines from '../wasm/machines.js';

/** Messages to the page are no use faster than it draws. */
const PROGRESS_EVERY_MS = 30;

/** @type {(module: WebAssembly.Module) => void} */
let provide;
/** The module arrives as a message, and requests may arrive before it. */
const ready = new Promise((resolve) => {
  provide = resolve;
}).then((module) => init({ module_or_path: /** @type {WebAssembly.Module} */ (module) }));

/** @typedef {(phase: string, fraction: number) => void} Progress */

/** What was written last, for its proof, its plots and its motion. @type {machines.MachineWork | null} */
let current = null;

/** @type {Record<string, (args: any[], progress: Progress) => any>} */
const operations = {
  start: () => ({
    schema: JSON.parse(machines.machine_schema()),
    machines: JSON.parse(machines.machine_shipped()),
  }),

  name: ([text]) => machines.machine_name(text),

  async post([apt, csv, machine, options], progress) {
    const [path, table] = await Promise.all([apt.text(), csv.text()]);
    current?.free();
    current = null;
    const work = machines.machine_post(path, table, machine, JSON.stringify(options), progress);
    current = work;
    const report = work.report();
    // As blobs the texts stay out of the page's memory until somebody saves them.
    const files = {
      program: new Blob([work.text()], { type: 'text/plain' }),
      back: new Blob([work.read_back()], { type: 'text/plain' }),
      report: new Blob([report], { type: 'application/json' }),
    };
    return { report: JSON.parse(report), figure: JSON.parse(work.figure()), files };
  },

  prove([spec, bytes], progress) {
    if (!current) throw new Error('nothing is written');
    return JSON.parse(current.prove(JSON.stringify(spec), bytes ?? undefined, progress));
  },

  /** The moment at a share of the path's length. */
  moment([share]) {
    if (!current) return null;
    const [seconds, ...positions] = current.at_share(share);
    return { seconds, positions, bodies: current.bodies(share) };
  },

  /** The share of the path's length at a time. */
  share: ([seconds]) => current?.share_at(seconds) ?? 0,

  /** What each of the axes does in columns of equal time. */
  bands([axes, speeds, from, to, columns]) {
    const work = current;
    return work ? axes.map((/** @type {number} */ k) => work.band(k, speeds, from, to, columns)) : [];
  },
};

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

/** @param {MessageEvent} event */
globalThis.onmessage = async ({ data }) => {
  if (data.module) {
    provide(data.module);
    return;
  }
  const { id, op, args } = data;
  try {
    await ready;
    postMessage({ id, type: 'done', result: await operations[op](args, reporter(id)) });
  } catch (thrown) {
    postMessage({ id, type: 'error', ...problem(thrown) });
  }
};
