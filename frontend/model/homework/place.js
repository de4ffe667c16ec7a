/** The address of the page "Homework": scene, task, the student's own values, and which side of the page is open. */

import { HOME, readPlace, writePlace } from "../url.js";

/** @typedef {Omit<Asked, "place"> & {place: import("../types.js").Address}} Address  what an address says of it: perhaps no language */
/** @typedef {"task" | "working" | "practice" | "handin" | "sheet" | "class"} Side  one answer, a whole working, exercises without end, what is handed in; for teachers a sheet in the making, or the table of a class */
/** @typedef {{series: string, level: number, number: number, recall: string, kind: string}} Drill  an exercise drawn at random; `number` is 0 where none has been chosen, `recall` a misconception that it brings back */
/** @typedef {{task: string, seed: string, side: Side, drill: Drill, place: import("../types.js").Place}} Asked */

export const SIDES = /** @type {const} */ (["task", "working", "practice", "handin", "sheet", "class"]);
/** @type {Drill} */
export const NO_DRILL = { series: "", level: 1, number: 0, recall: "", kind: "" };
export const LEVELS = [1, 2, 3, 4, 5, 6];
export const FIRST_SCENE = "pendulum";
const LONGEST = 64;

/** @param {string} query @returns {Address} */
export function readAsked(query) {
  const given = new URLSearchParams(query);
  const { scene, lang, theme } = readPlace(query);
  const named = SIDES.find((one) => one === given.get("side")) ?? "task";
  const side = given.has("practice") ? "practice" : named;
  const text = (/** @type {string} */ key) => (given.get(key) ?? "").slice(0, LONGEST);
  const asked = { task: text("task"), seed: text("seed"), side, place: { ...HOME, scene, lang, theme } };
  return { ...asked, drill: side === "practice" ? readDrill(given, text) : NO_DRILL };
}

/** @param {URLSearchParams} given @param {(key: string) => string} text @returns {Drill} */
function readDrill(given, text) {
  const whole = (/** @type {string} */ key) =>
    /^[1-9]\d{0,5}$/.test(given.get(key) ?? "") ? Number(given.get(key)) : 0;
  const level = LEVELS.find((one) => one === whole("level")) ?? 1;
  return {
    series: text("series"),
    level,
    number: text("series") ? whole("number") : 0,
    recall: text("recall"),
    kind: text("kind"),
  };
}

/** The query; what is as usual is left out. @param {Asked} asked */
export function writeAsked({ task, seed, side, drill, place }) {
  const { scene, lang, theme } = place;
  const { series, level, number, recall, kind } = drill;
  const start = writePlace({ ...HOME, scene, lang, theme });
  const open =
    side === "practice"
      ? { side, ...(drill.number ? { series, level, number, recall, kind } : {}) }
      : { task, seed, side: side === "task" ? "" : side };
  const rest = Object.entries(open).filter(([, value]) => value);
  const own = rest.map(([key, value]) => `${key}=${encodeURIComponent(value).replaceAll("%3A", ":")}`).join("&");
  return own ? `${start}${start ? "&" : "?"}${own}` : start;
}

/** The name of an exercise: the same one has the same name. @param {Drill} drill */
export const drillName = ({ series, level, number, recall, kind }) =>
  ["practice~", series, level, number, recall, kind].join("~");

/**
 * Where the derivation shows the answer: an address of the scene's own page, if the scene is one of the library as it is.
 * @param {string} scene @param {string} step @param {import("../types.js").Place} place
 */
export const stepAddress = (scene, step, { lang, theme }) =>
  `/scene${writePlace({ ...HOME, scene, step, lang, theme })}`;
