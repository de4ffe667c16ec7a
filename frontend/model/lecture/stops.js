/** Where a lecture stops: at each step, and in between at each of its substeps. */

import { indexOf } from "../reveal.js";

/** @typedef {import("../types.js").Step} Step */
/** @typedef {import("../reveal.js").Line} Line */
/** @typedef {import("../types.js").Pace} Pace */
/**
 * part: how many substeps are shown. Without any there is the result alone; with them it comes last, as one part more.
 * @typedef {{step: string, part: number}} Stop
 */

/** The substeps of a step in the order in which they are read, with how deep they lie. @param {Step} step @param {number} [depth] @returns {{step: Step, depth: number}[]} */
export function partsOf(step, depth = 0) {
  return (step.substeps ?? []).flatMap((part) => [{ step: part, depth }, ...partsOf(part, depth + 1)]);
}

/**
 * Where the lecture goes on by `by` stops, held at both ends: by steps, or through all substeps.
 * Going back to a step shows it as it was left: complete where the lecture goes through the substeps.
 * @param {readonly Line[]} lines @param {Stop} at @param {number} by @param {Pace} pace
 * @returns {Stop}
 */
export function onwards(lines, at, by, pace) {
  if (!lines.length) return at;
  const stops = lines.flatMap((line) => stopsOf(line, pace));
  const index = indexOf(lines, at.step);
  const passed = stops.filter((stop) => stop.index < index || (stop.index === index && stop.part <= at.part)).length;
  // Before the first stop of a step one comes back to the one before it.
  const before = !stops.some((stop) => stop.index === index && stop.part <= at.part);
  const to = passed - 1 + by + (before && by < 0 ? 1 : 0);
  const { step, part } = stops[Math.max(0, Math.min(stops.length - 1, to))];
  return { step, part };
}

/** @param {Line} line @param {Pace} pace */
function stopsOf({ step, index }, pace) {
  const last = pace === "substeps" ? lastPart(step) : 0;
  if (!last) return [{ step: step.id, part: 0, index }];
  return Array.from({ length: last }, (_, i) => ({ step: step.id, part: i + 1, index }));
}

/** The part with which all of a step is shown. @param {Step} step */
function lastPart(step) {
  const count = partsOf(step).length;
  return count && count + 1;
}

/** Whether the result of a step is shown: its substeps come before. @param {Step} step @param {number} part */
export const isConcluded = (step, part) => part === 0 || part >= lastPart(step);

/** One substep more or less of the same step, its result after the last. @param {readonly Line[]} lines @param {Stop} at @param {number} by @returns {Stop} */
export function within(lines, { step, part }, by) {
  const line = lines[indexOf(lines, step)];
  const most = line ? lastPart(line.step) : 0;
  return { step, part: Math.max(0, Math.min(most, Math.min(part, most) + by)) };
}

/** All substeps of the step, or none if they are all shown. @param {readonly Line[]} lines @param {Stop} at @returns {Stop} */
export function allOrNone(lines, at) {
  const full = within(lines, at, Infinity);
  return { step: at.step, part: at.part >= full.part ? 0 : full.part };
}

/**
 * The steps that are meant by "3.2", "3" or a word of the title.
 * @param {readonly Line[]} lines @param {string} text
 * @returns {Line[]}
 */
export function meant(lines, text) {
  const wanted = text.trim().toLowerCase();
  if (!wanted) return [...lines];
  if (/^\d+([.,]\d*)?$/.test(wanted)) {
    const number = wanted.replace(",", ".");
    const exact = lines.filter((line) => line.number === number);
    return exact.length
      ? exact
      : lines.filter((line) => line.number.startsWith(number.includes(".") ? number : `${number}.`));
  }
  return lines.filter((line) => `${line.step.title} ${line.chapter.title}`.toLowerCase().includes(wanted));
}
