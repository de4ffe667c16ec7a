/** Two motions of one scene on one stage: the student's and the right one. */

import { viewOf } from "../drawing/stage.js";
import { coordinateAt, endOf } from "../trajectory.js";

/** @typedef {import("../types.js").Scene} Scene */
/** @typedef {import("../types.js").Trajectory} Trajectory */

/**
 * The scene with a fixed frame that holds both motions, so that both are drawn to the same scale.
 * @param {Scene} scene @param {Trajectory[]} motions @returns {Scene}
 */
export function framed(scene, motions) {
  const paths = motions.flatMap(({ positions }) => Object.entries(positions));
  const together = {
    ...motions[0],
    positions: Object.fromEntries(paths.map(([name, path], i) => [`${i}/${name}`, path])),
  };
  return { ...scene, drawing: { ...scene.drawing, view: viewOf(scene, together) } };
}

/** When two motions have visibly parted; null if they never do. @param {Trajectory} one @param {Trajectory} other @param {number} [least] */
export function parting(one, other, least = 0.02) {
  const names = Object.keys(one.coordinates);
  const end = Math.min(endOf(one), endOf(other));
  const reach = names
    .flatMap((name) => one.coordinates[name])
    .reduce((most, value) => Math.max(most, Math.abs(value)), 1e-9);
  const apart = (/** @type {number} */ t) =>
    names.some((name) => Math.abs(coordinateAt(one, name, t) - coordinateAt(other, name, t)) > least * reach);
  return one.t.find((t) => t <= end && apart(t)) ?? null;
}
