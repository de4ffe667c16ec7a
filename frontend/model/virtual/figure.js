/** The neighbouring configuration as a ghost, and the displacements as arrows. */

import { add, lengthOf, scaled, subtract, unit, normal } from "../drawing/geometry.js";
import { figureOf } from "../drawing/figure.js";
import { keeper } from "../drawing/stage.js";
import { arrow } from "../drawing/marks.js";

/** @typedef {import("../types.js").Figure} Figure */
/** @typedef {import("../types.js").Pixel} Pixel */
/** @typedef {import("../types.js").Snapshot} Snapshot */
/** @typedef {import("../drawing/stage.js").Stage} Stage */
/**
 * @typedef {object} Arrow
 * @property {string} key
 * @property {Pixel} from
 * @property {number[]} vector  in the scene
 * @property {string} className
 * @property {string} [latex]
 * @property {1 | -1} [side]  on which the label stands
 */

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
  const own = stage.once(`stage ${kind}`, () => ({ ...stage, once: keeper() }));
  return figureOf(own, then)
    .shapes.filter(({ key }) => MEMBERS.test(key))
    .map((shape) => ({ ...shape, key: `${kind} ${shape.key}`, className: `outline ${kind} ${shape.className}` }));
}

/** @param {readonly Figure[]} figures @returns {Figure} */
const merged = (figures) => ({
  shapes: figures.flatMap(({ shapes }) => shapes),
  labels: figures.flatMap(({ labels }) => labels),
});

/**
 * @param {Stage} stage @param {import("./virtual.js").Displacement} displacement @param {boolean} running  time is not frozen
 * @returns {Figure}
 */
function arrowsOf(stage, { body, at, variation, frozen, explicit }, running) {
  const from = stage.project(at);
  const drawn = (/** @type {Arrow[]} */ arrows) =>
    merged(
      arrows.map((one) =>
        labelled(stage, { ...one, key: `${one.key}-${body}`, className: `${one.className} body-${body}` }),
      ),
    );
  const whole = frozen.map((x, c) => x + explicit[c]);
  const partly = add(from, stage.direct(frozen));
  /** @type {Arrow} */
  const virtual = { key: "variation", from, vector: variation, className: "virtual", latex: "\\delta\\mathbf r" };
  if (!running) return drawn([virtual]);
  /** @type {Arrow} */
  const actual = {
    key: "differential",
    from,
    vector: whole,
    className: "actual",
    latex: "\\mathrm d\\mathbf r",
    side: -1,
  };
  if (!(lengthOf(stage.direct(explicit)) > 1)) return drawn([virtual, actual]);
  return drawn([
    virtual,
    actual,
    { key: "frozen", from, vector: frozen, className: "actual part" },
    {
      key: "explicit",
      from: partly,
      vector: explicit,
      className: "time-term",
      latex: "\\frac{\\partial\\mathbf r}{\\partial t}\\mathrm dt",
      side: -1,
    },
  ]);
}

/** @param {Stage} stage @param {Arrow} arrow @returns {Figure} */
function labelled(stage, { key, from, vector: direction, className, latex, side = 1 }) {
  const vector = stage.direct(direction);
  const long = lengthOf(vector);
  if (!(long > SHORTEST * stage.unit)) return { shapes: [], labels: [] };
  const middle = add(from, scaled(vector, 0.5));
  const aside = scaled(normal(unit(vector)), side * stage.unit * 1.2);
  const shapes = arrow(from, vector, key, className, Math.min(stage.unit, long * 0.5));
  return {
    shapes,
    labels: latex
      ? [
          {
            key,
            latex,
            at:
              long > 3 * stage.unit
                ? subtract(middle, aside)
                : add(add(from, vector), scaled(unit(vector), stage.unit)),
            className,
          },
        ]
      : [],
  };
}
