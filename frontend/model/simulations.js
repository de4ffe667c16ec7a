/** The motion on the page: asked for again as values change, and with more samples until they show it. */

import { latestOnly } from "./latest.js";
import { completed } from "./own.js";
import { requestOf, sceneOf } from "./request.js";
import { judged, samplesFor } from "./sampling.js";
import { endOf } from "./trajectory.js";

/** @typedef {import("./state.js").State} State */
/** @typedef {ReturnType<typeof requestOf>} Request */
/** @typedef {{request: Request, round: number}} Wish */

/** Milliseconds between two simulations while a slider moves. */
const PAUSE = 100;

/** Motions of about the same swiftness. @param {Request} request */
const keyOf = ({ scene, method = "" }) => `${typeof scene === "string" ? scene : "own"} ${method}`;

/**
 * @param {ReturnType<typeof import("./store.js").createStore<State>>} store
 * @param {import("./api.js").Api} api
 * @param {import("./clock.js").Clock} clock
 * @param {(task: () => Promise<void>) => Promise<void>} attempt
 */
export function createSimulations({ get, set }, api, clock, attempt) {
  /** @type {object | null} */
  let shown = null;
  const latest = latestOnly(simulate, PAUSE);
  /** Samples per second that the motion needed last: while a slider moves, the next one needs about as many. */
  let dense = { of: "", rate: 0 };

  /** @param {Wish} wish @param {AbortSignal} signal */
  async function simulate({ request, round }, signal) {
    set({ simulating: true });
    let refined = false;
    const done = attempt(async () => {
      const { trajectory, again } = judged(await api.simulate(request, signal), request, round);
      if (signal.aborted) return;
      set({ trajectory, ...shownWith(request) });
      clock.setEnd(endOf(trajectory));
      if (again) latest.offer({ request: again, round: round + 1 });
      else dense = { of: keyOf(request), rate: (request.samples - 1) / request.t_end };
      refined = again !== null;
    });
    await done.finally(() => set({ simulating: refined }));
  }

  /** @param {Request} request @returns {Request} */
  const asDense = (request) =>
    dense.of === keyOf(request) && dense.rate * request.t_end + 1 > request.samples
      ? { ...request, samples: samplesFor(dense.rate * request.t_end + 1) }
      : request;

  /** The viewer's own scene changes on the page together with its motion. @param {Request} request */
  function shownWith({ scene }) {
    if (typeof scene === "string" || scene === shown) return {};
    shown = scene;
    return { scene: completed(scene) };
  }

  return {
    cancel() {
      latest.cancel();
      set({ simulating: false });
    },
    ask() {
      if (sceneOf(get()))
        void latest.ask({ request: asDense(requestOf(get(), get().changes, get().place.method)), round: 1 });
    },
  };
}
