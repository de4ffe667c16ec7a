/** What is varied, and how far: written into the address as "y:0.1,phi:-0.2,dt:0.1". */

import { wrapped } from "../drawing/geometry.js";

/** @typedef {import("../kinematics/expression.js").Values} Values */
/** @typedef {{delta: Values, dt: number}} Choice */

/** Part of a coordinate's range that is varied at first, so that the neighbouring configuration is seen. */
const FIRST = 0.12;
export const LONGEST = 0.4;

/** How far a coordinate can be varied. @param {import("../types.js").Coordinate} coordinate */
export function reachOf({ unit, min, max, value }) {
  if (unit === "rad") return 1;
  return min != null && max != null ? (max - min) / 2 : Math.max(0.5, Math.abs(value));
}

/**
 * @param {string} text @param {import("../types.js").Coordinate[]} free
 * @returns {Choice}
 */
export function readChoice(text, free) {
  const given = new Map(
    text.split(",").map((part) => /** @type {[string, number]} */ ([part.split(":")[0], Number(part.split(":")[1])])),
  );
  const within = (/** @type {number | undefined} */ value, /** @type {number} */ reach) =>
    Math.max(-reach, Math.min(reach, value || 0));
  if (!text.includes(":"))
    return { delta: Object.fromEntries(free.map((each) => [each.name, round(2 * FIRST * reachOf(each))])), dt: 0 };
  return {
    delta: Object.fromEntries(free.map((each) => [each.name, within(given.get(each.name), reachOf(each))])),
    dt: Math.max(0, within(given.get("dt"), LONGEST)),
  };
}

/** @param {Choice} choice */
export function writeChoice({ delta, dt }) {
  return [...Object.entries(delta), ["dt", dt]].map(([name, value]) => `${name}:${round(Number(value))}`).join(",");
}

/** How far the coordinates are from one configuration to another, each within its reach. @param {import("../types.js").Coordinate[]} free @param {Values} from @param {Values} to @returns {Values} */
export function differences(free, from, to) {
  return Object.fromEntries(
    free.map((each) => {
      const far = to[each.name] - from[each.name];
      const reach = reachOf(each);
      return [each.name, Math.max(-reach, Math.min(reach, each.unit === "rad" ? wrapped(far) : far))];
    }),
  );
}

/** @param {number} x */
const round = (x) => Math.round(x * 1000) / 1000;
