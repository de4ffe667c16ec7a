/** The angles of spherical coordinates, drawn in space and seen as everything in it: from the vertical, and round it. */

import { add, arrowHead, at as pixel, line, polyline, scaled, subtract, unit, wrapped } from "./geometry.js";
import { massOf } from "./bodies.js";
import { aboutArc, tipBox } from "./marks.js";
import { boxAbout } from "./placing.js";
import { coordinateClass, latexOf, marked, sizeOf } from "./stage.js";

/** @typedef {import("../types.js").Element} Element */
/** @typedef {import("../types.js").Figure} Figure */
/** @typedef {import("../types.js").Pixel} Pixel */
/** @typedef {import("../types.js").Snapshot} Snapshot */
/** @typedef {import("./stage.js").Stage} Stage */
/** @typedef {[number, number, number]} Place */
/** @typedef {(turn: number) => number[]} Circle  the place on a circle in space at an angle */

/** @type {Figure} */
const NOTHING = { shapes: [], labels: [] };
/** Radii in units of the drawing, and the least angle that has an arc. */
const POLAR = 4.8;
const ROUND = 3.6;
const LEAST = 0.03;
/** Below this angle an arc has no room for its letter. */
const NARROW = 0.15;
/** Pieces of an arc for each radian. */
const FINENESS = 10;
/** Pieces that letters keep off as if they were one. */
const COARSE = 4;
const LINED = 0.8;

/** @param {Snapshot} now @param {string | undefined} place @returns {Place} */
function placeIn(now, place) {
  const [x = 0, y = 0, z = 0] = now.positions[place ?? ""] ?? [];
  return [x, y, z];
}

/**
 * ϑ: the arc from the vertical to the line between two places, in the plane of both.
 * @param {Element} element @param {Stage} stage @param {Snapshot} now @param {string} key
 * @returns {Figure}
 */
export function polar(element, stage, now, key) {
  if (stage.scene.dimension !== 3) return NOTHING;
  const [centre, end] = [placeIn(now, element.from), placeIn(now, element.to)];
  const [x, y, z] = end.map((value, i) => value - centre[i]);
  const across = Math.hypot(x, y);
  const radius = Math.min((POLAR * stage.unit) / stage.scale, 0.75 * Math.hypot(across, z));
  const on = /** @type {Circle} */ (
    (turn) => [
      centre[0] + (across ? x / across : 1) * radius * Math.sin(turn),
      centre[1] + (across ? y / across : 0) * radius * Math.sin(turn),
      centre[2] + radius * Math.cos(turn),
    ]
  );
  const level = (/** @type {number} */ height) => stage.project([centre[0], centre[1], height]);
  const d = line(level(Math.min(centre[2], end[2])), level(Math.max(end[2], centre[2] + 1.15 * radius)));
  const axis = { key: `${key}-axis`, d, className: "reference" };
  const side = { key: `${key}-side`, d: line(stage.project(centre), stage.project(end)), className: "reference" };
  return arc(element, stage, { key, centre, on, turn: Math.atan2(across, z), below: [axis, side] });
}

/**
 * ψ: the arc round the vertical through `at`, level with `to`, to where `to` stands from the first axis, or from the
 * direction that the element says.
 * @param {Element} element @param {Stage} stage @param {Snapshot} now @param {string} key
 * @returns {Figure}
 */
export function azimuth(element, stage, now, key) {
  if (stage.scene.dimension !== 3) return NOTHING;
  const [foot, end] = [placeIn(now, element.at), placeIn(now, element.to)];
  const centre = /** @type {Place} */ ([foot[0], foot[1], end[2]]);
  const radius = (ROUND * stage.unit) / stage.scale;
  const zero = sizeOf(element.offset, stage);
  const on = /** @type {Circle} */ (
    (turn) => [centre[0] + radius * Math.cos(zero + turn), centre[1] + radius * Math.sin(zero + turn), centre[2]]
  );
  const middle = stage.project(centre);
  const past = (/** @type {Pixel} */ tip) => add(middle, scaled(subtract(tip, middle), 1.15));
  const below = [
    { key: `${key}-first`, d: line(middle, past(stage.project(on(0)))), className: "reference" },
    { key: `${key}-level`, d: line(middle, stage.project(end)), className: "reference" },
  ];
  return arc(element, stage, { key, centre, on, turn: wrapped(now.coordinates[element.coordinate ?? ""] ?? 0), below });
}

