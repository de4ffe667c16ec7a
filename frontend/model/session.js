/** What the page does: choosing, revealing, changing, simulating. No DOM; views call these functions. */

import { ApiError } from "./api.js";
import { requestOf, sceneOf } from "./request.js";
import { linesOf, moved } from "./reveal.js";
import { createSimulations } from "./simulations.js";
import { changed, readChanges, UNCHANGED, writeChanges } from "./values.js";
import { createSpeech } from "./speech.js";
import { NO_FAILURES, preferred } from "./state.js";
import { completed, fragmentOf, OWN } from "./own.js";

/** @typedef {import("./types.js").Failure} Failure */
/** @typedef {import("./state.js").State} State */

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

  const asked = () => sceneOf(get());

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

  const simulations = createSimulations(store, api, clock, (task) => attempt("simulation", task));

  async function derive() {
    const { lang, formulation, n } = get().place;
    const scene = asked();
    await attempt("derivation", async () => {
      const derivation = await api.derive({ scene, lang, formulation, ...(n ? { parameters: { n } } : {}) });
      const { place } = get();
      if (asked() !== scene || place.lang !== lang || place.formulation !== formulation || place.n !== n) return;
      const lines = linesOf(derivation.chapters);
      set({ derivation, lines });
      move({ step: moved(lines, get().place.step, 0) });
    });
  }

  /** @param {import("./types.js").Changes} changes */
  function change(changes) {
    set({ changes });
    move({ set: writeChanges(changes) });
    simulations.ask();
  }

  /** @param {string} id @param {string} [step] @param {number} [n] @param {string} [changes] as the address has them */
  async function choose(id, step = "", n = 0, changes = "") {
    simulations.cancel();
    clock.seek(0);
    set({ scene: null, derivation: null, lines: [], trajectory: null, runs: [], changes: readChanges(changes), failures: NO_FAILURES });
    move({ scene: id, step, n, set: changes, ...(id === get().place.scene ? {} : { part: 0, vary: "", runs: "", at: 0 }) });
    simulations.ask();
    await attempt("scene", async () => {
      const document = id === OWN ? get().own && completed(get().own ?? {}) : api.scene(id, get().place.lang, n);
      const [scene] = await Promise.all([document, derive()]);
      if (get().place.scene === id && get().place.n === n) set({ scene });
    });
  }

  const { speak, need, needFor } = createSpeech(store, api, (task) => attempt("page", task), ["methods"]);

  return {
    /** @param {import("./types.js").Place} place */
    async start(place, own = /** @type {import("./own.js").SceneDocument | null} */ (null)) {
      set({ place, own, fragment: own ? await fragmentOf(own) : "" });
      const listed = attempt("page", async () => {
        const [{ scenes }, { methods }] = await Promise.all([api.scenes(), api.methods()]);
        set({ scenes, methods });
      });
      needFor(place);
      const spoken = speak(place.lang);
      if (!place.scene || place.method) await listed;
      const scene = place.scene || preferred(get().scenes);
      await Promise.all([listed, spoken, ...(scene && (scene !== OWN || own) ? [choose(scene, place.step, place.n, place.set)] : [])]);
    },
    choose,
    /** Shows the viewer's own scene; what is on the page stays until the new is there. @param {import("./own.js").SceneDocument} own */
    async show(own) {
      set({ own, changes: UNCHANGED });
      move({ set: "" });
      if (get().place.scene !== OWN) return choose(OWN);
      simulations.ask();
      await derive();
    },
    /** The address of a scene while it is written. @param {import("./own.js").SceneDocument} own */
    address: async (own) => set({ fragment: await fragmentOf(own) }),
    /** @param {number} by */
    go: (by) => move({ step: moved(get().lines, get().place.step, by), part: 0 }),
    /** @param {string} step @param {number} [part] */
    goTo(step, part = 0) {
      move({ step, part });
      set({ overlay: "" });
    },
    /** @param {string} lang */
    async language(lang) {
      await speak(lang);
      await derive();
      simulations.ask();
    },
    /** @param {string} formulation the road to the equations */
    async formulate(formulation) {
      move({ formulation });
      await derive();
    },
    /** @param {Partial<import("./types.js").Place>} patch */
    move(patch) {
      needFor(patch);
      move(patch);
    },
    /** @param {Partial<import("./types.js").Place>} patch how to simulate */
    resimulate(patch) {
      move(patch);
      simulations.ask();
    },
    /** @param {import("./values.js").Slider} slider @param {number} value */
    slide(slider, value) {
      const { scene, changes } = get();
      if (!scene) return;
      change(changed(scene, changes, slider, value));
    },
    change,
    /** A motion beside the present one. @param {import("./types.js").Changes} changes @param {string} method */
    run: (changes, method) => api.simulate(requestOf(get(), changes, method)),
    /** @param {State["runs"]} runs */
    compare: (runs) => set({ runs }),
    reset: () => change(UNCHANGED),
    /** Texts that are wanted from now on. */
    need,
    /** @param {State["overlay"]} overlay */
    overlay(overlay) {
      need("lecture");
      set({ overlay: get().overlay === overlay ? "" : overlay });
    },
  };
}

/** @typedef {ReturnType<typeof createSession>} Session */
