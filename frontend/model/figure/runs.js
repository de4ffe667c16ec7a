/** Motions that are kept beside the present one: with other values, or by another method. */

import { dotted, readChanges, writeChanges } from "../values.js";

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
  return text
    .split("+")
    .filter((part) => part.includes("@"))
    .slice(0, MOST)
    .map((part) => {
      const [changes, method] = part.split("@");
      return { changes: readChanges(changes), method };
    });
}

/** The address with another run; the oldest makes room, and none is there twice. @param {string} text @param {Asked} asked */
export function withRun(text, asked) {
  const keys = readRuns(text)
    .map(keyOf)
    .filter((key) => key !== keyOf(asked));
  return [...keys, keyOf(asked)].slice(-MOST).join("+");
}

/** @param {string} text @param {string} key */
export const withoutRun = (text, key) =>
  readRuns(text)
    .map(keyOf)
    .filter((other) => other !== key)
    .join("+");

/**
 * What sets some runs apart, for each of them: only what is not the same in all, as "name = value" in LaTeX.
 * @param {readonly Asked[]} runs @param {Scene} scene
 * @returns {string[][]}
 */
export function differences(runs, scene) {
  const quantity = (/** @type {string} */ latex, /** @type {(changes: Changes) => number} */ of) => ({ latex, of });
  const quantities = [
    ...scene.parameters.map(({ name, latex, value }) =>
      quantity(latex || name, ({ parameters }) => parameters[name] ?? value),
    ),
    ...scene.coordinates.flatMap(({ name, latex, value, rate }) => [
      quantity(`${latex || name}(0)`, ({ initial }) => initial[name]?.value ?? value),
      quantity(`${dotted(latex || name)}(0)`, ({ initial }) => initial[name]?.rate ?? rate),
    ]),
  ];
  const differing = quantities.filter(({ of }) => new Set(runs.map(({ changes }) => of(changes))).size > 1);
  return runs.map(({ changes }) =>
    differing.map(({ latex, of }) => `${latex} = ${Number(of(changes).toPrecision(3))}`),
  );
}
