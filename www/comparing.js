/**
 * Runs: what was planned in this visit, and all strategies that apply to a job side by side.
 *
 * @import { Draft, Outcome, Run, State } from './types.js'
 */
import { PlannerError } from './protocol.js';
import { completed } from './spec.js';

/** Runs that are kept, and points of all their paths: these take 44 bytes each. The oldest goes first, unless it is laid over the picture. */
const MOST_RUNS = 24;
const MOST_POINTS = 4e6;
/** What is no answer of the planner. */
const BROKEN = new Set(['trap', 'worker', 'compile']);
/** Share of a strategy's progress that planning has. */
const PLANNING = 0.6;

/**
 * @param {ReturnType<import('./state.js').createState>} state
 * @param {{ onError: (error: unknown) => void }} callbacks
 */
export function createComparing(state, { onError }) {
  /** @type {ReturnType<import('./protocol.js').createPlanner> | null} */
  let planner = null;
  let lastId = 0;

  /** @param {Draft} draft @param {Pick<Outcome, 'report' | 'contacts' | 'path'>} outcome @param {number | null} floor mm */
  function add(draft, { report, contacts, path }, floor) {
    lastId += 1;
    const { runs } = state.get();
    const before = runs.find(({ draft: other }) => isSame(other, draft));
    /** @type {Run} */
    const run = { id: lastId, draft, report, contacts, path, floor, isLaid: before?.isLaid ?? false };
    const kept = runs.filter((other) => other !== before);
    const points = () => kept.reduce((sum, other) => sum + other.report.points, report.points);
    while (kept.length > 0 && (kept.length >= MOST_RUNS || points() > MOST_POINTS)) {
      kept.splice(
        Math.max(
          kept.findIndex(({ isLaid }) => !isLaid),
          0,
        ),
        1,
      );
    }
    state.set({ runs: [...kept, run] });
  }

  /** @param {Draft} draft @param {(part: { name: string, fraction: number }) => void} tell */
  async function runAll(draft, tell) {
    if (!planner) {
      const { createStudyPlanner } = await import('./study/planner.js');
      // Two may have waited for it.
      planner ??= createStudyPlanner('comparison');
    }
    const { bytes } = draft.source;
    const floor = await planner.call('floor', [draft.spec, bytes], (_, fraction) =>
      tell({ name: 'floor', fraction: 0.05 * fraction }),
    );
    const runs = state.get().runs.map((run) => (isAlike(run.draft, draft) ? { ...run, floor } : run));
    state.set({ runs });
    /** @type {{ name: string, spec: import('./types.js').Spec }[]} */
    const contenders = await planner.call('contenders', [draft.spec, bytes]);
    for (const [k, { name, spec }] of contenders.entries()) {
      const at = (/** @type {number} */ share) => 0.05 + (0.95 * (k + share)) / contenders.length;
      try {
        const planned = await planner.call('plan', [spec, bytes], (_, fraction) =>
          tell({ name, fraction: at(PLANNING * fraction) }),
        );
        const { report } = await planner.call('prove', [], (_, fraction) =>
          tell({ name, fraction: at(PLANNING + (1 - PLANNING) * fraction) }),
        );
        const { schema } = state.get();
        // Spelled out like the job of the form, with which it may be one.
        const whole = schema ? completed(schema, spec) : spec;
        add(
          { spec: { ...whole, source: draft.spec.source }, source: draft.source },
          { ...planned, report },
          floor,
        );
      } catch (error) {
        // One strategy that cannot be planned is no reason to stop; a planner that broke down is.
        if (!(error instanceof PlannerError) || BROKEN.has(error.code)) throw error;
        state.set({ unfit: [...state.get().unfit, { name, message: error.message }] });
      }
    }
  }

  return {
    /** Keeps what was planned and proven. @param {Draft} draft @param {Outcome} outcome */
    keep(draft, outcome) {
      const floor = state.get().runs.find((run) => isAlike(run.draft, draft))?.floor ?? null;
      add(draft, outcome, floor);
    },

    async run() {
      const { draft } = state.get();
      if (!draft || (draft.spec.source.kind === 'file' && !draft.source.bytes)) return;
      state.set({ comparison: { name: '', fraction: 0 }, unfit: [] });
      try {
        await runAll(draft, (part) => state.get().comparison && state.set({ comparison: part }));
      } catch (error) {
        onError(error);
      } finally {
        state.set({ comparison: null });
      }
    },

    cancel() {
      state.set({ comparison: null });
      planner?.cancel();
    },

    /** @param {number} id */
    lay(id) {
      const runs = state.get().runs.map((run) => (run.id === id ? { ...run, isLaid: !run.isLaid } : run));
      state.set({ runs });
    },

    clear: () => state.set({ runs: [], unfit: [] }),
  };
}

/** @param {Draft} a @param {Draft} b */
const isSame = (a, b) => a.source.bytes === b.source.bytes && ordered(a.spec) === ordered(b.spec);

/** A spec as a text that does not depend on the order of its settings, without its name. @param {any} spec */
function ordered({ name: _, ...spec }) {
  const sorted = (/** @type {string} */ _key, /** @type {any} */ value) =>
    value && typeof value === 'object' && !Array.isArray(value)
      ? Object.fromEntries(Object.entries(value).sort(([a], [b]) => (a < b ? -1 : 1)))
      : value;
  return JSON.stringify(spec, sorted);
}

/** Whether the same floor holds for both: all but the way in which passes are laid is the same. @param {Draft} a @param {Draft} b */
function isAlike(a, b) {
  const shared = (/** @type {Draft} */ { spec }) => {
    const { rule, lead_deg, yaw_deg, least_lead_deg, most_lead_deg, most_yaw_deg } = spec.strategy;
    const posture = [rule, lead_deg, yaw_deg, least_lead_deg, most_lead_deg, most_yaw_deg];
    return ordered({ source: spec.source, cutter: spec.cutter, tolerance: spec.tolerance, posture });
  };
  return a.source.bytes === b.source.bytes && shared(a) === shared(b);
}

/** Runs of the surface that is on show. @param {State} state */
export const runsOf = ({ runs, draft }) =>
  runs.filter(
    (run) =>
      run.draft.source.bytes === draft?.source.bytes &&
      JSON.stringify(run.draft.spec.source) === JSON.stringify(draft?.spec.source),
  );
