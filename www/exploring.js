/**
 * Looking closely at what was planned: what is cut when, what is at a place, the passes over the parameters. The module for it is
 * loaded when somebody does.
 *
 * @import { State } from './types.js'
 */
import { Cancelled } from './protocol.js';

/** Places of the potential along each side of the domain. */
const ARROWS = 14;

/**
 * @param {ReturnType<import('./state.js').createState>} state
 * @param {{ onError: (error: unknown) => void }} callbacks
 */
export function createExploring(state, { onError }) {
  /** @type {Promise<ReturnType<typeof import('./study/study.js').createStudy>> | null} */
  let study = null;
  /** What was asked for last. @type {{ removal: unknown, domain: unknown, pick: number }} */
  const asked = { removal: null, domain: null, pick: 0 };

  const load = () => {
    study ??= import('./study/study.js').then(({ createStudy }) => createStudy());
    // Without a network it may be there the next time.
    study.catch(() => {
      study = null;
    });
    return study;
  };

  /** @param {unknown} error */
  function tell(error) {
    if (!(error instanceof Cancelled)) onError(error);
  }

  /** Finds out what is cut when, once somebody goes back along a proven path. @param {State} now */
  async function refreshRemoval({ outcome, planned, at, removal, removing }) {
    if (!outcome || !planned || !outcome.files || !outcome.excess) return;
    if (at >= 1 || asked.removal === outcome || removal?.outcome === outcome) return;
    asked.removal = outcome;
    state.set({ removing: 0 });
    try {
      // Nobody waits for what another path cuts.
      if (removing !== null) (await load()).cancel();
      const apt = await outcome.files.apt.text();
      const found = await (await load()).removed(planned, apt, (_, fraction) => {
        if (asked.removal === outcome) state.set({ removing: fraction });
      });
      if (state.get().outcome === outcome) state.set({ removal: { outcome, ...found } });
    } catch (error) {
      tell(error);
    } finally {
      if (asked.removal === outcome) state.set({ removing: null });
    }
  }

  /** Lays the passes out over the parameters while somebody looks at these. @param {State} now */
  async function refreshDomain({ isFlat, outcome, planned }) {
    if (!isFlat || !outcome || !planned || asked.domain === outcome.contacts) return;
    const { contacts } = outcome;
    asked.domain = contacts;
    state.set({ domain: null });
    const isFile = planned.spec.source.kind === 'file' && !planned.source.bytes;
    if (isFile) return;
    try {
      const domain = await (await load()).domain(planned, contacts, ARROWS);
      if (asked.domain === contacts) state.set({ domain });
    } catch (error) {
      // What was stopped is asked for again; what failed would fail again.
      if (error instanceof Cancelled) asked.domain = null;
      tell(error);
    }
  }

  return {
    /** @param {State} now */
    refresh(now) {
      refreshRemoval(now);
      refreshDomain(now);
    },

    /** Tells what is at a point of the surface. @param {number[]} point @param {number | null} excess */
    async pick(point, excess) {
      asked.pick += 1;
      const mine = asked.pick;
      const { draft } = state.get();
      const none = { u: Number.NaN, v: Number.NaN, least_curvature: null, most_curvature: null };
      state.set({ picked: { ...none, point, excess } });
      if (!draft || (draft.spec.source.kind === 'file' && !draft.source.bytes)) return;
      try {
        const place = await (await load()).place(draft, point);
        if (place && mine === asked.pick && state.get().picked)
          state.set({ picked: { ...place, point, excess } });
      } catch (error) {
        tell(error);
      }
    },

    /** The path from above, as an SVG text. @param {Blob} apt */
    drawing: async (apt) => (await load()).drawing(await apt.text()),
  };
}
