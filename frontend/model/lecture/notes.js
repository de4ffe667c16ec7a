/** The lecturer's notes: one text for each step of a scene, kept in the browser. */

import { tableOf } from "../own.js";

/** @typedef {Record<string, Record<string, string>>} Notes  by scene, by step */
/** @typedef {import("../own.js").Keeper} Keeper */

const KEY = "deltaq.notes.1";

/** @param {Keeper} keeper @returns {Notes} */
export function readNotes(keeper) {
  try {
    return /** @type {Notes} */ (tableOf(JSON.parse(keeper.getItem(KEY) ?? "{}")) ?? {});
  } catch {
    return {};
  }
}

/** @param {Notes} notes @param {string} scene @param {string} step */
export function noteOf(notes, scene, step) {
  const text = notes[scene]?.[step];
  return typeof text === "string" ? text : "";
}

/** @param {Notes} notes @param {string} scene @param {string} step @param {string} text @returns {Notes} */
export function withNote(notes, scene, step, text) {
  const { [step]: _, ...others } = notes[scene] ?? {};
  return { ...notes, [scene]: text ? { ...others, [step]: text } : others };
}

/** False where the browser keeps nothing. @param {Keeper} keeper @param {Notes} notes */
export function keepNotes(keeper, notes) {
  try {
    keeper.setItem(KEY, JSON.stringify(notes));
    return true;
  } catch {
    return false;
  }
}
