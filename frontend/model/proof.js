/** A general proof, read step by step like a derivation. */

import { ApiError } from "./api.js";
import { indexOf, linesOf, moved } from "./reveal.js";

/** @typedef {import("./types.js").Failure} Failure */
/**
 * @typedef {object} Reading
 * @property {import("./types.js").Place} place
 * @property {import("./types.js").Catalog} catalog
 * @property {import("./types.js").Derivation | null} derivation
 * @property {import("./reveal.js").Line[]} lines
 * @property {import("./types.js").Overlay} overlay
 * @property {Failure | null} failure
 */

export const PROOF = "dalembert-lagrange";

/**
 * @param {ReturnType<typeof import("./store.js").createStore<Reading>>} store
 * @param {Pick<import("./api.js").Api, "proof" | "catalog">} api
 */
export function createProof({ get, set }, api) {
  const move = (/** @type {Partial<import("./types.js").Place>} */ patch) => set({ place: { ...get().place, ...patch } });

  async function load() {
    const { lang } = get().place;
    try {
      const [catalog, derivation] = await Promise.all([api.catalog(lang, "lecture"), api.proof(PROOF, lang)]);
      if (get().place.lang !== lang) return;
      const lines = linesOf(derivation.chapters);
      set({ catalog, derivation, lines, failure: null });
      move({ step: lines[indexOf(lines, get().place.step)]?.step.id ?? "" });
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      set({ failure: error.failure });
    }
  }

  return {
    load,
    move,
    /** @param {number} by */
    go: (by) => move({ step: moved(get().lines, get().place.step, by) }),
    /** @param {string} step */
    goTo(step) {
      move({ step });
      set({ overlay: "" });
    },
    /** @param {string} lang */
    async language(lang) {
      move({ lang });
      await load();
    },
    /** @param {Reading["overlay"]} overlay */
    overlay: (overlay) => set({ overlay: get().overlay === overlay ? "" : overlay }),
  };
}

/** @typedef {ReturnType<typeof createProof>} Proof */