/** Sides of the polygon that a top's rim is drawn as. */
const SIDES = 48;

/**
 * A disc in space about a place, through two places of its rim a quarter turn apart, with a spoke to each of them and its
 * axle: the frame of the body.
 * @param {Element} element @param {Stage} stage @param {Snapshot} now @param {string} key
 * @returns {Figure}
 */
export function wheel(element, stage, now, key) {
  if (stage.scene.dimension !== 3) return NOTHING;
  const [centre, first, second] = [element.at, element.from, element.to].map((place) => placeIn(now, place));
  const [a, b] = [first, second].map((end) => end.map((value, i) => value - centre[i]));
  const radius = Math.hypot(...a) || 1;
  const normal = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  const on = (/** @type {number} */ turn) =>
    stage.project(centre.map((c, i) => c + Math.cos(turn) * a[i] + Math.sin(turn) * b[i]));
  const rim = Array.from({ length: SIDES + 1 }, (_, i) => on((i * 2 * Math.PI) / SIDES));
  const middle = stage.project(centre);
  const axle = stage.project(centre.map((c, i) => c + (0.5 * normal[i]) / radius));
  const spoke = (/** @type {Pixel} */ end, /** @type {string} */ name, /** @type {string} */ className) => ({
    key: `${key}-${name}`,
    d: line(middle, end),
    className,
  });
  return {
    shapes: [
      {
        key,
        d: `${polyline(rim)}Z`,
        className: marked(`ink steel body-${element.at}`, element),
        strips: chordsOf(rim),
        boxes: filled(rim),
      },
      spoke(stage.project(first), "first", "ink mark"),
      spoke(stage.project(second), "second", "extension"),
      spoke(axle, "axle", "ink"),
    ],
    labels: massOf(element.at, stage, middle, ...halvesOf(rim)),
  };
}

/** Parts of its width and height that a rim fills for sure: its middle, across and along. */
const WITHIN = [
  [0.96, 0.5],
  [0.5, 0.96],
  [0.78, 0.78],
];

/** Half of a rim's width and height. @param {readonly Pixel[]} rim @returns {[number, number]} */
function halvesOf(rim) {
  const half = (/** @type {number[]} */ values) => (Math.max(...values) - Math.min(...values)) / 2;
  return [half(rim.map(([x]) => x)), half(rim.map(([, y]) => y))];
}

/** What a rim encloses, to be kept off. @param {readonly Pixel[]} rim @returns {import("../types.js").Box[]} */
function filled(rim) {
  const [xs, ys] = [rim.map(([x]) => x), rim.map(([, y]) => y)];
  const [left, right, top, bottom] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  const middle = /** @type {Pixel} */ ([(left + right) / 2, (top + bottom) / 2]);
  return WITHIN.map(([across, along]) => boxAbout(middle, (across * (right - left)) / 2, (along * (bottom - top)) / 2));
}

/** Every sixth side of a rim is enough to keep letters off it. @param {readonly Pixel[]} rim @returns {import("../types.js").Strip[]} */
const chordsOf = (rim) => Array.from({ length: SIDES / 6 }, (_, i) => [rim[6 * i], rim[6 * i + 6]]);

/**
 * A top: a cone that stands on its point, with a rim about its axis at the second place, and a spoke that turns with
 * the coordinate, counted from the line of nodes, where the rim is level.
 * @param {Element} element @param {Stage} stage @param {Snapshot} now @param {string} key
 * @returns {Figure}
 */
