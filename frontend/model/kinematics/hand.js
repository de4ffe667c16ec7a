/** Taking hold of a place: what can be taken, and what it then means for the initial values or for the variation. */

import { wrapped } from "../drawing/geometry.js";
import { coordinateRange } from "../values.js";
import { reached } from "./reach.js";

/** @typedef {import("../types.js").Scene} Scene */
/** @typedef {import("../types.js").Changes} Changes */
/** @typedef {import("../types.js").Pixel} Pixel */
/** @typedef {import("../types.js").Snapshot} Snapshot */
/** @typedef {import("./kinematics.js").Kinematics} Kinematics */
/** @typedef {import("./expression.js").Values} Values */

/** A place that moves less than this many pixels per unit of every coordinate is held by the ground. */
const FIXED = 1;

/**
 * The places that a hand can move: bodies first, and points that are nowhere near a body.
 * @param {Kinematics} kinematics @param {Snapshot} now @param {import("../drawing/stage.js").Stage} stage
 */
export function movable(kinematics, now, stage) {
  const unit = Object.fromEntries(kinematics.free.map((name) => [name, Math.SQRT2]));
  const slope = kinematics.slope(now.coordinates, now.t, unit);
  const { scene } = stage;
  const places = [...scene.bodies, ...scene.points]
    .map(({ name }) => name)
    .filter((name) => slope[name] && now.positions[name]);
  return places.filter((name) => Math.hypot(...stage.direct(slope[name])) > FIXED);
}

/** The nearest of some places within a distance, or "". @param {readonly string[]} places @param {(place: string) => Pixel} where @param {Pixel} hand @param {number} within */
export function nearest(places, where, hand, within) {
  const far = (/** @type {string} */ place) => Math.hypot(where(place)[0] - hand[0], where(place)[1] - hand[1]);
  const found = [...places].sort((a, b) => far(a) - far(b))[0];
  return found !== undefined && far(found) <= within ? found : "";
}

/**
 * The coordinates that bring a place to the hand, angles within one turn, each within its range.
 * @param {{kinematics: Kinematics, scene: Scene, now: Snapshot, stage: import("../drawing/stage.js").Stage}} around
 * @param {string} place @param {Values} q where it is held @param {Pixel} hand
 * @returns {Values}
 */
export function brought({ kinematics, scene, now, stage }, place, q, hand) {
  const found = reached(kinematics, place, q, now.t, hand, stage.project);
  return Object.fromEntries(
    scene.coordinates.map((coordinate) => {
      const value = coordinate.unit === "rad" ? wrapped(found[coordinate.name]) : found[coordinate.name];
      const [low, high] = coordinateRange(coordinate);
      return [
        coordinate.name,
        kinematics.free.includes(coordinate.name) ? Math.max(low, Math.min(high, value)) : value,
      ];
    }),
  );
}

/**
 * The changes with other initial values; rates stay as they are.
 * @param {Changes} changes @param {Scene} scene @param {Kinematics} kinematics @param {Values} q
 * @returns {Changes}
 */
export function startedAt(changes, scene, { free }, q) {
  const rate = (/** @type {string} */ name) =>
    changes.initial[name]?.rate ?? scene.coordinates.find((c) => c.name === name)?.rate ?? 0;
  const initial = Object.fromEntries(
    free.map((name) => [name, { value: Number(q[name].toPrecision(4)), rate: rate(name) }]),
  );
  return { ...changes, initial: { ...changes.initial, ...initial } };
}
