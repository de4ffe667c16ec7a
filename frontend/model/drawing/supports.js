/** What holds a system: ground, pivot, guide, wire. */

import { traced } from "../curve.js";
import { evaluator } from "../kinematics/expression.js";
import { coordinateRange } from "../values.js";
import { add, at, circle, hatching, lengthOf, line, normal, polygon, polyline, scaled, subtract } from "./geometry.js";
import { marked, placeOf, sizeOf, unlessMoved } from "./stage.js";

/** @typedef {import("../types.js").Element} Element */
/** @typedef {import("../types.js").Figure} Figure */
/** @typedef {import("../types.js").Pixel} Pixel */
/** @typedef {import("./stage.js").Stage} Stage */
/** @typedef {import("../types.js").Snapshot} Snapshot */

/**
 * Hatched ground. In the lower part of what is shown things stand on it, else they hang from it; where a pivot sits
 * at the same place it leaves room for the pivot's triangle.
 * @param {Element} element @param {Stage} stage @param {Snapshot} now @param {string} key
 * @returns {Figure}
 */
export function ground(element, stage, now, key) {
  const place = placeOf(stage, now, element.at ?? "");
  return unlessMoved(stage, key, at(place), () => groundAt(place, element, stage, key));
}

/** @param {Pixel} place @param {Element} element @param {Stage} stage @param {string} key @returns {Figure} */
function groundAt(place, element, stage, key) {
  const below = place[1] > stage.lower;
  const half = (sizeOf(element.width, stage) * stage.scale) / 2 || stage.unit * 3;
  const away = /** @type {Pixel} */ ([0, below ? 1 : -1]);
  const base = holdsPivot(element, stage) ? add(place, scaled(away, triangleHeight(stage))) : place;
  const from = /** @type {Pixel} */ ([base[0] - half, base[1]]);
  const to = /** @type {Pixel} */ ([base[0] + half, base[1]]);
  return hatchedLine(from, to, away, stage, key);
}

/**
 * A fixed line, hatched on its right-hand side as seen from its start: a floor, where it goes to the right.
 * @param {Element} element @param {Stage} stage @param {Snapshot} now @param {string} key
 * @returns {Figure}
 */
export function wall(element, stage, now, key) {
  const from = placeOf(stage, now, element.from ?? "");
  const to = placeOf(stage, now, element.to ?? "");
  return unlessMoved(stage, key, at(from) + at(to), () => wallAlong(from, to, stage, key));
}

/** @param {Pixel} from @param {Pixel} to @param {Stage} stage @param {string} key @returns {Figure} */
function wallAlong(from, to, stage, key) {
  const away = scaled(normal(subtract(to, from)), 1 / (lengthOf(subtract(to, from)) || 1));
  return hatchedLine(from, to, away, stage, key);
}

/** A line with strokes on one side. @param {Pixel} from @param {Pixel} to @param {Pixel} away @param {Stage} stage @param {string} key @returns {Figure} */
function hatchedLine(from, to, away, stage, key) {
  const depth = stage.unit * 0.75;
  const strips = beside(from, to, away, depth);
  const shapes = [
    { key: `${key}-hatch`, d: hatching(from, to, away, depth), className: "hatch" },
    { key: `${key}-line`, d: line(from, to), className: "ink thick", strips },
  ];
  return { shapes, labels: [] };
}

/** A hatched line and the end of its strokes: letters keep off both. @param {Pixel} from @param {Pixel} to @param {Pixel} towards @param {number} depth @returns {import("../types.js").Strip[]} */
function beside(from, to, towards, depth) {
  const aside = scaled(towards, depth);
  return [
    [from, to],
    [add(from, aside), add(to, aside)],
  ];
}

/** @param {Element} element @param {Stage} stage */
function holdsPivot(element, stage) {
  return (stage.scene.drawing?.elements ?? []).some((other) => other.kind === "pivot" && other.at === element.at);
}

/** @param {Stage} stage */
const triangleHeight = (stage) => stage.unit * 1.9;

/**
 * A hinge; with the triangle of a fixed support where ground holds it.
 * @param {Element} element @param {Stage} stage @param {Snapshot} now @param {string} key
 * @returns {Figure}
 */
export function pivot(element, stage, now, key) {
  const place = placeOf(stage, now, element.at ?? "");
  const height = triangleHeight(stage) * (place[1] > stage.lower ? 1 : -1);
  const fixed = (stage.scene.drawing?.elements ?? []).some(
    (other) => other.kind === "ground" && other.at === element.at,
  );
  const triangle = polygon([
    [0, 0],
    [stage.unit * 1.15, height],
    [-stage.unit * 1.15, height],
  ]);
  const hinge = { key: `${key}-hinge`, d: circle(stage.unit * 0.42), className: "ink paper hinge", at: place };
  const support = { key: `${key}-triangle`, d: triangle, className: "ink paper", at: place };
  return { shapes: fixed ? [support, hinge] : [hinge], labels: [] };
}

