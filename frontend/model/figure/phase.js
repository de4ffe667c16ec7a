/** Phase portraits: the rate of a coordinate over its value, one picture for each coordinate. */

import { nearestOn, traced } from "../curve.js";
import { smooth } from "../interpolation.js";
import { coordinateAt, leastRange, trustedUntil } from "../trajectory.js";
import { dotted } from "../values.js";
import { polyline } from "../drawing/geometry.js";
import { niceFloor, perSecond, unitText } from "../numbers.js";

/** @typedef {import("../types.js").Pixel} Pixel */
/** @typedef {import("../types.js").Trajectory} Trajectory */
/** @typedef {{position: number, value: number}} Tick */
/**
 * @typedef {object} Portrait
 * @property {string} name @property {string} className @property {string} across @property {string} up  LaTeX of the axes
 * @property {[string, string]} units
 * @property {number} left @property {number} width  in pixels
 * @property {Tick[]} columns @property {Tick[]} rows
 * @property {string[]} paths  of the motion, then of the runs beside it, as far as they are trusted
 * @property {string} doubted  the rest of the motion
 * @property {(t: number) => Pixel} where  the present state
 * @property {(pixel: Pixel) => {t: number, far: number}} nearest  the moment whose state is nearest to a place
 */

/** Rooms at the left, right, top and bottom of a picture, in type sizes; and as many pictures as can be read. */
export const ROOM = { left: 3.2, right: 0.8, top: 2, bottom: 2 };
const MOST = 3;
/** Type sizes from one number below a picture to the next, at least. */
const APART_IN_EMS = 3;

/** Value and rate of a coordinate over time. @param {Trajectory} trajectory @param {string} name @returns {(t: number) => Pixel} */
function stateOf(trajectory, name) {
  const rate = smooth(trajectory.t, trajectory.rates[name]);
  return (t) => [coordinateAt(trajectory, name, t), rate(t)];
}

/**
 * @param {import("../types.js").Scene} scene @param {readonly Trajectory[]} trajectories the present one first
 * @param {{width: number, height: number}} size @param {number} em type size in pixels
 * @returns {Portrait[]}
 */
export function portraitsOf(scene, trajectories, size, em) {
  const shown = scene.coordinates.filter(({ name }) => trajectories[0].coordinates[name]).slice(0, MOST);
  const width = size.width / shown.length;
  return shown.map((coordinate, i) =>
    portrait(
      coordinate,
      `q-${scene.coordinates.indexOf(coordinate)}`,
      trajectories,
      { left: i * width, width, height: size.height },
      em,
    ),
  );
}

/**
 * @param {import("../types.js").Coordinate} coordinate @param {string} className @param {readonly Trajectory[]} trajectories
 * @param {{left: number, width: number, height: number}} box @param {number} em
 * @returns {Portrait}
 */
function portrait({ name, latex, unit }, className, trajectories, { left, width, height }, em) {
  const [trajectory] = trajectories;
  const least = leastRange(trajectory);
  const x = scaleOf(
    trajectories.flatMap((each) => each.coordinates[name] ?? []),
    left + ROOM.left * em,
    left + width - ROOM.right * em,
    { least, apart: APART_IN_EMS * em },
  );
  const y = scaleOf(
    trajectories.flatMap((each) => each.rates[name] ?? []),
    height - ROOM.bottom * em,
    ROOM.top * em,
    { least },
  );
  const place = (/** @type {Pixel} */ [q, v]) => /** @type {Pixel} */ ([x.pixel(q), y.pixel(v)]);
  const states = trajectories.map((each) => stateOf(each, name));
  const curves = trajectories.map((each, i) => traced((t) => place(states[i](t)), each.t));
  return {
    name,
    className,
    left,
    width,
    columns: x.ticks,
    rows: y.ticks,
    across: latex || name,
    up: dotted(latex || name),
    units: [unitText(unit), unitText(perSecond(unit))],
    paths: curves.map(({ t, points }, i) => polyline(points.filter((_, n) => t[n] <= trustedUntil(trajectories[i])))),
    doubted: polyline(curves[0].points.filter((_, n) => curves[0].t[n] >= trustedUntil(trajectory))),
    where: (t) => place(states[0](t)),
    nearest: (pixel) => nearestOn(curves[0], pixel),
  };
}

/** Pixels from one number on an axis to the next, at least. */
const APART = 48;
/** What changes by less than this part of its size rests: its numbers could not be told apart. */
const STILL = 1e-4;

/** The smallest of 1, 2, 5 times a power of ten that is not below x. @param {number} x */
function niceCeil(x) {
  const below = niceFloor(x);
  return below >= 0.999 * x ? below : niceFloor(2.6 * below);
}

/**
 * @param {readonly number[]} values @param {number} from @param {number} to in pixels
 * @param {{share?: number, apart?: number, least?: number}} [wishes]
 *   share of the range that is left free at both ends, pixels from one number to the next, and the least range that shows anything
 */
export function scaleOf(values, from, to, { share = 0.08, apart = APART, least = 0 } = {}) {
  const [low, high] = values.reduce(
    ([least, most], value) => [Math.min(least, value), Math.max(most, value)],
    [Infinity, -Infinity],
  );
  const span = Math.max(high - low, least, STILL * Math.max(Math.abs(low), Math.abs(high)), 1e-9);
  const room = share * span + (span - (high - low)) / 2;
  const [a, b] = [low - room, high + room];
  const pixel = (/** @type {number} */ value) => from + ((value - a) / (b - a)) * (to - from);
  const step = niceCeil(((b - a) * apart) / Math.abs(to - from));
  const first = Math.ceil(a / step);
  const ticks = Array.from({ length: Math.max(0, Math.floor(b / step) - first + 1) }, (_, i) => ({
    value: Number(((first + i) * step).toPrecision(6)),
    position: pixel((first + i) * step),
  }));
  return { pixel, ticks };
}
