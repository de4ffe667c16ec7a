/** The neighbouring configuration as a ghost, and the displacements as arrows. */

import { add, lengthOf, scaled, subtract, unit, normal } from "../drawing/geometry.js";
import { figureOf } from "../drawing/figure.js";
import { arrow } from "../drawing/marks.js";

/** @typedef {import("../types.js").Figure} Figure */
/** @typedef {import("../types.js").Pixel} Pixel */
/** @typedef {import("../types.js").Snapshot} Snapshot */
/** @typedef {import("../drawing/stage.js").Stage} Stage */

/** Only what moves has a ghost; what is written into a drawing has none. */
const MEMBERS = /^(rod|spring|damper|bob|cart|block|disc|hoop|pivot|guide)(?!\d*-(hatch|rail|triangle))/;
/** Arrows below this many units are too short for a head. */
const SHORTEST = 0.5;

/**
 * @param {Stage} stage @param {import("./virtual.js").Virtual} virtual
 * @returns {{under: Figure, over: Figure}}
 */
export function virtualFigure(stage, { varied, later, displacements }) {
  const ghosts = [outline(stage, varied, "ghost-varied"), ...(later ? [outline(stage, later, "ghost-later")] : [])];
  const arrows = displacements.map((displacement) => arrowsOf(stage, displacement, later !== null));
  return { under: { shapes: ghosts.flat(), labels: [] }, over: merged(arrows) };
}

/** The members of a drawing at a moment, in a class of their own. @param {Stage} stage @param {Snapshot} then @param {string} kind */
export function outline(stage, then, kind) {
  return figureOf(stage, then).shapes
    .filter(({ key }) => MEMBERS.test(key))
    .map((shape) => ({ ...shape, key: `${kind} ${shape.key}`, className: `outline ${kind} ${shape.className}` }));
}

/** @param {readonly Figure[]} figures @returns {Figure} */
const merged = (figures) => ({ shapes: figures.flatMap(({ shapes }) => shapes), labels: figures.flatMap(({ labels }) => labels) });

/**
 * @param {Stage} stage @param {import("./virtual.js").Displacement} displacement @param {boolean} running  time is not frozen
 * @returns {Figure}
 */
function arrowsOf(stage, { body, at, variation, frozen, explicit }, running) {
  const from = stage.project(at);
  const named = (/** @type {string} */ key, /** @type {Pixel} */ start, /** @type {number[]} */ vector, /** @type {string} */ latex, /** @type {string} */ className, side = 1) =>
    labelled(stage, `${key}-${body}`, start, stage.direct(vector), latex, `${className} body-${body}`, side);
  const whole = frozen.map((x, c) => x + explicit[c]);
  const partly = add(from, stage.direct(frozen));
  const shown = [named("variation", from, variation, "\\delta\\mathbf r", "virtual")];
  if (!running) return merged(shown);
  const moving = lengthOf(stage.direct(explicit)) > 1;
  return merged([
    ...shown,
    named("differential", from, whole, "\\mathrm d\\mathbf r", "actual", -1),
    ...(moving ? [
      named("frozen", from, frozen, "", "actual part"),
      named("explicit", partly, explicit, "\\frac{\\partial\\mathbf r}{\\partial t}\\mathrm dt", "time-term", -1),
    ] : []),
  ]);
}

/** @param {Stage} stage @param {string} key @param {Pixel} from @param {Pixel} vector @param {string} latex @param {string} className @param {number} side @returns {Figure} */
function labelled(stage, key, from, vector, latex, className, side) {
  const long = lengthOf(vector);
  if (!(long > SHORTEST * stage.unit)) return { shapes: [], labels: [] };
  const middle = add(from, scaled(vector, 0.5));
  const aside = scaled(normal(unit(vector)), side * stage.unit * 1.2);
  const shapes = arrow(from, vector, key, className, Math.min(stage.unit, long * 0.5));
  return { shapes, labels: latex ? [{ key, latex, at: long > 3 * stage.unit ? subtract(middle, aside) : add(add(from, vector), scaled(unit(vector), stage.unit)), className }] : [] };
}
