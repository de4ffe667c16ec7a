/** The whole drawing at a moment: every element of the scene, in the order in which it lies on the paper. */

import { axesOf } from "./axes.js";
import { circle } from "./geometry.js";
import { coordinate, unshown } from "./coordinates.js";
import { homesOf } from "./homes.js";
import { ground, guide, pivot, wall, wire } from "./supports.js";
import { bob, cart, disc, hoop } from "./bodies.js";
import { damper, rod, spring, string } from "./members.js";
import { angle, dimension, force, moment, weight } from "./marks.js";
import { sketchOf, verticalOf } from "./sketch.js";
import { azimuth, polar, top, wheel } from "./space.js";
import { trail } from "./trail.js";

/** @typedef {import("../types.js").Figure} Figure */
/** @typedef {import("../types.js").Snapshot} Snapshot */
/** @typedef {import("./stage.js").Stage} Stage */

/** Kinds of elements, undermost first. */
export const KINDS = {
  ground,
  wall,
  wire,
  trail,
  dimension,
  angle,
  coordinate,
  polar,
  azimuth,
  guide,
  damper,
  spring,
  hoop,
  wheel,
  top,
  rod,
  string,
  cart,
  block: cart,
  disc,
  moment,
  weight,
  force,
  pivot,
  bob,
};
const ORDER = Object.keys(KINDS);

/**
 * @param {Stage} stage @param {Snapshot} now
 * @returns {Figure}
 */
export function figureOf(stage, now) {
  const figures = stage
    .once("elements", () => inOrder(stage))
    .map(({ draw, element, key }) => draw(element, stage, now, key));
  const axes = stage.once("axes", () => axesOf(stage));
  return {
    shapes: [...axes.shapes, ...ending(stage), ...figures.flatMap((f) => f.shapes)],
    labels: [...axes.labels, ...figures.flatMap((f) => f.labels)],
  };
}

/** A ring where an event ends the motion. @param {Stage} stage @returns {Figure["shapes"]} */
function ending({ scene, trajectory, project, unit }) {
  const at = scene.events?.find(({ name }) => name === trajectory.event?.name)?.at;
  const place = at && trajectory.positions[at]?.at(-1);
  return place ? [{ key: "event", d: circle(unit * 1.6), className: "reference", at: project(place) }] : [];
}

/** What a drawing says, with the coordinates and the weights that it does not show itself. @param {Stage} stage */
function elementsOf({ scene }) {
  const elements = scene.drawing?.elements ?? [];
  const gravity = scene.loads.find(({ kind }) => kind === "gravity")?.name;
  const shown = elements.some(({ kind, load }) => kind === "weight" || (kind === "force" && load === gravity));
  const weights = gravity && !shown ? [{ kind: "force", load: gravity }] : [];
  return [...elements, ...unshown(scene, elements), ...weights];
}

/** @param {Stage} stage */
function inOrder(stage) {
  const elements = elementsOf(stage);
  const homes = homesOf(stage.scene, elements);
  return elements
    .map((element, index) => ({
      element: homes[index] ? { ...element, marks: homes[index] } : element,
      key: `${element.kind}${index}`,
      draw: KINDS[/** @type {keyof typeof KINDS} */ (element.kind)],
    }))
    .filter(({ draw }) => draw)
    .sort((a, b) => ORDER.indexOf(a.element.kind) - ORDER.indexOf(b.element.kind));
}

/**
 * A scene that brings no drawing gets one from its motion, and one that does not say what is up gets that from gravity.
 * @param {import("../types.js").Scene} scene @param {import("../types.js").Trajectory} trajectory
 * @returns {import("../types.js").Scene}
 */
export function withDrawing(scene, trajectory) {
  const { vertical, elements } = scene.drawing ?? {};
  if (elements?.length && vertical) return scene;
  const drawn = elements?.length ? elements : sketchOf(scene, trajectory);
  return { ...scene, drawing: { ...scene.drawing, vertical: verticalOf(scene), elements: drawn } };
}
