/** Holds the page's first planner. */
import { planning } from './planning.js';
import { serve } from './serving.js';
import init, * as planner from './wasm/stepover.js';

serve(init, planning(planner));
