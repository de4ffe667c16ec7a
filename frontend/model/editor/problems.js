/** Where each problem of a scene is shown: at its field, else at its row, its section, or on top. */

import { SECTIONS, shownFields } from "./schema.js";

/** @typedef {import("../types.js").Problem} Problem */

const HEAD = ["/id", "/title", "/summary", "/dimension", "/drawing"];

/**
 * The problems by the pointer they are shown at; "" is the top of the form.
 * @param {readonly Problem[]} problems @param {import("../own.js").SceneDocument} document
 * @returns {Map<string, Problem[]>}
 */
export function placed(problems, document) {
  const rows = SECTIONS.flatMap(({ key }) => [
    `/${key}`,
    ...(Array.isArray(document[key]) ? document[key].map((_, i) => `/${key}/${i}`) : []),
  ]);
  const known = new Set([...HEAD, ...rows, ...shownFields(document).map(({ pointer }) => pointer)]);
  /** @type {Map<string, Problem[]>} */
  const all = new Map();
  for (const problem of problems) {
    const place = nearest(problem.pointer, known);
    all.set(place, [...(all.get(place) ?? []), problem]);
  }
  return all;
}

/** The pointer itself if it is shown, else the first component of its vector, else what it lies in. @param {string} pointer @param {Set<string>} known */
function nearest(pointer, known) {
  if (known.has(`${pointer}/0`) && !/^\/[a-z]+$/.test(pointer)) return `${pointer}/0`;
  for (let place = pointer; place; place = place.slice(0, place.lastIndexOf("/"))) {
    if (known.has(place)) return place;
  }
  return "";
}

/** @param {Problem} problem */
export const isWarning = (problem) => problem.severity === "warning";

/**
 * A text in three parts: before, at and after the place of a problem; a place past its end is marked by a blank.
 * @param {string} text @param {Pick<Problem, "offset" | "length">} problem
 * @returns {[string, string, string] | null}
 */
export function marked(text, { offset, length }) {
  if (offset === null || offset === undefined) return null;
  const letters = [...text];
  const end = Math.min(letters.length, offset + Math.max(1, length ?? 1));
  const at = letters.slice(offset, end).join("");
  return [letters.slice(0, offset).join(""), at || "\u00a0", letters.slice(end).join("")];
}
