/** A lecture as it is given: at which stop, what of it is shown, and what a key leads to. */

import { indexOf } from "../reveal.js";
import { onwards } from "../lecture/stops.js";
import { beginningOf, frameOf, hasSteps } from "./place.js";

/** @typedef {import("./lecture.js").Stop} Stop */
/** @typedef {import("../lecture/stops.js").Stop} Step  a step, and how many of its substeps are shown */
/** @typedef {"asked" | "answered" | "shown"} Phase  with its result hidden or its poll open; the answer given; all of it */
/** @typedef {{index: number, phase: Phase, left: Record<number, Step>}} Given  left: where stops were left, by number */
/** @typedef {{lines: readonly import("../reveal.js").Line[], at: Step, pace: import("../types.js").Pace}} Here  where the frame of the stop stands */
/** @typedef {{given: Given, go?: number}} Led  go: by so many steps within the derivation; else the stop may be another one */

/** @param {Stop | undefined} stop @returns {Phase} */
const firstPhase = (stop) => (stop?.poll || stop?.hide ? "asked" : "shown");

/** @param {readonly Stop[]} stops @param {number} [index] @returns {Given} */
export function started(stops, index = 0) {
  const at = Math.max(0, Math.min(stops.length - 1, index));
  return { index: at, phase: firstPhase(stops[at]), left: {} };
}

/** Where a stop begins: at its step, else at the first one. @param {Stop} stop @param {Here | null} here @returns {Step} */
export function beginning(stop, here) {
  const { step, part } = beginningOf(stop.place);
  return { step: step || here?.lines[0]?.step.id || "", part };
}

/** Which of two places of a derivation comes first. @param {Here} here @param {Step} one @param {Step} other */
function before({ lines }, one, other) {
  const [a, b] = [indexOf(lines, one.step), indexOf(lines, other.step)];
  return a < b || (a === b && one.part < other.part);
}

/**
 * Whether a key goes on within the stop: through the steps that lead to the next one, or through substeps where the
 * lecture goes through them.
 * @param {readonly Stop[]} stops @param {Given} given @param {Here | null} here
 */
function goesOnWithin(stops, { index }, here) {
  if (!here?.lines.length || !hasSteps(stops[index].place)) return false;
  const next = onwards(here.lines, here.at, 1, here.pace);
  if (next.step === here.at.step && next.part === here.at.part) return false;
  const following = stops[index + 1];
  const leads = following && frameOf(following.place) === frameOf(stops[index].place);
  const target = leads ? beginning(following, here) : null;
  return target && before(here, here.at, target) ? before(here, next, target) : next.step === here.at.step;
}

/** To a stop as it begins. @param {readonly Stop[]} stops @param {Given} given @param {number} index @param {Here | null} here @returns {Given} */
export function jumped(stops, given, index, here) {
  const left = here ? { ...given.left, [given.index]: here.at } : given.left;
  const { [index]: _forgotten, ...others } = left;
  return { ...started(stops, index), left: others };
}

/** On: first what is hidden, then the steps in between, then the next stop. @param {readonly Stop[]} stops @param {Given} given @param {Here | null} here @returns {Led} */
export function onward(stops, given, here) {
  const { index, phase } = given;
  if (phase === "asked") return { given: { ...given, phase: stops[index].poll ? "answered" : "shown" } };
  if (phase === "answered") return { given: { ...given, phase: "shown" } };
  if (goesOnWithin(stops, given, here)) return { given, go: 1 };
  return index + 1 < stops.length ? { given: jumped(stops, given, index + 1, here) } : { given };
}

/** Back: through the steps that the stop began with, then to the one before, as it was left. @param {readonly Stop[]} stops @param {Given} given @param {Here | null} here @returns {Led} */
export function backward(stops, given, here) {
  const { index, phase } = given;
  if (phase === "shown" && here?.lines.length && before(here, beginning(stops[index], here), here.at))
    return { given, go: -1 };
  if (index === 0) return { given };
  return { given: { index: index - 1, phase: "shown", left: given.left } };
}

/** What the frame of the stop is to show: where it was left, else where it begins. @param {readonly Stop[]} stops @param {Given} given @returns {Step} */
export const wantedStep = (stops, { index, left }) => left[index] ?? beginningOf(stops[index].place);
