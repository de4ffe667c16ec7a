/** Phase portraits: the rate of a coordinate over its value, one picture for each coordinate. */

import { ratesAt } from "../kinematics/rates.js";
import { blendAt, scalarAt } from "../trajectory.js";
import { dotted } from "../values.js";
import { at } from "../drawing/geometry.js";
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
 * @property {string[]} paths  of the motion, then of the runs beside it
 * @property {(t: number) => Pixel} where  the present state
 * @property {(pixel: Pixel) => {t: number, far: number}} nearest  the moment whose state is nearest to a place
 */

/** Rooms at the left, right, top and bottom of a picture, in type sizes; and as many pictures as can be read. */
export const ROOM = { left: 3.2, right: 0.8, top: 2, bottom: 2 };
const MOST = 3;

/** A closed curve bends more than one over time: so many points to an interval between two samples. */
const FINER = 4;
const FEWEST = 1200;

/** The times at which a curve is drawn. @param {Trajectory} trajectory */
function timesOf({ t }) {
  const finer = t.length < FEWEST ? FINER : 1;
  return t.flatMap((from, i) => (i + 1 < t.length ? Array.from({ length: finer }, (_, k) => from + ((t[i + 1] - from) * k) / finer) : [from]));
}

/** Value and rate at a moment. @param {Trajectory} trajectory @param {string} name @param {number} t @returns {Pixel} */
const stateAt = (trajectory, name, t) => [scalarAt(trajectory.coordinates[name], blendAt(trajectory.t, t)), ratesAt(trajectory, t)[name]];

/**
 * @param {import("../types.js").Scene} scene @param {readonly Trajectory[]} trajectories the present one first
 * @param {{width: number, height: number}} size @param {number} em type size in pixels
 * @returns {Portrait[]}
 */
export function portraitsOf(scene, trajectories, size, em) {
  const shown = scene.coordinates.filter(({ name }) => trajectories[0].coordinates[name]).slice(0, MOST);
  const width = size.width / shown.length;
  return shown.map((coordinate, i) => portrait(coordinate, `q-${scene.coordinates.indexOf(coordinate)}`, trajectories, { left: i * width, width, height: size.height }, em));
}

/**
 * @param {import("../types.js").Coordinate} coordinate @param {string} className @param {readonly Trajectory[]} trajectories
 * @param {{left: number, width: number, height: number}} box @param {number} em
 * @returns {Portrait}
 */
function portrait({ name, latex, unit }, className, trajectories, { left, width, height }, em) {
  const [trajectory] = trajectories;
  const times = timesOf(trajectory);
  const curves = trajectories.map((each) => timesOf(each).map((t) => stateAt(each, name, t)));
  const points = curves.flat().filter((point) => point.every(Number.isFinite));
  const x = scaleOf(points.map((point) => point[0]), left + ROOM.left * em, left + width - ROOM.right * em);
  const y = scaleOf(points.map((point) => point[1]), height - ROOM.bottom * em, ROOM.top * em);
  const place = (/** @type {Pixel} */ [q, v]) => /** @type {Pixel} */ ([x.pixel(q), y.pixel(v)]);
  return {
    name, className, left, width, columns: x.ticks, rows: y.ticks,
    across: latex || name, up: dotted(latex || name), units: [unitText(unit), unitText(perSecond(unit))],
    paths: curves.map((curve) => `M${curve.filter((point) => point.every(Number.isFinite)).map((point) => at(place(point))).join("L")}`),
    where: (t) => place(stateAt(trajectory, name, t)),
    nearest([px, py]) {
      const far = curves[0].map((point) => Math.hypot(place(point)[0] - px, place(point)[1] - py));
      const i = far.indexOf(Math.min(...far));
      return { t: times[i], far: far[i] };
    },
  };
}

/** Pixels from one number on an axis to the next, at least. */
const APART = 48;

/** The smallest of 1, 2, 5 times a power of ten that is not below x. @param {number} x */
function niceCeil(x) {
  const below = niceFloor(x);
  return below >= 0.999 * x ? below : niceFloor(2.6 * below);
}

/**
 * @param {number[]} values @param {number} from @param {number} to in pixels
 * @param {number} [share] of the range that is left free at both ends @param {number} [apart] pixels from one number to the next
 */
export function scaleOf(values, from, to, share = 0.08, apart = APART) {
  const [low, high] = [Math.min(...values), Math.max(...values)];
  const room = share * Math.max(high - low, 1e-6 * Math.abs(high), 1e-9);
  const [a, b] = [low - room, high + room];
  const pixel = (/** @type {number} */ value) => from + ((value - a) / (b - a)) * (to - from);
  const step = niceCeil(((b - a) * apart) / Math.abs(to - from));
  const first = Math.ceil(a / step);
  const ticks = Array.from({ length: Math.max(0, Math.floor(b / step) - first + 1) }, (_, i) => ({ value: Number(((first + i) * step).toPrecision(6)), position: pixel((first + i) * step) }));
  return { pixel, ticks };
}
