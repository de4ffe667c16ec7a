/** What is asked of the server about the motion. */

import { asTyped, OWN } from "./own.js";
import { samplesFor } from "./sampling.js";

/** Samples per second to begin with, the step where one is asked for, and the parts of the answer that are shown. */
const RATE = 24;
const STEP = 0.01;
/** The server sends no more. */
const MOST = 20001;
/** @type {import("./types.js").Parts} */
const PARTS = ["coordinates", "rates", "positions", "loads", "multipliers", "energy", "error"];

/** What requests call the scene: its id, or the whole of it. @param {import("./state.js").State} state */
export const sceneOf = ({ place, own }) => (place.scene === OWN ? own && asTyped(own) : place.scene);

/**
 * @param {import("./state.js").State} state @param {import("./types.js").Changes} changes @param {string} chosen method, "" for the automatic choice
 */
export function requestOf(state, changes, chosen) {
  const { duration, lang, n, release } = state.place;
  const method = state.methods.find((candidate) => candidate.id === chosen);
  const fixed = method?.adaptive === false;
  return {
    scene: sceneOf(state) ?? OWN,
    ...changes,
    parameters: { ...changes.parameters, ...(n ? { n } : {}) },
    t_end: duration,
    samples: fixed ? Math.min(MOST, Math.round(duration / STEP) + 1) : samplesFor(duration * RATE + 1),
    include: PARTS,
    ...(release ? { release: release.split(",") } : {}),
    lang,
    ...(method ? { method: method.id } : {}),
    ...(fixed ? { step: STEP } : {}),
  };
}
