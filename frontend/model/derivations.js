/** The derivation on the page: that of its scene, in its language, by its formulation. */

import { ApiError } from "./api.js";
import { completed, OWN } from "./own.js";
import { sceneOf } from "./request.js";
import { linesOf, moved } from "./reveal.js";
import { mover } from "./store.js";
import { markerOf, withSymbols } from "./symbols.js";

/** @typedef {import("./types.js").Derivation} Derivation */

/** Why the last chapter is not there; null where it is. @param {Derivation | null} derivation */
export const missingIn = (derivation) => derivation?.left_out?.find(({ part }) => part === "model") ?? null;

/** @param {Derivation | null} derivation */
export const isUnderWay = (derivation) => missingIn(derivation)?.reason === "later";

/** Chapters that were there at once, and those that came later. @param {Derivation} first @param {Derivation} rest @returns {Derivation} */
const joined = (first, rest) => ({ ...rest, chapters: [...first.chapters, ...rest.chapters] });

/** With the symbols of the scene marked, by which they are found in the drawing. @param {Derivation} derivation @param {import("./types.js").Scene | null} scene @returns {Derivation} */
function marked(derivation, scene) {
  if (!scene) return derivation;
  const mark = markerOf(scene, derivation.result);
  const within = (/** @type {import("./types.js").Chapter} */ chapter) => ({
    ...chapter,
    steps: chapter.steps.map((step) => withSymbols(step, mark)),
  });
  return { ...derivation, chapters: derivation.chapters.map(within) };
}

/** The equations stay when nothing comes behind them. @param {Derivation} first @param {unknown} error @returns {Derivation} */
function cut(first, error) {
  if (!(error instanceof ApiError)) throw error;
  return { ...first, left_out: [{ part: "model", reason: "failed", text: error.message }] };
}

/**
 * What asks for the derivation; an answer that was overtaken is left. What is there first is shown at once.
 * @param {import("./state.js").Store} store
 * @param {import("./api.js").Api} api
 * @param {import("./state.js").Attempt} attempt
 */
export function createDerivations(store, api, attempt) {
  const { get, set } = store;
  const move = mover(store);

  /** @param {Derivation} derivation */
  function show(derivation) {
    const lines = linesOf(derivation.chapters);
    set({ derivation, lines });
    // A step that is still to come stays the one that is wanted.
    if (!isUnderWay(derivation)) move({ step: moved(lines, get().place.step, 0) });
  }

  /** @param {Promise<import("./types.js").Scene>} [document] of the scene, where it is not there yet */
  return async function derive(document) {
    const scene = sceneOf(get());
    const { own, place: asked } = get();
    let described = asked.scene === OWN ? own && completed(own) : get().scene;
    /** @type {Derivation | null} */
    let told = null;
    const tell = (/** @type {Derivation} */ derivation) => isWanted() && show(marked((told = derivation), described));
    // The scene is there first, as a rule: where it is not, nobody waits for it.
    void document?.then(
      (scene) => {
        described = scene;
        if (told) tell(told);
      },
      () => {},
    );
    const { lang, formulation, n, more, release } = get().place;
    const isWanted = () => {
      const { place } = get();
      const asked = [place.lang, place.formulation, place.n, place.more, place.release];
      return sceneOf(get()) === scene && asked.every((value, i) => value === [lang, formulation, n, more, release][i]);
    };
    const question = {
      scene: scene ?? OWN,
      lang,
      formulation,
      ...(more ? { canonical: true } : {}),
      ...(release ? { release: release.split(",") } : {}),
      ...(n ? { parameters: { n } } : {}),
    };
    await attempt("derivation", async () => {
      const first = await api.derive({ ...question, chapters: "ready" });
      tell(first);
      if (!isWanted() || !isUnderWay(first)) return;
      const whole = await api.derive({ ...question, chapters: "model" }).then(
        (rest) => joined(first, rest),
        (error) => cut(first, error),
      );
      tell(whole);
    });
  };
}
