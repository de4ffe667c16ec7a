/** What the page does: choosing, revealing, changing, simulating. No DOM; views call these functions. */

import { createAdjustments } from "./adjustments.js";
import { createAttempts } from "./attempts.js";
import { createDerivations } from "./derivations.js";
import { fragmentOf, OWN } from "./own.js";
import { requestOf } from "./request.js";
import { moved } from "./reveal.js";
import { sampled } from "./sampling.js";
import { createSimulations } from "./simulations.js";
import { createSpeech } from "./speech.js";
import { preferred } from "./state.js";
import { mover } from "./store.js";
import { createSubject } from "./subject.js";
import { readChanges } from "./values.js";

/** @typedef {import("./state.js").State} State */
/** @typedef {import("./types.js").Place} Place */

/**
 * The steps on the page, and what lies above it.
 * @param {import("./state.js").Store} store @param {(section: string) => void} need
 */
function createReading(store, need) {
  const { get, set } = store;
  const move = mover(store);
  return {
    /** @param {number} by */
    go: (by) => move({ step: moved(get().lines, get().place.step, by), part: 0 }),
    /** @param {string} step @param {number} [part] */
    goTo(step, part = 0) {
      move({ step, part });
      set({ overlay: "" });
    },
    /** @param {State["overlay"]} overlay */
    overlay(overlay) {
      need("lecture");
      set({ overlay: get().overlay === overlay ? "" : overlay });
    },
  };
}

/**
 * What begins with a place: the lists, the texts and the scene, each as early as it can.
 * @param {import("./state.js").Store} store @param {import("./api.js").Api} api @param {import("./state.js").Attempt} attempt
 * @param {ReturnType<typeof createSpeech>} speech @param {ReturnType<typeof createSubject>["choose"]} choose
 */
function createStart({ get, set }, api, attempt, { speak, needFor }, choose) {
  /** @param {Place} place @param {import("./own.js").SceneDocument | null} own */
  return async (place, own = null) => {
    set({ place, own, fragment: own ? await fragmentOf(own) : "" });
    const listed = attempt("page", async () => {
      const [{ scenes }, { methods }] = await Promise.all([api.scenes(), api.methods()]);
      set({ scenes, methods });
    });
    needFor(place);
    const spoken = speak(place.lang);
    if (!place.scene || place.method) await listed;
    const scene = place.scene || preferred(get().scenes);
    await Promise.all([
      listed,
      spoken,
      ...(scene && (scene !== OWN || own) ? [choose(scene, place.step, place.n, place.set)] : []),
    ]);
  };
}

/**
 * @param {import("./state.js").Store} store
 * @param {import("./api.js").Api} api
 * @param {import("./clock.js").Clock} clock
 */
export function createSession(store, api, clock) {
  const { get, set } = store;
  const move = mover(store);
  const attempt = createAttempts(store);
  const simulations = createSimulations(store, api, clock, (task) => attempt("simulation", task));
  const derive = createDerivations(store, api, attempt);
  const subject = createSubject(store, api, attempt, { derive, simulations, rewind: () => clock.seek(0) });
  const speech = createSpeech(store, api, (task) => attempt("page", task), ["methods"]);
  return {
    ...subject,
    ...createAdjustments(store, simulations.ask),
    ...createReading(store, speech.need),
    start: createStart(store, api, attempt, speech, subject.choose),
    /** Texts that are wanted from now on. */
    need: speech.need,
    /** @param {import("./types.js").Lang} lang */
    async language(lang) {
      await speech.speak(lang);
      await derive();
      simulations.ask();
    },
    /** @param {import("./types.js").Formulation} formulation the principle behind the equations */
    async formulate(formulation) {
      move({ formulation });
      await derive();
    },
    /** Another chapter behind the others, opened at its first step. @param {import("./types.js").More} more */
    async tellMore(more) {
      move({ more });
      await derive();
      const first = get().derivation?.chapters.find(({ id }) => id === more)?.steps[0];
      if (first) move({ step: first.id });
    },
    /** Lets go in thought of what the scene holds, and opens the chapter on what holds it. @param {string} release its name, or "" */
    async release(release) {
      move({ release });
      simulations.ask();
      await derive();
      const last = get()
        .derivation?.chapters.find(({ id }) => id === "reactions")
        ?.steps.at(-1);
      if (last) move({ step: last.id });
    },
    /** @param {Partial<Place>} patch */
    move(patch) {
      speech.needFor(patch);
      move(patch);
    },
    /** A place that was left: only what has changed since is asked for again. @param {Place} there */
    async restore(there) {
      const { place } = get();
      const differs = (/** @type {(keyof Place)[]} */ ...keys) => keys.some((key) => there[key] !== place[key]);
      speech.needFor(there);
      set({ place: there, overlay: "" });
      if (differs("scene", "n")) return subject.choose(there.scene, there.step, there.n, there.set);
      if (differs("set")) set({ changes: readChanges(there.set), held: null });
      if (differs("set", "method", "duration", "release")) simulations.ask();
      if (differs("formulation", "more", "release")) await derive();
    },
    /** @param {Partial<Place>} patch how to simulate */
    resimulate(patch) {
      move(patch);
      simulations.ask();
    },
    /** A motion beside the present one. @param {import("./types.js").Changes} changes @param {string} method */
    run: (changes, method) => sampled(api.simulate)(requestOf(get(), changes, method)),
    /** @param {State["runs"]} runs */
    compare: (runs) => set({ runs }),
  };
}

/** @typedef {ReturnType<typeof createSession>} Session */
