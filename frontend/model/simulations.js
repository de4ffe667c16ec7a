/** The motion on the page: asked for again as values change, and with more samples where it swings fast. */

import { latestOnly } from "./latest.js";
import { completed } from "./own.js";
import { requestOf, sceneOf } from "./request.js";
import { endOf, samplesNeeded } from "./trajectory.js";

/** @typedef {import("./state.js").State} State */

/** Milliseconds between two simulations while a slider moves. */
const PAUSE = 100;

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

  /** Fast swings are asked for again with as many samples as they need. @param {object} request @param {import("./types.js").Trajectory} trajectory */
  function refine(request, trajectory) {
    const chosen = get().methods.find((method) => method.id === trajectory.method);
    const samples = chosen?.adaptive && trajectory.status === "ok" ? samplesNeeded(trajectory) : 0;
    if (samples > trajectory.t.length) latest.offer({ ...request, samples });
  }

  /** @param {object} request @param {AbortSignal} signal */
  async function simulate(request, signal) {
    set({ simulating: true });
    const done = attempt(async () => {
      const trajectory = await api.simulate(request, signal);
      if (signal.aborted) return;
      set({ trajectory, ...shownWith(request) });
      clock.setEnd(endOf(trajectory));
      refine(request, trajectory);
    });
    await done.finally(() => set({ simulating: false }));
  }

  /** The viewer's own scene changes on the page together with its motion. @param {any} request */
  function shownWith({ scene }) {
    if (typeof scene === "string" || scene === shown) return {};
    shown = scene;
    return { scene: completed(scene) };
  }

  return {
    cancel: latest.cancel,
    ask() {
      if (sceneOf(get())) void latest.ask(requestOf(get(), get().changes, get().place.method));
    },
  };
}
