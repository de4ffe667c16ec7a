/** What the page "Homework" knows, and with what it begins. */

import { BLANK } from "./progress.js";

/** @typedef {import("../types.js").Failure} Failure */
/** @typedef {import("../types.js").Trajectory} Trajectory */
/** @typedef {{of: string, latex: string, plain: string, problems: import("./progress.js").AnswerProblem[], readings: import("./progress.js").PossibleReading[]}} Reading  what the text `of` is understood as */
/** @typedef {{plain: string[], latex: string[], step: import("../types.js").Step | null}} Solution */
/** @typedef {import("../types.js").Contract["MarkedLine"]} Mark */
/** @typedef {{of: string, lines: Mark[], first_wrong: number | null, points: number, total: number}} Marked  `of` is the working that was marked */
/**
 * @typedef {object} State
 * @property {import("./place.js").Asked} asked
 * @property {import("../types.js").Catalog} catalog
 * @property {import("../types.js").SceneEntry[]} scenes
 * @property {import("./sheet.js").Assignment | null} assignment
 * @property {import("../own.js").SceneDocument | null} own  a scene that the address brings along
 * @property {import("./sheet.js").Sheet | null} sheet
 * @property {Failure | null} failure  why there is no sheet
 * @property {import("./sheet.js").Entry | null} entry  the task on the page
 * @property {string[]} guides  what the scene prescribes, as LaTeX
 * @property {import("./progress.js").Draft} draft
 * @property {Reading | null} reading
 * @property {"" | "checking" | "solving" | "moving" | "marking"} busy
 * @property {Failure | null} trouble  why the last request came to nothing
 * @property {string} notice  the key of a sentence
 * @property {Solution | null} solution
 * @property {Trajectory | null} right
 * @property {boolean} still  there is no motion of the scene, for the server did not compute one
 * @property {Trajectory | null} answered  as the answer says
 * @property {import("./progress.js").Line[]} lines  the whole working
 * @property {Marked | null} marked
 * @property {boolean} kept  whether the browser keeps what is typed
 */

/** What belongs to one task. @type {Pick<State, "reading" | "busy" | "trouble" | "notice" | "solution" | "answered">} */
export const FRESH = { reading: null, busy: "", trouble: null, notice: "", solution: null, answered: null };

/** @param {import("./place.js").Asked} asked @returns {State} */
export const begin = (asked) => ({
  asked,
  catalog: {},
  scenes: [],
  assignment: null,
  own: null,
  sheet: null,
  failure: null,
  entry: null,
  guides: [],
  draft: BLANK,
  ...FRESH,
  right: null,
  still: false,
  lines: [],
  marked: null,
  kept: true,
});

/** @typedef {ReturnType<typeof import("../store.js").createStore<State>>} Store */
/** @typedef {import("../api.js").Api} Api */
