/**
 * Positions and velocities of bodies as arrows, with the symbols that they have in the formulas: r from the origin, v where
 * the body is; and reactions of constraints, of what is released and of dry friction where they act. A rod has a colour for tension
 * and one for thrust.
 */

import { add, lengthOf, line, normal, scaled, subtract, unit } from "../drawing/geometry.js";
import { solidArrow } from "../drawing/marks.js";
import { frictionOf, reactionOf, releasedOf, stressOf } from "./reactions.js";

/** @typedef {import("../types.js").Figure} Figure */
/** @typedef {import("../types.js").Pixel} Pixel */
/** @typedef {import("../types.js").Snapshot} Snapshot */
/** @typedef {import("../types.js").Trajectory} Trajectory */
/** @typedef {import("../drawing/stage.js").Stage} Stage */
/** @typedef {import("../kinematics/kinematics.js").Kinematics} Kinematics */
/** @typedef {"r" | "v" | "z" | "h" | "f"} Vector  z: a reaction, h: that of what is released, f: dry friction */
/** @typedef {{of: string, vector: Vector}} Arrow  of: a body, a constraint, what is released, or a load */
/** @typedef {{kinematics: Kinematics, symbols: Map<string, string>, at: (t: number) => Snapshot, multipliers: (t: number) => Record<string, number>, frictions: (t: number) => Record<string, number>, end: number}} Motion  at: the motion, which ends at `end` */

const SYMBOL =
  /\\htmlClass\{body-([\w-]+)(?: vector-[rv])?\}\{(\\mathbf\{([rv])\}(?:_(?:\{(?:[^{}]|\{[^{}]*\})*\}|\w))?)\}/g;
/** The largest velocity of a motion is drawn this many units long; shorter arrows than this are not drawn. */
const LONGEST = 6;
const SHORTEST = 0.6;
const FORCES = { z: reactionOf, h: releasedOf, f: frictionOf };
/** Moments at which velocities are compared. */
const LOOKS = 60;

/** @param {Vector} vector @returns {vector is keyof typeof FORCES} */
const isForce = (vector) => vector in FORCES;

/** @param {Arrow} arrow */
const keyOf = ({ of, vector }) => `${vector} ${of}`;

/**
 * The symbols of places and velocities as a derivation writes them, and of multipliers, by vector and what it is of.
 * @param {readonly {steps: import("../types.js").Step[]}[]} chapters
 * @param {import("../types.js").Derivation["result"] | null} [result] @returns {Map<string, string>}
 */
export function vectorSymbols(chapters, result) {
  const found = new Map((result?.constraints ?? []).map(({ name, multiplier }) => [`z ${name}`, multiplier.latex]));
  for (const { name, force } of result?.reactions ?? []) {
    const latex = result?.releasable?.find((one) => one.name === name)?.latex ?? name;
    found.set(`h ${name}`, `${force ? "S" : "Z"}_{${latex}}`);
  }
  for (const { steps } of chapters)
    for (const { marked } of steps)
      for (const [, body, latex, vector] of (marked ?? "").matchAll(SYMBOL)) {
        const key = `${vector} ${body}`;
        if (!found.has(key)) found.set(key, latex);
      }
  return found;
}

/** v = Σ ∂r/∂qᵢ q̇ᵢ + ∂r/∂t of every body. @param {Kinematics} kinematics @param {Snapshot} now */
function velocitiesOf(kinematics, now) {
  const free = new Set(kinematics.free);
  const rates = Object.fromEntries(Object.entries(now.rates).filter(([name]) => free.has(name)));
  return kinematics.slope(now.coordinates, now.t, rates, 1);
}

/** The largest speed of a body in a motion. @param {Kinematics} kinematics @param {readonly Snapshot[]} moments @param {readonly string[]} bodies */
function fastest(kinematics, moments, bodies) {
  const speeds = moments.flatMap((now) => {
    const velocities = velocitiesOf(kinematics, now);
    return bodies.map((body) => Math.hypot(...(velocities[body] ?? [])));
  });
  return Math.max(1e-12, ...speeds.filter(Number.isFinite));
}

/** @param {Motion} motion */
const looks = ({ at, end }) => Array.from({ length: LOOKS + 1 }, (_, i) => at((i * end) / LOOKS));

/**
 * @param {Stage} stage @param {Snapshot} now @param {readonly Arrow[]} arrows @param {Motion} motion
 * @returns {Figure}
 */
export function vectorFigure(stage, now, arrows, motion) {
  const { kinematics, symbols } = motion;
  const bodies = stage.scene.bodies.map(({ name }) => name);
  const velocities = velocitiesOf(kinematics, now);
  const origin = stage.project(Array.from({ length: stage.scene.dimension }, () => 0));
  const figures = arrows.flatMap((arrow) => {
    if (isForce(arrow.vector))
      return [...stressFigure(stage, now, arrow, motion), ...forceFigures(stage, now, arrow, motion)];
    const place = now.positions[arrow.of];
    if (!place?.every(Number.isFinite)) return [];
    const there = stage.project(place);
    const largest = stage.once("fastest", () => fastest(kinematics, looks(motion), bodies));
    const given =
      arrow.vector === "r"
        ? { from: origin, along: subtract(there, origin) }
        : { from: there, along: scaled(stage.direct(velocities[arrow.of] ?? []), speedScale(stage, largest)) };
    return [
      labelled(stage, arrow, given, symbols.get(keyOf(arrow)) ?? `\\mathbf{${arrow.vector}}`, `body-${arrow.of}`),
    ];
  });
  return { shapes: figures.flatMap(({ shapes }) => shapes), labels: figures.flatMap(({ labels }) => labels) };
}

