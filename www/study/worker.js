/** Holds the planner that knows more: all strategies, what cuts when, places on the surface, and figures to learn from. */
import { buffers, planning } from '../planning.js';
import { serve } from '../serving.js';
import init, * as planner from '../wasm/study.js';

/** The surface that was looked at last, and by what name the page calls it. @type {{ key: number, surface: planner.StudySurface | undefined }} */
let looked = { key: -1, surface: undefined };

/** @param {any} result */
const plain = (result) => ({ result, transfer: [] });

serve(init, {
  ...planning(planner),

  surface([key, spec, bytes]) {
    if (looked.key !== key) {
      looked.surface?.free();
      looked = { key, surface: planner.study_surface(JSON.stringify(spec), bytes ?? undefined) };
    }
    return plain(looked.surface !== undefined);
  },

  place: ([x, y, z]) => plain(looked.surface ? JSON.parse(looked.surface.place(x, y, z)) : null),

  domain([points, count], progress) {
    const { surface } = looked;
    if (!surface) return plain(null);
    const arrays = {
      uv: surface.parameters(points),
      potential: surface.potential(count, progress),
      ends: surface.domain(),
    };
    return { result: arrays, transfer: buffers(arrays) };
  },

  removed([spec, bytes, apt], progress) {
    const removed = planner.study_removed(JSON.stringify(spec), bytes ?? undefined, apt, progress);
    const arrays = { steps: removed.steps(), vertices: removed.vertices(), excess: removed.excess() };
    removed.free();
    return { result: arrays, transfer: buffers(arrays) };
  },

  drawing: ([apt]) => plain(planner.study_drawing(apt)),

  contenders: ([spec, bytes]) =>
    plain(JSON.parse(planner.study_contenders(JSON.stringify(spec), bytes ?? undefined))),

  floor: ([spec, bytes], progress) =>
    plain(planner.study_floor(JSON.stringify(spec), bytes ?? undefined, progress) ?? null),

  section: ([spec, posture, surface, reach]) =>
    plain(
      JSON.parse(
        planner.study_section(
          JSON.stringify(spec),
          new Float64Array(posture),
          new Float64Array(surface),
          reach,
        ),
      ),
    ),

  widths: ([spec, lead, surface]) =>
    plain(JSON.parse(planner.study_widths(JSON.stringify(spec), lead, new Float64Array(surface)))),

  passes: ([spec, tilt, radius]) =>
    plain(JSON.parse(planner.study_passes(JSON.stringify(spec), tilt, radius))),

  restarts: ([spec, threshold], progress) =>
    plain(JSON.parse(planner.study_restarts(JSON.stringify(spec), threshold, progress))),
});
