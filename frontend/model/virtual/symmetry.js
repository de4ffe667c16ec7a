/** What the symmetry behind an integral shifts or turns, as a variation of the coordinates that the drawing can show. */

import { evaluator } from "../kinematics/expression.js";
import { reachOf } from "./choice.js";

/** @typedef {NonNullable<import("../types.js").Derivation["result"]>} Result */
/** @typedef {import("../kinematics/expression.js").Values} Values */

/** Part of its reach by which the coordinate is varied that moves farthest. */
const PART = 0.3;

/** The integral that a step shows, where its symmetry moves coordinates and not the time. @param {Result | undefined} result @param {string} step */
export const shiftedBy = (result, step) =>
  result?.conserved.find(
    ({ step: shown, generator }) =>
      shown === step && generator.time.plain === "0" && Object.keys(generator.shifts).length > 0,
  );

/**
 * δq = ε ξ(q, t), with ε such that it is seen.
 * @param {Result["conserved"][number]} integral @param {import("../types.js").Coordinate[]} free @param {Values} values of coordinates, parameters and t
 * @returns {import("./choice.js").Choice}
 */
export function variationBy({ generator }, free, values) {
  const shift = Object.fromEntries(
    free.map(({ name }) => [name, evaluator(generator.shifts[name]?.plain ?? "0")(values)]),
  );
  const parts = free.map((each) => Math.abs(shift[each.name]) / reachOf(each)).filter(Number.isFinite);
  const size = PART / (Math.max(...parts) || 1);
  return { delta: Object.fromEntries(free.map(({ name }) => [name, size * shift[name] || 0])), dt: 0 };
}
