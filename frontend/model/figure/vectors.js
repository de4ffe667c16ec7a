/**
 * Positions and velocities of bodies as arrows, with the symbols that they have in the formulas: r from the origin, v where
 * the body is.
 */

import { add, lengthOf, normal, scaled, subtract, unit } from "../drawing/geometry.js";
import { solidArrow } from "../drawing/marks.js";

/** @typedef {import("../types.js").Figure} Figure */
/** @typedef {import("../types.js").Pixel} Pixel */
/** @typedef {import("../types.js").Snapshot} Snapshot */
/** @typedef {import("../types.js").Trajectory} Trajectory */
/** @typedef {import("../drawing/stage.js").Stage} Stage */
/** @typedef {import("../kinematics/kinematics.js").Kinematics} Kinematics */
/** @typedef {"r" | "v"} Vector */
/** @typedef {{body: string, vector: Vector}} Arrow */

const SYMBOL =
  /\\htmlClass\{body-([\w-]+)(?: vector-[rv])?\}\{(\\mathbf\{([rv])\}(?:_(?:\{(?:[^{}]|\{[^{}]*\})*\}|\w))?)\}/g;
/** The largest velocity of a motion is drawn this many units long; shorter arrows than this are not drawn. */
const LONGEST = 6;
const SHORTEST = 0.6;
/** Moments at which velocities are compared. */
const LOOKS = 60;

/** @param {Arrow} arrow */
const keyOf = ({ body, vector }) => `${vector} ${body}`;

/** The symbols of places and velocities as a derivation writes them, by vector and body. @param {readonly {steps: import("../types.js").Step[]}[]} chapters @returns {Map<string, string>} */
export function vectorSymbols(chapters) {
  /** @type {Map<string, string>} */
  const found = new Map();
  for (const { steps } of chapters)
    for (const { marked } of steps)
      for (const [, body, latex, vector] of (marked ?? "").matchAll(SYMBOL)) {
        const key = `${vector} ${body}`;
        if (!found.has(key)) found.set(key, latex);
      }
  return found;
}

/** v = Σ ∂r/∂qᵢ q̇ᵢ + ∂r/∂t of every body. @param {Kinematics} kinematics @param {Snapshot} now */
export function velocitiesOf(kinematics, now) {
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

/**
 * @param {Stage} stage @param {Snapshot} now @param {readonly Arrow[]} arrows
 * @param {{kinematics: Kinematics, symbols: Map<string, string>, at: (t: number) => Snapshot, end: number}} about  at: the motion, which ends at `end`
 * @returns {Figure}
 */
export function vectorFigure(stage, now, arrows, { kinematics, symbols, at, end }) {
  const bodies = stage.scene.bodies.map(({ name }) => name);
  const largest = stage.once("fastest", () =>
    fastest(
      kinematics,
      Array.from({ length: LOOKS + 1 }, (_, i) => at((i * end) / LOOKS)),
      bodies,
    ),
  );
  const velocities = velocitiesOf(kinematics, now);
  const origin = stage.project(Array.from({ length: stage.scene.dimension }, () => 0));
  const figures = arrows.map((arrow) => {
    const place = now.positions[arrow.body];
    if (!place?.every(Number.isFinite)) return { shapes: [], labels: [] };
    const there = stage.project(place);
    const given =
      arrow.vector === "r"
        ? { from: origin, along: subtract(there, origin) }
        : { from: there, along: scaled(stage.direct(velocities[arrow.body] ?? []), speedScale(stage, largest)) };
    return labelled(stage, arrow, given, symbols.get(keyOf(arrow)) ?? `\\mathbf{${arrow.vector}}`);
  });
  return { shapes: figures.flatMap(({ shapes }) => shapes), labels: figures.flatMap(({ labels }) => labels) };
}

/** From metres a second, which `direct` has made pixels, to arrows of the drawing. @param {Stage} stage @param {number} largest */
const speedScale = (stage, largest) => (LONGEST * stage.unit) / (largest * stage.scale);

/** @param {Stage} stage @param {Arrow} arrow @param {{from: Pixel, along: Pixel}} given @param {string} latex @returns {Figure} */
function labelled({ unit: u }, { body, vector }, { from, along }, latex) {
  const long = lengthOf(along);
  if (!(long > SHORTEST * u)) return { shapes: [], labels: [] };
  const key = `vector-${vector}-${body}`;
  const className = `vector vector-${vector} body-${body}`;
  const aside = normal(unit(along));
  const on = (/** @type {number} */ part, /** @type {number} */ out) =>
    add(add(from, scaled(along, part)), scaled(aside, out * u));
  const [first, ...others] =
    vector === "r"
      ? [0.6, 0.4, 0.75, 0.25].flatMap((part) => [on(part, 1.2), on(part, -1.2)])
      : [on(1 + (1.2 * u) / long, 0), on(0.8, 1.3), on(0.8, -1.3), on(0.4, 1.3), on(0.4, -1.3)];
  return {
    shapes: solidArrow(from, along, key, className, Math.min(u, 0.5 * long)),
    labels: [{ key, latex, at: first, others, className }],
  };
}
