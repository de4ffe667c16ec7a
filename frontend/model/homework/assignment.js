/** An assignment as a file (JSON or TOML), and as the end of an address that opens it. */

import { documentIn, fragmentOf, tableOf } from "../own.js";

/** @typedef {import("./sheet.js").Assignment} Assignment */

const START = "#a=";
const SCENE = "#s=";

/** Only the shape by which it is known; what is wrong in it, the server says. @param {unknown} value @returns {Assignment | null} */
function assignmentOf(value) {
  const given = tableOf(value);
  return given && Array.isArray(given.tasks) ? /** @type {Assignment} */ (/** @type {unknown} */ (given)) : null;
}

/** @param {Assignment} assignment */
export const fragmentOfAssignment = async (assignment) => START + (await fragmentOf(assignment)).slice(SCENE.length);

/**
 * The assignment in a file's text or in the fragment of an address; null if it is none.
 * @param {string} text @param {string} name @param {Pick<import("../api.js").Api, "readToml">} api @param {import("../types.js").Lang} lang
 */
export async function assignmentIn(text, name, api, lang) {
  if (text.startsWith(START)) return assignmentOf(await documentIn(SCENE + text.slice(START.length)));
  if (name.endsWith(".toml")) return assignmentOf((await api.readToml(text, lang).catch(() => null))?.scene);
  try {
    return assignmentOf(JSON.parse(text));
  } catch {
    return null;
  }
}
