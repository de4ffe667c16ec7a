/** The scene on the page: one of the library, or the viewer's own. */

import { completed, fragmentOf, OWN } from "./own.js";
import { NO_FAILURES } from "./state.js";
import { mover } from "./store.js";
import { readChanges, UNCHANGED } from "./values.js";

/** @typedef {Pick<import("./types.js").Scene, "coordinates" | "guides" | "constraints">} Counted */

/** Coordinates that no guide prescribes: each has an equation. @param {Counted} scene */
export const freedomsOf = ({ coordinates, guides }) => coordinates.length - (guides ?? []).length;

/**
 * Degrees of freedom: those less the constraints, of which some may follow from others. How many do, the derivation knows;
 * it leaves one degree at least.
 * @param {Counted} scene @param {import("./types.js").Derivation | null} [derivation]
 */
export function degreesOf(scene, derivation) {
  const constraints = scene.constraints ?? [];
  const known = constraints.length ? derivation?.result?.degrees_of_freedom : undefined;
  return known ?? Math.max(1, freedomsOf(scene) - constraints.length);
}

/**
 * @param {import("./state.js").Store} store
 * @param {import("./api.js").Api} api
 * @param {import("./state.js").Attempt} attempt
 * @param {{derive: (document?: Promise<import("./types.js").Scene>) => Promise<void>, rewind: () => void, simulations: {ask: () => void, cancel: () => void}}} about  what is told of the scene
 */
export function createSubject(store, api, attempt, { derive, rewind, simulations }) {
  const { get, set } = store;
  const move = mover(store);
  /** @param {string} id @param {string} [step] @param {number} [n] @param {string} [changes] as the address has them */
  async function choose(id, step = "", n = 0, changes = "") {
    simulations.cancel();
    rewind();
    set({
      scene: null,
      derivation: null,
      lines: [],
      trajectory: null,
      runs: [],
      changes: readChanges(changes),
      held: null,
      failures: NO_FAILURES,
    });
    move({
      scene: id,
      step,
      n,
      set: changes,
      ...(id === get().place.scene ? {} : { part: 0, vary: "", runs: "", plot: "", at: 0, release: "" }),
    });
    simulations.ask();
    await attempt("scene", async () => {
      const document = id === OWN ? get().own && completed(get().own ?? {}) : api.scene(id, get().place.lang, n);
      const [scene] = await Promise.all([document, derive(document instanceof Promise ? document : undefined)]);
      if (get().place.scene === id && get().place.n === n) set({ scene });
    });
  }
  return {
    choose,
    /** Shows the viewer's own scene; what is on the page stays until the new is there. @param {import("./own.js").SceneDocument} own */
    async show(own) {
      set({ own, changes: UNCHANGED, held: null });
      move({ set: "" });
      if (get().place.scene !== OWN) return choose(OWN);
      simulations.ask();
      await derive();
    },
    /** The address of a scene while it is written. @param {import("./own.js").SceneDocument} own */
    address: async (own) => set({ fragment: await fragmentOf(own) }),
  };
}
