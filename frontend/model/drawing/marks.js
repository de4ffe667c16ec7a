/** What is written into a drawing: forces, weights, angles, dimensions. */

import {
  add,
  arrowHead,
  at as pixel,
  chords,
  fromDown,
  lengthOf,
  line,
  normal,
  scaled,
  sliverFrom,
  subtract,
  unit,
  wrapped,
} from "./geometry.js";
import { pullOf, verticalOf } from "./sketch.js";
import { boxAbout } from "./placing.js";
import { massCentre } from "./matter.js";
import { coordinateClass, latexOf, marked, placeOf, sizeOf } from "./stage.js";

/** @typedef {import("../types.js").Element} Element */
/** @typedef {import("../types.js").Figure} Figure */
/** @typedef {import("../types.js").Load} Load */
/** @typedef {import("../types.js").Pixel} Pixel */
/** @typedef {import("./stage.js").Stage} Stage */
/** @typedef {import("../types.js").Snapshot} Snapshot */

/** The largest force of a load is drawn this many units long. */
const LONGEST = 5.5;
/** Between rod and vertical there is no room for a letter below this angle. */
const NARROW = 0.18;
/** A head that has a line about it is drawn smaller by this. */
const LINED = 0.8;
/** Shorter arrows are not drawn: their head would lie. */
const SHORTEST = 0.6;

/** What the head of an arrow takes. @param {Pixel} tip @param {Pixel} along @param {number} size */
export const tipBox = (tip, along, size) => boxAbout(add(tip, scaled(along, -size / 2)), size / 2);

/**
 * @param {Pixel} from @param {Pixel} vector in pixels @param {string} key @param {string} className @param {number} size
 * @returns {import("../types.js").Shape[]}
 */
export function arrow(from, vector, key, className, size) {
  const tip = add(from, vector);
  const along = unit(vector);
  const neck = add(tip, scaled(along, -size * 0.7));
  return [
    { key: `${key}-shaft`, d: line(from, neck), className: `arrow ${className}`, strips: [[from, neck]] },
    {
      key: `${key}-head`,
      d: arrowHead(tip, along, size),
      className: `head ${className}`,
      boxes: [tipBox(tip, along, size)],
    },
  ];
}

/**
 * The same as one path, half as much to move: it is filled, and its line encloses nothing.
 * @param {Pixel} from @param {Pixel} vector in pixels @param {string} key @param {string} className @param {number} size
 * @returns {import("../types.js").Shape[]}
 */
export function solidArrow(from, vector, key, className, size) {
  const [shaft, head] = arrow(from, vector, key, className, LINED * size);
  return [
    { key, d: shaft.d + head.d, className: `pointed ${shaft.className}`, boxes: head.boxes, strips: shaft.strips },
  ];
}

/** @param {Element} element @param {Stage} stage @param {Snapshot} now @param {string} key @returns {Figure} */
export function force(element, stage, now, key) {
  const load = stage.scene.loads.find((candidate) => candidate.name === element.load);
  if (load?.kind === "gravity") return weights(element, stage, now, key);
  const samples = stage.trajectory.loads?.[element.load ?? ""];
  const value = now.loads[element.load ?? ""];
  if (!load || !samples || !value) return { shapes: [], labels: [] };
  const largest = stage.once(`largest ${key}`, () =>
    Math.max(...samples.map((sample) => lengthOf(stage.direct(sample))), 1e-12),
  );
  const vector = scaled(stage.direct(value), (LONGEST * stage.unit) / largest);
  if (!(lengthOf(vector) > SHORTEST * stage.unit)) return { shapes: [], labels: [] };
  const from = placeOf(stage, now, load.at ?? "");
  const className = marked(`load load-${load.name}`, element);
  return {
    shapes: solidArrow(from, vector, key, className, stage.unit),
    labels: [{ key, latex: forceLatex(load), ...aboutArrow(from, vector, stage.unit), className }],
  };
}

/** Gravity acts on every body. @param {Element} element @param {Stage} stage @param {Snapshot} now @param {string} key @returns {Figure} */
function weights(element, stage, now, key) {
  const figures = stage.scene.bodies.map((body) =>
    weight({ kind: "weight", at: body.name, marks: element.marks }, stage, now, `${key}-${body.name}`),
  );
  return { shapes: figures.flatMap((f) => f.shapes), labels: figures.flatMap((f) => f.labels) };
}

/** Where the letter of an arrow can stand: past its tip, or beside it. @param {Pixel} from @param {Pixel} vector @param {number} u @returns {{at: Pixel, others: Pixel[]}} */
function aboutArrow(from, vector, u) {
  const tip = add(from, vector);
  const [along, across] = [unit(vector), normal(unit(vector))];
  const beside = [-0.3, -0.5 * (lengthOf(vector) / u)].flatMap((back) =>
    [1.3, -1.3].map((side) => add(tip, add(scaled(along, back * u), scaled(across, side * u)))),
  );
  return { at: add(tip, scaled(along, 1.1 * u)), others: beside };
}

