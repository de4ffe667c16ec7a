/** What the page knows, and with what it begins. */

import { HOME } from "./url.js";
import { UNCHANGED } from "./values.js";

/** @typedef {import("./types.js").Failure} Failure */
/**
 * @typedef {object} State
 * @property {import("./types.js").Place} place
 * @property {import("./types.js").Catalog} catalog
 * @property {import("./types.js").SceneEntry[]} scenes
 * @property {import("./types.js").Method[]} methods
 * @property {import("./types.js").Scene | null} scene
 * @property {import("./own.js").SceneDocument | null} own  the viewer's own scene
 * @property {string} fragment  the same, as the end of an address
 * @property {import("./types.js").Derivation | null} derivation
 * @property {import("./reveal.js").Line[]} lines  the derivation's steps in order
 * @property {import("./types.js").Trajectory | null} trajectory
 * @property {import("./types.js").Changes} changes
 * @property {{key: string, asked: number} | null} held  a number typed beyond what the scene allows, and the slider that holds it
 * @property {{page: Failure | null, scene: Failure | null, derivation: Failure | null, simulation: Failure | null, export: Failure | null}} failures
 * @property {import("./figure/runs.js").Run[]} runs  motions kept beside the present one
 * @property {boolean} simulating
 * @property {import("./types.js").Overlay} overlay
 */

/** @typedef {ReturnType<typeof import("./store.js").createStore<State>>} Store */
/** @typedef {(part: keyof State["failures"], task: () => Promise<void>) => Promise<void>} Attempt  runs a task; what goes wrong is kept for the view of its part */

/** @type {State["failures"]} */
export const NO_FAILURES = { page: null, scene: null, derivation: null, simulation: null, export: null };

/** @type {State} */
export const START = {
  place: { ...HOME, lang: "en" },
  catalog: {},
  scenes: [],
  methods: [],
  scene: null,
  own: null,
  fragment: "",
  derivation: null,
  lines: [],
  trajectory: null,
  changes: UNCHANGED,
  held: null,
  runs: [],
  failures: NO_FAILURES,
  simulating: false,
  overlay: "",
};

/** The scene shown first: the lecture's main example, else any. @param {import("./types.js").SceneEntry[]} scenes */
export function preferred(scenes) {
  return (scenes.find((scene) => scene.id === "elastic-pendulum") ?? scenes[0])?.id ?? "";
}
