/** A general proof, read step by step like a derivation. */

import { ApiError } from "./api.js";
import { indexOf, linesOf, moved } from "./reveal.js";
import { mover } from "./store.js";

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
export function createProof(store, api) {
  const { get, set } = store;
  const move = mover(store);

  async function load() {
    const { lang } = get().place;
    const speaks = () => get().place.lang === lang;
    const coming = api.proof(PROOF, lang);
    coming.catch(() => {}); // what went wrong is met below
    try {
      const catalog = await api.catalog(lang, "lecture");
      if (speaks()) set({ catalog });
      const derivation = await coming;
      if (!speaks()) return;
      const lines = linesOf(derivation.chapters);
      set({ derivation, lines, failure: null });
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
    go: (by) => move({ step: moved(get().lines, get().place.step, by), part: 0 }),
    /** @param {string} step @param {number} [part] */
    goTo(step, part = 0) {
      move({ step, part });
      set({ overlay: "" });
    },
    /** @param {import("./types.js").Lang} lang */
    async language(lang) {
      move({ lang });
      await load();
    },
    /** @param {Reading["overlay"]} overlay */
    overlay: (overlay) => set({ overlay: get().overlay === overlay ? "" : overlay }),
  };
}

/** @typedef {ReturnType<typeof createProof>} Proof */
