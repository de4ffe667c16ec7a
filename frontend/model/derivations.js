/** The derivation on the page: that of its scene, in its language, by its formulation. */

import { OWN } from "./own.js";
import { sceneOf } from "./request.js";
import { linesOf, moved } from "./reveal.js";
import { mover } from "./store.js";

/**
 * What asks for the derivation; an answer that was overtaken is left.
 * @param {import("./state.js").Store} store
 * @param {import("./api.js").Api} api
 * @param {import("./state.js").Attempt} attempt
 */
export function createDerivations(store, api, attempt) {
  const { get, set } = store;
  const move = mover(store);
  return async function derive() {
    const scene = sceneOf(get());
    const { lang, formulation, n, more } = get().place;
    const isWanted = () => {
      const { place } = get();
      const asked = [place.lang, place.formulation, place.n, place.more];
      return sceneOf(get()) === scene && asked.every((value, i) => value === [lang, formulation, n, more][i]);
    };
    await attempt("derivation", async () => {
      const derivation = await api.derive({
        scene: scene ?? OWN,
        lang,
        formulation,
        ...(more ? { canonical: true } : {}),
        ...(n ? { parameters: { n } } : {}),
      });
      if (!isWanted()) return;
      const lines = linesOf(derivation.chapters);
      set({ derivation, lines });
      move({ step: moved(lines, get().place.step, 0) });
    });
  };
}
