/** The address of the page "Homework": scene, task, the student's own values, and which side of the page is open. */

import { HOME, readPlace, writePlace } from "../url.js";

/** @typedef {Omit<Asked, "place"> & {place: import("../types.js").Address}} Address  what an address says of it: perhaps no language */
/** @typedef {"task" | "working" | "handin" | "sheet" | "class"} Side  one answer, a whole working, what is handed in; for teachers a sheet in the making, or the table of a class */
/** @typedef {{task: string, seed: string, side: Side, place: import("../types.js").Place}} Asked */

export const SIDES = /** @type {const} */ (["task", "working", "handin", "sheet", "class"]);
export const FIRST_SCENE = "pendulum";
const LONGEST = 64;

/** @param {string} query @returns {Address} */
export function readAsked(query) {
  const given = new URLSearchParams(query);
  const { scene, lang, theme } = readPlace(query);
  const side = SIDES.find((one) => one === given.get("side")) ?? "task";
  const text = (/** @type {string} */ key) => (given.get(key) ?? "").slice(0, LONGEST);
  return { task: text("task"), seed: text("seed"), side, place: { ...HOME, scene, lang, theme } };
}

/** The query; what is as usual is left out. @param {Asked} asked */
export function writeAsked({ task, seed, side, place }) {
  const { scene, lang, theme } = place;
  const start = writePlace({ ...HOME, scene, lang, theme });
  const rest = Object.entries({ task, seed, side: side === "task" ? "" : side }).filter(([, value]) => value);
  const own = rest.map(([key, value]) => `${key}=${encodeURIComponent(value).replaceAll("%3A", ":")}`).join("&");
  return own ? `${start}${start ? "&" : "?"}${own}` : start;
}

/**
 * Where the derivation shows the answer: an address of the scene's own page, if the scene is one of the library as it is.
 * @param {string} scene @param {string} step @param {import("../types.js").Place} place
 */
export const stepAddress = (scene, step, { lang, theme }) =>
  `/scene${writePlace({ ...HOME, scene, step, lang, theme })}`;
