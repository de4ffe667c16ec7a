/** What is asked of the server about the motion. */

import { OWN } from "./own.js";

/** Samples per second, the step where one is asked for, and the parts of the answer that are shown. */
const RATE = 25;
const MOST = 2001;
const STEP = 0.01;
const PARTS = ["coordinates", "positions", "loads", "energy", "error"];

/** What requests call the scene: its id, or the whole of it. @param {import("./state.js").State} state */
export const sceneOf = ({ place, own }) => (place.scene === OWN ? own : place.scene);

/**
 * @param {import("./state.js").State} state @param {import("./types.js").Changes} changes @param {string} chosen method, "" for the automatic choice
 */
export function requestOf(state, changes, chosen) {
  const { duration, lang, n } = state.place;
  const method = state.methods.find((candidate) => candidate.id === chosen);
  return {
    scene: sceneOf(state), ...changes, parameters: { ...changes.parameters, ...(n ? { n } : {}) }, t_end: duration,
    samples: Math.min(MOST, duration * RATE + 1), include: PARTS, lang,
    ...(method ? { method: method.id } : {}),
    ...(method && method.adaptive === false ? { step: STEP } : {}),
  };
}
