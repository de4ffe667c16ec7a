/** Motions that are kept beside the present one: with other values, or by another method. */

import { readChanges, writeChanges } from "../values.js";

/** @typedef {import("../types.js").Changes} Changes */
/** @typedef {import("../types.js").Scene} Scene */
/** @typedef {{changes: Changes, method: string}} Asked  what a run is computed with; no method means the automatic choice */
/** @typedef {Asked & {key: string, trajectory: import("../types.js").Trajectory}} Run */

/** With the present one they are three: more cannot be told apart. */
export const MOST = 2;
/** @type {readonly ("dash" | "dot")[]} */
export const DASHES = ["dash", "dot"];

/** As the address has it: "l:0.5@rk4". @param {Asked} asked */
export const keyOf = ({ changes, method }) => `${writeChanges(changes)}@${method}`;

/** @param {string} text runs joined by "+" @returns {Asked[]} */
export function readRuns(text) {
  return text.split("+").filter((part) => part.includes("@")).slice(0, MOST).map((part) => {
    const [changes, method] = part.split("@");
    return { changes: readChanges(changes), method };
  });
}

/** The address with another run; the oldest makes room, and none is there twice. @param {string} text @param {Asked} asked */
export function withRun(text, asked) {
  const keys = readRuns(text).map(keyOf).filter((key) => key !== keyOf(asked));
  return [...keys, keyOf(asked)].slice(-MOST).join("+");
}

/** @param {string} text @param {string} key */
export const withoutRun = (text, key) => readRuns(text).map(keyOf).filter((other) => other !== key).join("+");

/**
 * What sets some runs apart, for each of them: only what is not the same in all, as "name = value" in LaTeX.
 * @param {readonly Asked[]} runs @param {Scene} scene
 * @returns {string[][]}
 */
export function differences(runs, scene) {
  const symbols = [...scene.parameters, ...scene.coordinates];
  const valueOf = (/** @type {Asked} */ { changes }, /** @type {string} */ name) => changes.parameters[name] ?? changes.initial[name]?.value ?? symbols.find((each) => each.name === name)?.value;
  const differing = symbols.filter(({ name }) => new Set(runs.map((run) => valueOf(run, name))).size > 1);
  const start = (/** @type {string} */ name) => (scene.coordinates.some((each) => each.name === name) ? "(0)" : "");
  return runs.map((run) => differing.map(({ name, latex }) => `${latex || name}${start(name)} = ${Number(valueOf(run, name)?.toPrecision(3))}`));
}
