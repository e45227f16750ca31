/**
 * Talks to the worker that holds the planner.
 *
 * A request `{id, op, args}` is answered by any number of `progress` messages and then exactly one `done` or
 * `error`. Cancelling is not a message: the worker is stopped, and the next request starts another one from the
 * module that was compiled once.
 *
 * @import { Problem } from './types.js'
 */

/** A request that failed; `field` names the part of the spec concerned, where there is one. */
export class PlannerError extends Error {
  /** @param {Problem} problem */
  constructor({ code, message, field }) {
    super(message);
    this.code = code;
    this.field = field;
  }
}

/** A request that was given up on purpose. */
export class Cancelled extends Error {}

/**
 * @typedef {{ resolve: (result: any) => void, reject: (error: Error) => void,
 *   onProgress: ((phase: string, fraction: number) => void) | undefined }} Pending
 */

/** The worker that plans for mills. */
const spawnMilling = () =>
  new Worker(new URL('./worker.js', import.meta.url), { type: 'module', name: 'planner' });

/**
 * Starts a worker at once: it loads while the page is still being built.
 *
 * @param {() => Promise<WebAssembly.Module>} compile Called once.
 * @param {() => Worker} spawn Called for every worker.
 */
export function createPlanner(compile, spawn = spawnMilling) {
  /** @type {Promise<WebAssembly.Module> | null} */
  let module = null;
  /** @type {Worker | null} */
  let worker = null;
  /** @type {Map<number, Pending>} */
  const pending = new Map();
  let lastId = 0;

  function start() {
    const started = spawn();
    let hasAnswered = false;
    started.onmessage = ({ data }) => {
      hasAnswered = true;
      receive(data);
    };
    started.onerror = (event) => {
      event.preventDefault();
      // One that never answered could not be loaded; the next request starts another one either way.
      stop(new PlannerError({ code: hasAnswered ? 'trap' : 'worker', message: event.message ?? '' }));
    };
    module ??= compile();
    module.then(
      (compiled) => started.postMessage({ module: compiled }),
      (error) => {
        // Whoever asks again after a broken line shall get it then.
        module = null;
        stop(new PlannerError({ code: 'compile', message: String(error.message ?? error) }));
      },
    );
    worker = started;
    return started;
  }

  /** @param {any} message */
  function receive(message) {
    const request = pending.get(message.id);
    if (!request) return;
    if (message.type === 'progress') {
      request.onProgress?.(message.phase, message.fraction);
      return;
    }
    pending.delete(message.id);
    if (message.type === 'done') request.resolve(message.result);
    else request.reject(new PlannerError(message));
    // After a trap the module's memory is in no known state.
    if (message.code === 'trap') stop(new Cancelled());
  }

  /** @param {Error} reason */
  function stop(reason) {
    worker?.terminate();
    worker = null;
    const given = [...pending.values()];
    pending.clear();
    for (const request of given) request.reject(reason);
  }

  start();

  return {
    /**
     * Asks the planner for something; rejects with a {@link PlannerError} or {@link Cancelled}.
     *
     * @param {string} op
     * @param {any[]} args
     * @param {(phase: string, fraction: number) => void} [onProgress]
     * @returns {Promise<any>}
     */
    call(op, args, onProgress) {
      lastId += 1;
      const id = lastId;
      return new Promise((resolve, reject) => {
        pending.set(id, { resolve, reject, onProgress });
        (worker ?? start()).postMessage({ id, op, args });
      });
    },

    /** Gives up all requests, at once, and has a new worker ready for the next. */
    cancel() {
      if (pending.size === 0) return;
      stop(new Cancelled());
      start();
    },
  };
}
