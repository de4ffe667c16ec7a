/** The curves of the plots as a table: a line for each moment, as CSV (RFC 4180). */

import { before } from "../curve.js";
import { readingOf } from "../curves.js";

/** @typedef {import("../curves.js").Row} Row */

/** @param {string} text */
const field = (text) => (/[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text);

/** Without digits that are not known, and without a negative zero. @param {number} value @param {number} decimals */
const written = (value, decimals) => (Number.isFinite(value) ? String(Number(value.toFixed(decimals)) + 0) : "");

/**
 * What is seen: curves that are shown, in the part of the time that is shown, at the moments of the motion's samples, at a
 * jump on both of its sides; a
 * curve of another run has its values at the same moments, and none beyond its end. The last digit of a value is the first in doubt.
 * @param {readonly Row[]} rows @param {(curve: import("../curves.js").Curve) => boolean} isShown @returns {string}
 */
export function tableOf(rows, isShown) {
  const shown = rows.flatMap(({ unit, curves }) => curves.filter(isShown).map((curve) => ({ curve, unit })));
  const times = shown.find(({ curve }) => !curve.beside)?.curve.times ?? [];
  /** How many runs beside have had this curve already. @type {Map<string, number>} */
  const runs = new Map();
  const names = shown.map(({ curve, unit }) => {
    if (curve.beside) runs.set(curve.key, (runs.get(curve.key) ?? 1) + 1);
    return `${curve.key}${curve.beside ? ` (${runs.get(curve.key)})` : ""} in ${unit || "1"}`;
  });
  const value = (/** @type {typeof shown[number]} */ { curve }, /** @type {number} */ t) =>
    t >= curve.times[0] && t <= curve.times[curve.times.length - 1]
      ? written(readingOf(curve, t), curve.decimals(t))
      : "";
  // A time that stands twice is that of a jump: before it, and behind it.
  const lines = times.map((t, i) => [
    String(t),
    ...shown.map((one) => value(one, t === times[i + 1] && t > 0 ? before(t) : t)),
  ]);
  return [["t in s", ...names].map(field), ...lines].map((line) => `${line.join(",")}\r\n`).join("");
}