/** @param {Load} load */
export function forceLatex(load) {
  if (load.latex) return load.latex;
  const letter = /^([A-Za-z])_?(\w*)$/.exec(load.name);
  if (letter && letter[2].length < 3)
    return letter[2] ? `\\mathbf{${letter[1]}}_{${letter[2]}}` : `\\mathbf{${letter[1]}}`;
  return "\\mathbf{F}";
}

/** @param {Element} element @param {Stage} stage @param {Snapshot} now @param {string} key @returns {Figure} */
export function weight(element, stage, now, key) {
  const load = stage.scene.loads.find((candidate) => candidate.kind === "gravity");
  const centre = massCentre(stage, now, element.at ?? "");
  if (!centre) return { shapes: [], labels: [] };
  const from = stage.project(centre);
  const vector = scaled(stage.down, stage.unit * (stage.once("falls", () => falls(stage.scene)) ? 4.2 : -4.2));
  const className = marked(`load load-${load?.name ?? "weight"}`, element);
  return {
    shapes: solidArrow(from, vector, key, className, stage.unit),
    labels: [{ key, latex: weightLatex(element, stage, load), ...besideTip(from, vector, stage.unit), className }],
  };
}

/** Where the letters of a weight can stand: to the right of its tip, to the left, below. @param {Pixel} from @param {Pixel} vector @param {number} u @returns {{at: Pixel, others: Pixel[]}} */
function besideTip(from, vector, u) {
  const tip = add(from, vector);
  const at = (/** @type {number} */ x, /** @type {number} */ y) => add(tip, [x * u, y * u * Math.sign(vector[1])]);
  return { at: at(2, -0.5), others: [at(-2, -0.5), at(0, 1.1), at(2, -2), at(-2, -2)] };
}

/** Whether gravity pulls down on the screen: a drawing turned over shows what the scene says. @param {import("../types.js").Scene} scene */
const falls = (scene) => pullOf(scene) !== (verticalOf(scene) === "down" ? -1 : 1);

/** m g where mass and acceleration are plain names, else G. @param {Element} element @param {Stage} stage @param {Load | undefined} load */
function weightLatex(element, stage, load) {
  const body = stage.scene.bodies.find((candidate) => candidate.name === element.at);
  const acceleration = (load?.acceleration ?? [])
    .map((part) => part.replace(/[-\s]/g, ""))
    .find((part) => part !== "0");
  const names = [body?.mass, acceleration].map(
    (name) => stage.scene.parameters.find((p) => p.name === name)?.latex || name,
  );
  const plain = names.every((name) => name && /^[A-Za-z]\w*$|^\\?\w+(_\{?\w+\}?)?$/.test(name));
  return plain ? names.join("\\,") : "\\mathbf{G}";
}

/** Where the letter of an arc can stand: outside along it, or within. @param {(part: number, out: number) => Pixel} on @returns {{at: Pixel, others: Pixel[]}} */
export const aboutArc = (on) => ({
  at: on(0.5, 1.15),
  others: [on(0.3, 1.15), on(0.7, 1.15), on(0.5, -1.2), on(0.05, 1.3), on(0.95, 1.3), on(0.5, 2.3)],
});

/** Radians that the arrow of a moment goes round. */
const ROUND = 4.2;
/** A moment that is one symbol is called by it; an expression is a text, not LaTeX. */
const NAME = /^\w+$/;

/**
 * A moment as an arrow round its place, in the sense in which its angle grows.
 * @param {Element} element @param {Stage} stage @param {Snapshot} now @param {string} key
 * @returns {Figure}
 */
export function moment(element, stage, now, key) {
  const load = stage.scene.loads.find((candidate) => candidate.name === element.load);
  const centre = placeOf(stage, now, element.at ?? "");
  const radius = stage.unit * 2.3;
  const at = (/** @type {number} */ turn) => add(centre, scaled(fromDown(turn), radius));
  const [from, to] = [-ROUND / 2, ROUND / 2].map((turn) => turn + 0.6);
  const back = to - 0.25;
  const className = marked(`load load-${element.load}`, element);
  const arc = `M${pixel(at(from))}A${radius} ${radius} 0 1 0 ${pixel(at(back))}`;
  const named = load?.latex || (NAME.test(load?.moment ?? "") && latexOf(stage.scene, load?.moment));
  return {
    shapes: [
      {
        key: `${key}-arc`,
        d: arc,
        className: `arrow ${className}`,
        boxes: [0, 0.25, 0.5, 0.75, 1].map((part) => boxAbout(at(from + part * (back - from)), 0.2 * stage.unit)),
      },
      {
        key: `${key}-head`,
        d: arrowHead(at(to), scaled(normal(fromDown(to - 0.12)), -1), stage.unit),
        className: `head ${className}`,
      },
    ],
    labels: [
      {
        key,
        latex: named || "M",
        ...aboutArc((part, out) => add(centre, scaled(fromDown(from + part * (to - from)), radius + out * stage.unit))),
        className,
      },
    ],
  };
}

