/** The neighbouring configuration as a ghost, and the displacements as arrows. */

import { add, lengthOf, scaled, subtract, unit, normal } from "../drawing/geometry.js";
import { figureOf } from "../drawing/figure.js";
import { coordinateClass, keeper, latexOf } from "../drawing/stage.js";
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
const MEMBERS = /^(rod|string|spring|damper|bob|cart|block|disc|hoop|pivot|guide)(?!\d*-(hatch|rail|triangle))/;
/** Where there are more parts than this, only the arrows of the body that has the most of them have letters. */
const LETTERED = 8;
/** Of more parts than this letters tell only which coordinate is varied: there is no room for fractions. */
const FRACTIONS = 3;
/** Arrows below this many units are too short for a head. */
const SHORTEST = 0.5;

/**
 * @param {Stage} stage @param {import("./virtual.js").Virtual} virtual
 * @returns {{under: Figure, over: Figure}}
 */
export function virtualFigure(stage, { varied, later, displacements }) {
  const ghosts = [outline(stage, varied, "ghost-varied"), ...(later ? [outline(stage, later, "ghost-later")] : [])];
  const counts = displacements.map(({ parts }) => parts.length);
  const few = counts.reduce((sum, count) => sum + count, 0) <= LETTERED;
  const arrows = displacements.map((displacement) => {
    const isLettered = few || displacement.parts.length === Math.max(...counts);
    return arrowsOf(stage, displacement, later !== null, isLettered);
  });
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
 * @param {Stage} stage @param {import("./virtual.js").Displacement} displacement @param {boolean} running  time is not frozen @param {boolean} isLettered
 * @returns {Figure}
 */
function arrowsOf(stage, { body, at, variation, parts, frozen, explicit }, running, isLettered) {
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
  const virtual = {
    key: "variation",
    from,
    vector: variation,
    className: "virtual",
    latex: isLettered ? "\\delta\\mathbf r" : undefined,
  };
  const summands = parts.length > 1 ? summandsOf(stage, from, parts, isLettered) : [];
  // What it is about finds its place first.
  if (!running) return drawn([virtual, ...summands]);
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

/**
 * The parts of δr, one after the other, so that they end where δr does: ∂r/∂q₁ δq₁, ∂r/∂q₂ δq₂ …
 * @param {Stage} stage @param {Pixel} from @param {import("./virtual.js").Displacement["parts"]} parts @param {boolean} isLettered @returns {Arrow[]}
 */
function summandsOf(stage, from, parts, isLettered) {
  let start = from;
  return parts.map(({ coordinate, vector }, i) => {
    const q = latexOf(stage.scene, coordinate);
    const slope = parts.length > FRACTIONS ? "" : `\\frac{\\partial\\mathbf r}{\\partial ${q}}\\,`;
    const arrow = {
      key: `part-${i}`,
      from: start,
      vector,
      className: `summand ${coordinateClass(stage.scene, coordinate)}`,
      latex: isLettered ? `${slope}\\delta ${q}` : undefined,
      side: /** @type {const} */ (-1),
    };
    start = add(start, stage.direct(vector));
    return arrow;
  });
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
            at: subtract(middle, aside),
            others: [
              add(middle, aside),
              ...[1.7, 2.5, 3.3, 4.2].flatMap((far) => [
                subtract(middle, scaled(aside, far)),
                add(middle, scaled(aside, far)),
              ]),
              add(add(from, vector), scaled(unit(vector), 1.2 * stage.unit)),
            ],
            className,
          },
        ]
      : [],
  };
}