export function top(element, stage, now, key) {
  if (stage.scene.dimension !== 3) return NOTHING;
  const [foot, centre] = [placeIn(now, element.from), placeIn(now, element.to)];
  const [x, y, z] = centre.map((value, i) => value - foot[i]);
  const [across, height] = [Math.hypot(x, y), Math.hypot(x, y, z) || 1];
  const nodes = across ? [-y / across, x / across, 0] : [1, 0, 0];
  const rising = [(-z * nodes[1]) / height, (z * nodes[0]) / height, (x * nodes[1] - y * nodes[0]) / height];
  const radius = sizeOf(element.radius, stage) || (2 * stage.unit) / stage.scale;
  const on = (/** @type {number} */ turn) =>
    stage.project(centre.map((c, i) => c + radius * (Math.cos(turn) * nodes[i] + Math.sin(turn) * rising[i])));
  const rim = Array.from({ length: SIDES + 1 }, (_, i) => on((i * 2 * Math.PI) / SIDES));
  const [apex, middle] = [stage.project(foot), stage.project(centre)];
  const [ax, ay] = subtract(middle, apex);
  const aside = (/** @type {Pixel} */ point) => {
    const [px, py] = subtract(point, apex);
    return (ax * py - ay * px) / (Math.hypot(px, py) || 1);
  };
  const edges = [...rim].sort((a, b) => aside(a) - aside(b));
  const turn = now.coordinates[element.coordinate ?? ""] ?? 0;
  const tip = on(turn);
  return {
    shapes: [
      { key: `${key}-cone`, d: polyline([edges[0], apex, /** @type {Pixel} */ (edges.at(-1))]), className: "ink" },
      {
        key,
        d: `${polyline(rim)}Z`,
        className: marked(`ink steel body-${element.to}`, element),
        strips: chordsOf(rim),
        boxes: filled(rim),
      },
      {
        key: `${key}-spoke`,
        d: line(middle, tip),
        className: `ink mark ${coordinateClass(stage.scene, element.coordinate)}`,
      },
    ],
    labels: [
      {
        key,
        latex: latexOf(stage.scene, element.coordinate),
        at: add(tip, scaled(unit(subtract(tip, middle)), stage.unit)),
        className: coordinateClass(stage.scene, element.coordinate),
      },
    ],
  };
}

/** A line with many corners in few pieces. @param {readonly Pixel[]} points @returns {import("../types.js").Strip[]} */
function piecesOf(points) {
  const corners = points.filter((_, i) => i % COARSE === 0 || i === points.length - 1);
  return corners.slice(1).map((corner, i) => [corners[i], corner]);
}

/**
 * An arc with its head and its letter.
 * @param {Element} element @param {Stage} stage
 * @param {{key: string, centre: readonly number[], on: Circle, turn: number, below: Figure["shapes"]}} about
 * @returns {Figure}
 */
export function arc(element, stage, { key, centre, on, turn, below }) {
  if (!(Math.abs(turn) > LEAST)) return { shapes: below, labels: [] };
  const className = marked(coordinateClass(stage.scene, element.coordinate), element);
  const count = Math.max(3, Math.ceil(Math.abs(turn) * FINENESS));
  const points = Array.from({ length: count + 1 }, (_, i) => stage.project(on((turn * i) / count)));
  const tip = points[count];
  const size = Math.min(stage.unit * 0.8, 0.5 * Math.hypot(...subtract(tip, points[0])));
  const head = arrowHead(tip, unit(subtract(tip, points[count - 1])), LINED * size);
  // There and back: a path that is filled shows no more of the arc than its line.
  const there = polyline(points.slice(0, -1));
  const back = points
    .slice(0, -2)
    .reverse()
    .map((point) => `L${pixel(point)}`)
    .join("");
  const hub = stage.project(centre);
  const beside = (/** @type {number} */ part, /** @type {number} */ out) => {
    const point = stage.project(on(part * turn));
    return add(point, scaled(unit(subtract(point, hub)), out * stage.unit));
  };
  return {
    shapes: [
      ...below,
      {
        key: `${key}-arc`,
        d: there + back + head,
        className: `pointed mark ${className}`,
        boxes: [tipBox(tip, unit(subtract(tip, points[count - 1])), LINED * size)],
        strips: piecesOf(points),
      },
    ],
    labels: [
      {
        key,
        latex: latexOf(stage.scene, element.coordinate),
        ...aboutArc(beside),
        className,
        opacity: Number(Math.abs(turn) > NARROW),
      },
    ],
  };
}
