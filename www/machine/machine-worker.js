/** Holds the module of machines: the only file that knows its functions. */
import { serve } from '../serving.js';
import init, * as machines from '../wasm/machines.js';

/** What was written last, for its proof, its plots and its motion. @type {machines.MachineWork | null} */
let current = null;

/** @param {any} result */
const plain = (result) => ({ result, transfer: [] });

serve(init, {
  start: () =>
    plain({
      schema: JSON.parse(machines.machine_schema()),
      machines: JSON.parse(machines.machine_shipped()),
    }),

  name: ([text]) => plain(machines.machine_name(text)),

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
    return plain({ report: JSON.parse(report), figure: JSON.parse(work.figure()), files });
  },

  prove([spec, bytes], progress) {
    if (!current) throw new Error('nothing is written');
    return plain(JSON.parse(current.prove(JSON.stringify(spec), bytes ?? undefined, progress)));
  },

  /** The moment at a share of the path's length. */
  moment([share]) {
    if (!current) return plain(null);
    const [seconds, ...positions] = current.at_share(share);
    return plain({ seconds, positions, bodies: current.bodies(share) });
  },

  /** The share of the path's length at a time. */
  share: ([seconds]) => plain(current?.share_at(seconds) ?? 0),

  /** What each of the axes does in columns of equal time. */
  bands([axes, speeds, from, to, columns]) {
    const work = current;
    const band = (/** @type {number} */ axis) => work?.band(axis, speeds, from, to, columns);
    return plain(work ? axes.map(band) : []);
  },
});