/**
 * The arc from the vertical to the rod, or from the direction that the element says; turns of more than half a circle
 * show their remainder.
 * @param {Element} element @param {Stage} stage @param {Snapshot} now @param {string} key
 * @returns {Figure}
 */
export function angle(element, stage, now, key) {
  const centre = placeOf(stage, now, element.at ?? "");
  const zero = sizeOf(element.offset, stage);
  const sense = element.direction === "clockwise" ? -1 : 1;
  const turn = sense * wrapped(now.coordinates[element.coordinate ?? ""] ?? 0);
  const radius = stage.unit * 4.8;
  const className = marked(coordinateClass(stage.scene, element.coordinate), element);
  const reference = {
    key: `${key}-axis`,
    d: line(centre, add(centre, scaled(fromDown(zero), radius * 1.08))),
    className: "reference",
  };
  if (Math.abs(turn) < 0.02) return { shapes: [reference], labels: [] };
  const size = Math.min(stage.unit * 0.8, Math.abs(turn) * radius * 0.5);
  const end = add(centre, scaled(fromDown(zero + turn), radius));
  const along = scaled(normal(fromDown(zero + turn)), -Math.sign(turn));
  const short = turn - Math.sign(turn) * (size / radius) * 0.7;
  return {
    shapes: [
      reference,
      {
        key: `${key}-arc`,
        d: sliverFrom(zero, centre, radius, short) + arrowHead(end, along, LINED * size),
        className: `pointed mark ${className}`,
        boxes: [tipBox(end, along, LINED * size)],
        strips: chords(centre, radius, zero, turn),
      },
    ],
    labels: [
      {
        key,
        latex: latexOf(stage.scene, element.coordinate),
        ...aboutArc((part, out) => add(centre, scaled(fromDown(zero + part * turn), radius + out * stage.unit))),
        className,
        opacity: Number(Math.abs(turn) > NARROW),
      },
    ],
  };
}

/**
 * A dimension line beside its two places, so far to the left as its element says, with extension lines; the arrow points
 * from the first to the second.
 * @param {Element} element @param {Stage} stage @param {Snapshot} now @param {string} key
 * @returns {Figure}
 */
export function dimension(element, stage, now, key) {
  const [from, to] = [placeOf(stage, now, element.from ?? ""), placeOf(stage, now, element.to ?? "")];
  const horizontal = Math.abs(to[0] - from[0]) > 3 * Math.abs(to[1] - from[1]);
  const aloof = (/** @type {number} */ usual) => -(sizeOf(element.offset, stage) * stage.scale || usual * stage.unit);
  const offset = /** @type {Pixel} */ (horizontal ? [0, aloof(3.2)] : [aloof(4.2), 0]);
  const [a, b] = [
    add(from, offset),
    add(/** @type {Pixel} */ (horizontal ? [to[0], from[1]] : [from[0], to[1]]), offset),
  ];
  const span = subtract(b, a);
  const className = marked(coordinateClass(stage.scene, element.coordinate), element);
  const past = scaled(unit(offset), stage.unit * 0.5);
  const size = Math.min(stage.unit * 0.8, lengthOf(span) * 0.6);
  const aside = scaled(unit(offset), stage.unit * 1.4);
  return {
    shapes: [
      { key: `${key}-from`, d: line(from, add(a, past)), className: "reference" },
      { key: `${key}-to`, d: line(to, add(b, past)), className: "extension" },
      {
        key: `${key}-line`,
        d: line(a, add(b, scaled(unit(span), -size * 0.7))) + (size > 1 ? arrowHead(b, unit(span), LINED * size) : ""),
        className: `pointed mark ${className}`,
        boxes: [tipBox(b, unit(span), LINED * size)],
        strips: [[a, b]],
      },
    ],
    labels: [
      {
        key,
        latex: latexOf(stage.scene, element.coordinate),
        at: add(scaled(add(a, b), 0.5), aside),
        others: [
          subtract(scaled(add(a, b), 0.5), aside),
          add(add(scaled(a, 0.3), scaled(b, 0.7)), aside),
          add(b, past),
        ],
        className,
      },
    ],
  };
}
