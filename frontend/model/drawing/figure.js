/** The whole drawing at a moment: every element of the scene, in the order in which it lies on the paper. */

import { ground, guide, pivot } from "./supports.js";
import { bob, cart, disc, rod, spring, trail } from "./members.js";
import { angle, dimension, force, weight } from "./marks.js";

/** @typedef {import("../types.js").Figure} Figure */
/** @typedef {import("../types.js").Snapshot} Snapshot */
/** @typedef {import("./stage.js").Stage} Stage */

/** Kinds of elements, undermost first. */
export const KINDS = {
  ground, trail, dimension, angle, guide, spring, rod, cart, disc, weight, force, pivot, bob,
};
const ORDER = Object.keys(KINDS);

/**
 * @param {Stage} stage @param {Snapshot} now
 * @returns {Figure}
 */
export function figureOf(stage, now) {
  const elements = (stage.scene.drawing?.elements ?? []).map((element, index) => ({ element, key: `${element.kind}${index}` }));
  const figures = elements
    .filter(({ element }) => element.kind in KINDS)
    .sort((a, b) => ORDER.indexOf(a.element.kind) - ORDER.indexOf(b.element.kind))
    .map(({ element, key }) => KINDS[/** @type {keyof typeof KINDS} */ (element.kind)](element, stage, now, key));
  return { shapes: figures.flatMap((f) => f.shapes), labels: figures.flatMap((f) => f.labels) };
}

/** The stretch of places that a scene without a drawing can still show: a bob at every body. @param {import("../types.js").Scene} scene */
export function withDrawing(scene) {
  if (scene.drawing?.elements?.length) return scene;
  const elements = scene.bodies.flatMap((body) => [{ kind: "trail", at: body.name }, { kind: "bob", at: body.name }]);
  return { ...scene, drawing: { ...scene.drawing, elements } };
}