/** The rod of a reaction, in the colour of tension or of thrust. @param {Stage} stage @param {Snapshot} now @param {Arrow} arrow @param {Motion} motion @returns {Figure[]} */
function stressFigure(stage, now, { of, vector }, { kinematics, multipliers }) {
  const found = vector === "f" ? null : stressOf(stage.scene, kinematics, now, multipliers(now.t), of);
  const [from, to] = (found?.ends ?? []).map((end) => now.positions[end]);
  if (!found || !from || !to || !found.tension) return [];
  const d = line(stage.project(from), stage.project(to));
  return [
    {
      shapes: [{ key: `stress-${of}`, d, className: `stress ${found.tension > 0 ? "tension" : "thrust"}` }],
      labels: [],
    },
  ];
}

/** The reaction of a constraint or of what is released, or friction, at each place where it acts; all have one scale along the motion. @param {Stage} stage @param {Snapshot} now @param {Arrow} arrow @param {Motion} motion @returns {Figure[]} */
function forceFigures(stage, now, arrow, motion) {
  const { kinematics, symbols, multipliers, frictions } = motion;
  const sizes = arrow.vector === "f" ? frictions : multipliers;
  const forcesOf = FORCES[/** @type {keyof typeof FORCES} */ (arrow.vector)];
  const at = (/** @type {Snapshot} */ moment) => forcesOf(stage.scene, kinematics, moment, sizes(moment.t), arrow.of);
  const largest = stage.once(`force ${keyOf(arrow)}`, () =>
    Math.max(1e-12, ...looks(motion).flatMap((moment) => at(moment).map(({ force }) => Math.hypot(...force)))),
  );
  return at(now).map(({ place, force, plain }, i) => {
    const given = {
      from: stage.project(now.positions[place]),
      along: scaled(stage.direct(force), speedScale(stage, largest)),
    };
    const symbol = plain ? symbols.get(keyOf(arrow)) : undefined;
    const { shapes, labels } = labelled(
      stage,
      arrow,
      given,
      symbol ?? (arrow.vector === "f" ? "\\mathbf{R}" : "\\mathbf{F}^{z}"),
      classOf(stage, arrow, Object.keys(kinematics.held)),
      `-${place}`,
    );
    return { shapes, labels: i ? [] : labels };
  });
}

/** From metres a second or newtons, which `direct` has made pixels, to arrows of the drawing. @param {Stage} stage @param {number} largest */
const speedScale = (stage, largest) => (LONGEST * stage.unit) / (largest * stage.scale);

/** Of the colour of its curve: coordinates, constraints, what is released and frictions follow each other. @param {Stage} stage @param {Arrow} arrow @param {readonly string[]} released */
function classOf({ scene: { coordinates, constraints = [], loads } }, { of, vector }, released) {
  const first = coordinates.length + (constraints ?? []).length;
  const frictions = loads.filter(({ kind }) => kind === "friction").map(({ name }) => name);
  if (vector === "z")
    return `q-${coordinates.length + (constraints ?? []).findIndex(({ name }) => name === of)} constraint-${of}`;
  if (vector === "h") return `q-${first + released.indexOf(of)} released-${of}`;
  return `q-${first + released.length + frictions.indexOf(of)} friction-${of}`;
}

/** @param {Stage} stage @param {Arrow} arrow @param {{from: Pixel, along: Pixel}} given @param {string} latex @param {string} whose  its classes @param {string} [which]  of several @returns {Figure} */
function labelled({ unit: u }, { of, vector }, { from, along }, latex, whose, which = "") {
  const long = lengthOf(along);
  if (!(long > SHORTEST * u)) return { shapes: [], labels: [] };
  const key = `vector-${vector}-${of}${which}`;
  const className = `vector vector-${vector} ${whose}`;
  const aside = normal(unit(along));
  const on = (/** @type {number} */ part, /** @type {number} */ out) =>
    add(add(from, scaled(along, part)), scaled(aside, out * u));
  // What a rod pulls lies on it: its letter stands beside it.
  const [first, ...others] =
    vector === "r"
      ? [0.6, 0.4, 0.75, 0.25].flatMap((part) => [on(part, 1.2), on(part, -1.2)])
      : [on(1 + (1.2 * u) / long, 0), on(0.8, 1.3), on(0.8, -1.3), on(0.4, 1.3), on(0.4, -1.3)].slice(
          isForce(vector) ? 1 : 0,
        );
  return {
    shapes: solidArrow(from, along, key, className, Math.min(u, 0.5 * long)),
    labels: [{ key, latex, at: first, others, className }],
  };
}
