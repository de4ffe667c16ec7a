/** What the hall and the presenter's window of an own lecture tell each other. The hall is where things stand; the window asks. */

import { areStrokes } from "./ink.js";

/** @typedef {import("./ink.js").Point} Point */
/** @typedef {import("./ink.js").Stroke} Stroke */
/**
 * @typedef {object} Standing  of the hall
 * @property {"hall"} kind
 * @property {import("./lecture.js").Lecture} [lecture]  when it was asked for
 * @property {number} index
 * @property {import("./giving.js").Phase} phase
 * @property {import("./giving.js").Step} at
 * @property {boolean} black
 * @property {readonly Stroke[]} ink
 * @property {Point | null} spot
 * @property {[number, number]} size  of what is shown, in pixels
 */
/** @typedef {{kind: "hello"} | {kind: "go", by: 1 | -1} | {kind: "to", index: number} | {kind: "black"} | {kind: "ink", strokes: Stroke[]} | {kind: "spot", at: Point | null}} Wish */
/** @typedef {{postMessage: (message: Standing | Wish) => void, onmessage: ((event: MessageEvent<Standing | Wish>) => void) | null, close: () => void}} Channel */

/** @param {string} id */
export const nameOf = (id) => `deltaq.hall.${id}`;

/**
 * The side of the hall: it says what has changed.
 * @param {Channel} channel @param {import("./lecture.js").Lecture} lecture
 * @param {{standing: () => Omit<Standing, "kind" | "lecture">, wish: (wish: Exclude<Wish, {kind: "hello"}>) => void}} hall
 */
export function createHallLine(channel, lecture, { standing, wish }) {
  let told = "";
  function tell(whole = false) {
    const now = standing();
    const said = JSON.stringify(now);
    if (said === told && !whole) return;
    told = said;
    channel.postMessage({ kind: "hall", ...now, ...(whole ? { lecture } : {}) });
  }
  channel.onmessage = ({ data }) => {
    if (data.kind === "hello") tell(true);
    else if (data.kind === "ink") areStrokes(data.strokes) && wish(data);
    else if (data.kind !== "hall") wish(data);
  };
  return { tell: () => tell(), close: () => channel.close() };
}

/** The window's side. @param {Channel} channel @param {(standing: Standing) => void} hear */
export function createDeskLine(channel, hear) {
  channel.onmessage = ({ data }) => {
    if (data.kind === "hall") hear(data);
  };
  channel.postMessage({ kind: "hello" });
  return { wish: (/** @type {Wish} */ wish) => channel.postMessage(wish) };
}