/**
 * A block between two fixed rails, long enough for the whole motion.
 * @param {Element} element @param {Stage} stage @param {Snapshot} now @param {string} key
 * @returns {Figure}
 */
export function guide(element, stage, now, key) {
  const place = placeOf(stage, now, element.at ?? "");
  const along = /** @type {Pixel} */ (element.direction === "horizontal" ? [1, 0] : [0, 1]);
  const across = normal(along);
  const u = stage.unit;
  const middle = scaled(across, dot(place, across));
  const rails = unlessMoved(stage, key, at(middle), () => railsAbout(middle, along, element, stage, key));
  const block = {
    key: `${key}-block`,
    d: box(along, across, u * 1.05, u * 0.8),
    className: marked("ink steel", element),
    at: place,
  };
  return { shapes: [...rails, block], labels: [] };
}

/** @param {Pixel} middle @param {Pixel} along @param {Element} element @param {Stage} stage @param {string} key */
function railsAbout(middle, along, element, stage, key) {
  const [across, u] = [normal(along), stage.unit];
  const [first, last] = stage.once(`reach ${key}`, () => reachOf(stage, element.at ?? "", along));
  return [1, -1].flatMap((side) => {
    const offset = add(middle, scaled(across, side * u * 0.95));
    const from = add(offset, scaled(along, first - 1.5 * u));
    const to = add(offset, scaled(along, last + 1.5 * u));
    return [
      { key: `${key}-hatch${side}`, d: hatching(from, to, scaled(across, side), u * 0.5), className: "hatch" },
      {
        key: `${key}-rail${side}`,
        d: line(from, to),
        className: "ink",
        strips: beside(from, to, scaled(across, side), u * 0.5),
      },
    ];
  });
}

/**
 * How far nearly all of the path of a place reaches in a direction: a motion that runs away in the end takes no rails along.
 * @param {Stage} stage @param {string} at @param {Pixel} along
 */
function reachOf(stage, at, along) {
  const path = stage.trajectory.positions[at] ?? [[0, 0]];
  const sorted = path
    .map((position) => dot(stage.project(position), along))
    .filter(Number.isFinite)
    .sort((a, b) => a - b);
  return [0.02, 0.98].map((part) => sorted[Math.round((sorted.length - 1) * part)] ?? 0);
}

/** @param {Pixel} a @param {Pixel} b */
const dot = (a, b) => a[0] * b[0] + a[1] * b[1];

/** @param {Pixel} along @param {Pixel} across @param {number} half @param {number} wide */
function box(along, across, half, wide) {
  const a = scaled(along, half);
  const b = scaled(across, wide);
  return polygon([add(a, b), subtract(a, b), subtract(scaled(a, -1), b), add(scaled(a, -1), b)]);
}

/** Pieces that a wire is looked at in before it is bent. */
const PIECES = 32;

/**
 * Where a place can be: the curve that it runs through while one coordinate takes all its values and the others stay.
 * @param {Element} element @param {Stage} stage @param {Snapshot} now @param {string} key
 * @returns {Figure}
 */
export function wire(element, stage, now, key) {
  const coordinate = stage.scene.coordinates.find(({ name }) => name === element.coordinate);
  const field = stage.once(`field ${key}`, () => fieldOf(stage, element.at ?? ""));
  if (!coordinate || !field) return { shapes: [], labels: [] };
  /** @type {import("../kinematics/expression.js").Values} */
  const held = { ...now.coordinates, t: now.t };
  const on = field.names.map((name) => (name === coordinate.name ? "" : held[name])).join();
  return unlessMoved(stage, key, on, () => {
    const given = { ...field.given, ...held };
    const place = (/** @type {number} */ q) =>
      stage.project(field.parts.map((part) => part({ ...given, [coordinate.name]: q })));
    const [low, high] = coordinateRange(coordinate);
    const knots = Array.from({ length: PIECES + 1 }, (_, i) => low + ((high - low) * i) / PIECES);
    return {
      shapes: [{ key, d: polyline(traced(place, knots).points), className: marked("ink wire", element) }],
      labels: [],
    };
  });
}

/** The position of a place as functions, and which coordinates it depends on; null where it is written in a way that only the server reads. @param {Stage} stage @param {string} at */
function fieldOf({ scene }, at) {
  const position = [...scene.bodies, ...scene.points].find(({ name }) => name === at)?.position ?? [];
  const moving = [...scene.coordinates.map(({ name }) => name), "t"];
  const names = moving.filter((name) => position.some((text) => new RegExp(`\\b${name}\\b`).test(text)));
  try {
    const parts = position.map(evaluator);
    return { parts, names, given: Object.fromEntries(scene.parameters.map(({ name, value }) => [name, value])) };
  } catch {
    return null;
  }
}
