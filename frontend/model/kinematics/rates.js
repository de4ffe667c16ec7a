/** Rates of the coordinates from their samples: the slope of the curve that joins them. */

import { blendAt, endOf, scalarAt } from "../trajectory.js";

/** Seconds to either side: the rounding of the samples and the bend of the curve matter equally little. */
const H = 1e-3;

/**
 * @param {import("../types.js").Trajectory} trajectory @param {number} t
 * @returns {Record<string, number>} in units per second
 */
export function ratesAt(trajectory, t) {
  const [from, to] = [Math.max(trajectory.t[0], t - H), Math.min(endOf(trajectory), t + H)];
  const [before, after] = [blendAt(trajectory.t, from), blendAt(trajectory.t, to)];
  const slope = (/** @type {number[]} */ values) => (scalarAt(values, after) - scalarAt(values, before)) / (to - from || 1);
  return Object.fromEntries(Object.entries(trajectory.coordinates).map(([name, values]) => [name, trajectory.rates?.[name] ? scalarAt(trajectory.rates[name], blendAt(trajectory.t, t)) : slope(values)]));
}
