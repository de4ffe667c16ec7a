/** What the page does: choosing, revealing, changing, simulating. No DOM; views call these functions. */

import { ApiError } from "./api.js";
import { latestOnly } from "./latest.js";
import { linesOf, moved } from "./reveal.js";
import { endOf, samplesNeeded } from "./trajectory.js";
import { changed, UNCHANGED } from "./values.js";
import { HOME } from "./url.js";

/** @typedef {import("./types.js").Failure} Failure */
/**
 * @typedef {object} State
 * @property {import("./types.js").Place} place
 * @property {import("./types.js").Catalog} catalog
 * @property {import("./types.js").SceneEntry[]} scenes
 * @property {import("./types.js").Method[]} methods
 * @property {import("./types.js").Scene | null} scene
 * @property {import("./types.js").Derivation | null} derivation
 * @property {import("./reveal.js").Line[]} lines  the derivation's steps in order
 * @property {import("./types.js").Trajectory | null} trajectory
 * @property {import("./types.js").Changes} changes
 * @property {{page: Failure | null, scene: Failure | null, derivation: Failure | null, simulation: Failure | null}} failures
 * @property {boolean} simulating
 * @property {"" | "overview" | "help" | "black"} overlay
 */

/** @type {State["failures"]} */
const NO_FAILURES = { page: null, scene: null, derivation: null, simulation: null };

/** @type {State} */
export const START = {
  place: HOME, catalog: {}, scenes: [], methods: [], scene: null, derivation: null, lines: [], trajectory: null,
  changes: UNCHANGED, failures: NO_FAILURES, simulating: false, overlay: "",
};

/** Milliseconds between two simulations while a slider moves, samples per second, and the step where one is asked for. */
const PAUSE = 100;
const RATE = 30;
const PARTS = ["coordinates", "positions", "loads", "energy", "error"];
const STEP = 0.01;

/**
 * @param {ReturnType<typeof import("./store.js").createStore<State>>} store
 * @param {import("./api.js").Api} api
 * @param {import("./clock.js").Clock} clock
 */
export function createSession(store, api, clock) {
  const { get, set } = store;
  /** @param {Partial<import("./types.js").Place>} patch */
  const move = (patch) => set({ place: { ...get().place, ...patch } });
  /** @param {keyof State["failures"]} part @param {Failure | null} failure */
  const fail = (part, failure) => set({ failures: { ...get().failures, [part]: failure } });

  /** Runs a task; what goes wrong is kept for the view of its part. @param {keyof State["failures"]} part @param {() => Promise<void>} task */
  async function attempt(part, task) {
    try {
      await task();
      fail(part, null);
    } catch (error) {
      if (error instanceof ApiError) fail(part, error.failure);
      else if (/** @type {Error} */ (error).name !== "AbortError") throw error;
    }
  }

  const simulations = latestOnly(simulate, PAUSE);

  /** Fast swings are asked for again with as many samples as they need. @param {object} request @param {import("./types.js").Trajectory} trajectory */
  function refine(request, trajectory) {
    const chosen = get().methods.find((method) => method.id === trajectory.method);
    const samples = chosen?.adaptive && trajectory.status === "ok" ? samplesNeeded(trajectory) : 0;
    if (samples > trajectory.t.length) simulations.offer({ ...request, samples });
  }

  /** @param {object} request @param {AbortSignal} signal */
  async function simulate(request, signal) {
    set({ simulating: true });
    await attempt("simulation", async () => {
      const trajectory = await api.simulate(request, signal);
      if (signal.aborted) return;
      set({ trajectory });
      clock.setEnd(endOf(trajectory));
      refine(request, trajectory);
    });
    set({ simulating: false });
  }

  function askSimulation() {
    const { place, changes, methods } = get();
    const method = methods.find((candidate) => candidate.id === place.method);
    simulations.ask({
      scene: place.scene, ...changes, t_end: place.duration, samples: Math.min(2001, place.duration * RATE + 1), include: PARTS,
      lang: place.lang,
      ...(method ? { method: method.id } : {}),
      ...(method && method.adaptive === false ? { step: STEP } : {}),
    });
  }

  async function derive() {
    const { scene, lang } = get().place;
    await attempt("derivation", async () => {
      const derivation = await api.derive({ scene, lang });
      if (get().place.scene !== scene || get().place.lang !== lang) return;
      const lines = linesOf(derivation.chapters);
      set({ derivation, lines });
      move({ step: moved(lines, get().place.step, 0) });
    });
  }

  /** @param {string} id @param {string} [step] */
  async function choose(id, step = "") {
    simulations.cancel();
    clock.seek(0);
    set({ scene: null, derivation: null, lines: [], trajectory: null, changes: UNCHANGED, failures: NO_FAILURES });
    move({ scene: id, step });
    askSimulation();
    await attempt("scene", async () => {
      const [scene] = await Promise.all([api.scene(id, get().place.lang), derive()]);
      if (get().place.scene === id) set({ scene });
    });
  }

  /** @param {string} lang */
  async function speak(lang) {
    move({ lang });
    await attempt("page", async () => set({ catalog: await api.catalog(lang) }));
  }

  return {
    /** @param {import("./types.js").Place} place */
    async start(place) {
      set({ place });
      const listed = attempt("page", async () => {
        const [{ scenes }, { methods }] = await Promise.all([api.scenes(), api.methods()]);
        set({ scenes, methods });
      });
      const spoken = speak(place.lang);
      if (!place.scene || place.method) await listed;
      const scene = place.scene || preferred(get().scenes);
      await Promise.all([listed, spoken, ...(scene ? [choose(scene, place.step)] : [])]);
    },
    choose,
    /** @param {number} by */
    go: (by) => move({ step: moved(get().lines, get().place.step, by) }),
    /** @param {string} step */
    goTo(step) {
      move({ step });
      set({ overlay: "" });
    },
    /** @param {string} lang */
    async language(lang) {
      await speak(lang);
      await derive();
      askSimulation();
    },
    /** @param {Partial<import("./types.js").Place>} patch */
    move,
    /** @param {Partial<import("./types.js").Place>} patch how to simulate */
    resimulate(patch) {
      move(patch);
      askSimulation();
    },
    /** @param {import("./values.js").Slider} slider @param {number} value */
    slide(slider, value) {
      const { scene, changes } = get();
      if (!scene) return;
      set({ changes: changed(scene, changes, slider, value) });
      askSimulation();
    },
    reset() {
      set({ changes: UNCHANGED });
      askSimulation();
    },
    /** @param {State["overlay"]} overlay */
    overlay: (overlay) => set({ overlay: get().overlay === overlay ? "" : overlay }),
  };
}

/** The scene shown first: the lecture's main example, else any. @param {import("./types.js").SceneEntry[]} scenes */
function preferred(scenes) {
  return (scenes.find((scene) => scene.id === "elastic-pendulum") ?? scenes[0])?.id ?? "";
}

/** @typedef {ReturnType<typeof createSession>} Session */
