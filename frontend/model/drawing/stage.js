/** From metres to pixels: what part of the plane is shown, and where a place stands on the screen. */

import { parameterClass } from "../symbols.js";
import { FRONT, viewBy } from "./camera.js";

/** @typedef {import("../types.js").Scene} Scene */
/** @typedef {import("../types.js").Trajectory} Trajectory */
/** @typedef {import("../types.js").Snapshot} Snapshot */
/** @typedef {import("../types.js").Pixel} Pixel */
/** @typedef {{width: number, height: number}} Size */
/** @typedef {[number, number, number, number]} Box  xmin, xmax, ymin, ymax, as in the scene format */

/**
 * @typedef {object} Stage  a scene in a frame of pixels
 * @property {Scene} scene
 * @property {Trajectory} trajectory
 * @property {Size} size
 * @property {number} unit  the size of small things (bob, arrow head, coil) in pixels
 * @property {number} scale  pixels per metre
 * @property {number} lower  pixels from the top to the lower part of what is shown: whatever the shape of the frame, it is the same part
 * @property {number} rem  the size of the page's letters in pixels
 * @property {readonly import("../types.js").Box[]} reserved  where other things lie on the drawing
 * @property {Pixel} down  unit vector of gravity's usual direction on the screen
 * @property {(position: readonly number[]) => Pixel} project
 * @property {(vector: readonly number[]) => Pixel} direct
 * @property {<T>(key: string, make: () => T) => T} once  what stays the same as long as this stage does
 */

/** Growth of the shown part when the motion leaves it, in steps so that it does not creep while a slider moves. */
const GROWTH = 1.25;
/** A runaway motion must not shrink the scene to a dot: all of it is seen where that takes few steps, else this part of the samples, and not at any price. */
const SEEN = 0.9;
const CHEAP = 2;
const STEPS = 8;
/** The origin, from which coordinates are drawn, is seen where it is no farther away than the motion is large, times this. */
const REACH = 2;
/** Metres that a motion is said to be large where it is at rest. */
const LEAST = 0.5;
/** The lower part of what is shown begins at this part of it. */
const LOWER = 0.6;
/** Bodies have a size: part of the smaller side that they take about their place. */
const BODY = 0.035;

/** @param {Scene} scene */
const growsUp = (scene) => scene.drawing?.vertical === "up";

/**
 * The part of the plane to show: the scene's own view, widened to the sides on which the motion leaves it; of space as it is
 * seen from the front, so that who turns it comes no nearer and goes no further.
 * @param {Scene} scene @param {Trajectory} trajectory
 * @returns {Box}
 */
export function viewOf(scene, trajectory) {
  const paths = Object.values(trajectory.positions);
  const own = scene.drawing?.view;
  const points = paths.map((path) => path.map(viewBy(FRONT, growsUp(scene))));
  return own ? widened(/** @type {Box} */ (own), points) : padded(withOrigin(boundsOf(points.flat())));
}

/** @param {readonly Pixel[]} points @returns {Box} */
function boundsOf(points) {
  const box = /** @type {Box} */ ([Infinity, -Infinity, Infinity, -Infinity]);
  for (const [x, y] of points) {
    if (!Number.isFinite(x) || !Number.isFinite(y)) continue;
    box[0] = Math.min(box[0], x);
    box[1] = Math.max(box[1], x);
    box[2] = Math.min(box[2], y);
    box[3] = Math.max(box[3], y);
  }
  return box[0] <= box[1] ? box : [-1, 1, -1, 1];
}

/** @param {Box} box */
const largest = ([x0, x1, y0, y1]) => Math.max(x1 - x0, y1 - y0, LEAST);

/** Grown up to the origin, where that is near. @param {Box} box @returns {Box} */
function withOrigin(box) {
  const [x0, x1, y0, y1] = box;
  const away = Math.max(x0, -x1, y0, -y1);
  if (away > REACH * largest(box)) return box;
  return [Math.min(x0, 0), Math.max(x1, 0), Math.min(y0, 0), Math.max(y1, 0)];
}

/** @param {Box} box @returns {Box} */
function padded([x0, x1, y0, y1]) {
  const margin = 0.15 * largest([x0, x1, y0, y1]);
  return [x0 - margin, x1 + margin, y0 - margin, y1 + margin];
}

/** @param {Box} box @param {Pixel} point @param {number} margin */
function holds([x0, x1, y0, y1], [x, y], margin) {
  return x >= x0 + margin && x <= x1 - margin && y >= y0 + margin && y <= y1 - margin;
}

/** @param {Box} own @param {number} growth about its centre @returns {Box} */
function grown([x0, x1, y0, y1], growth) {
  const [x, y, w, h] = [(x0 + x1) / 2, (y0 + y1) / 2, ((x1 - x0) / 2) * growth, ((y1 - y0) / 2) * growth];
  return [x - w, x + w, y - h, y + h];
}

/** @param {Box} own @param {readonly Pixel[][]} paths @returns {Box} */
function widened(own, paths) {
  const steps = Array.from({ length: STEPS + 1 }, (_, i) => grown(own, GROWTH ** i));
  const isSeen = (/** @type {Box} */ box, /** @type {number} */ part) => {
    const margin = BODY * Math.min(box[1] - box[0], box[3] - box[2]);
    return paths.every((path) => path.filter((point) => holds(box, point, margin)).length >= part * path.length);
  };
  const all = steps.slice(0, CHEAP + 1).find((box) => isSeen(box, 1));
  return trimmed(all ?? steps.find((box) => isSeen(box, SEEN)) ?? steps[STEPS], steps, paths.flat());
}

/** Without what is empty on sides to which the motion does not go. @param {Box} box @param {Box[]} steps from the scene's own view on @param {readonly Pixel[]} points @returns {Box} */
function trimmed(box, steps, points) {
  const margin = BODY * Math.min(box[1] - box[0], box[3] - box[2]);
  const held = points.filter((point) => holds(box, point, margin));
  const side = (/** @type {number} */ i) => {
    const nearer = steps.map((step) => /** @type {Box} */ (box.map((end, j) => (i === j ? step[i] : end))));
    return (nearer.find((one) => held.every((point) => holds(one, point, margin))) ?? box)[i];
  };
  return [side(0), side(1), side(2), side(3)];
}

/** Part of the places of a motion that may be behind numbers, how many are looked at, and how near to them is behind them, in pixels. */
const BEHIND = 0.01;
const LOOKS = 400;
const CLOSE = 14;
/** Part of a drawing that numbers may take away from it. */
const MOST = 0.5;

/** Places of a motion as they are seen from the front. @param {Trajectory} trajectory @param {boolean} up @returns {Pixel[]} */
function someOf({ positions }, up) {
  const paths = Object.values(positions);
  const step = Math.ceil(paths.reduce((sum, path) => sum + path.length, 0) / LOOKS) || 1;
  return paths.flatMap((path) => path.filter((_, i) => i % step === 0).map(viewBy(FRONT, up)));
}

/**
 * A view in a frame: scale, and where its zero is. All of the frame where the motion keeps off the numbers that lie on it,
 * else what is left below or beside them, whichever is larger.
 * @param {Stage["reserved"]} reserved @param {Box} view @param {Trajectory} trajectory @param {Size} size @param {number} sign @returns {{scale: number, origin: Pixel}}
 */
function clearOf(reserved, [x0, x1, y0, y1], trajectory, size, sign) {
  const within = (/** @type {number} */ left, /** @type {number} */ top) => {
    const [width, height] = [size.width - left, size.height - top];
    const scale = Math.min(width / (x1 - x0), height / (y1 - y0));
    const origin = /** @type {Pixel} */ ([
      left + width / 2 - (scale * (x0 + x1)) / 2,
      top + height / 2 - (sign * scale * (y0 + y1)) / 2,
    ]);
    return { scale, origin };
  };
  const whole = within(0, 0);
  if (!reserved.length) return whole;
  const places = someOf(trajectory, sign < 0).map(
    ([x, y]) => /** @type {Pixel} */ ([whole.origin[0] + x * whole.scale, whole.origin[1] + sign * y * whole.scale]),
  );
  const behind = places.filter(([x, y]) =>
    reserved.some(([l, t, r, b]) => x > l - CLOSE && x < r + CLOSE && y > t - CLOSE && y < b + CLOSE),
  );
  if (behind.length <= BEHIND * places.length) return whole;
  const [left, top] = [2, 3].map((side) => Math.max(...reserved.map((box) => box[side])) + CLOSE);
  const others = [
    ...(left < MOST * size.width ? [within(left, 0)] : []),
    ...(top < MOST * size.height ? [within(0, top)] : []),
  ];
  return others.sort((one, other) => other.scale - one.scale)[0] ?? whole;
}

/**
 * @param {Scene} scene @param {Trajectory} trajectory @param {Size} size
 * @param {{rem?: number, reserved?: Stage["reserved"], camera?: import("./camera.js").Camera}} [page]
 * @returns {Stage}
 */
export function stageOf(scene, trajectory, size, { rem = 16, reserved = [], camera = FRONT } = {}) {
  const sign = growsUp(scene) ? -1 : 1;
  const view = viewOf(scene, trajectory);
  const { scale, origin } = clearOf(reserved, view, trajectory, size, sign);
  const [top, bottom] = [view[2], view[3]].map((y) => origin[1] + sign * scale * y).sort((one, other) => one - other);
  const seen = viewBy(camera, growsUp(scene));
  /** @param {readonly number[]} vector @returns {Pixel} */
  const direct = (vector) => {
    const [x, y] = seen(vector);
    return [x * scale, sign * y * scale];
  };
  /** @param {readonly number[]} position @returns {Pixel} */
  const project = (position) => {
    const [x, y] = seen(position);
    return [origin[0] + x * scale, origin[1] + sign * y * scale];
  };
  const unit = Math.max(8, Math.min(48, Math.min(size.width, size.height) / 30));
  const lower = top + LOWER * (bottom - top);
  return { scene, trajectory, size, unit, scale, lower, rem, reserved, down: [0, 1], project, direct, once: keeper() };
}

/** Makes each thing when it is first asked for, and keeps it. @returns {Stage["once"]} */
export function keeper() {
  /** @type {Map<string, unknown>} */
  const kept = new Map();
  return (key, make) => {
    if (!kept.has(key)) kept.set(key, make());
    return /** @type {ReturnType<typeof make>} */ (kept.get(key));
  };
}

/**
 * Makes a thing anew only when what it depends on has changed.
 * @template T
 * @param {Stage} stage @param {string} key @param {string} on @param {() => T} make
 * @returns {T}
 */
export function unlessMoved(stage, key, on, make) {
  const kept = stage.once(`last ${key}`, () => ({ on, made: make() }));
  if (kept.on !== on) Object.assign(kept, { on, made: make() });
  return kept.made;
}

/** Where a point or body stands at a moment. @param {Stage} stage @param {Snapshot} now @param {string} place */
export function placeOf(stage, now, place) {
  return stage.project(now.positions[place] ?? [0, 0, 0].slice(0, stage.scene.dimension));
}

/** A length in metres, given as a number or as the name of a parameter; 0 if it is not. @param {number | string | undefined} given @param {Stage} stage */
export function sizeOf(given, stage) {
  const named = stage.scene.parameters.find((parameter) => parameter.name === given);
  return named?.value ?? (Number(given) || 0);
}

/** The class of a coordinate: one quantity, one colour. @param {Scene} scene @param {string | undefined} name */
export function coordinateClass(scene, name) {
  const index = scene.coordinates.findIndex((coordinate) => coordinate.name === name);
  return index < 0 ? "" : `q-${index}`;
}

/** Classes of a mark, with those of the symbols that are at home in its element. @param {string} own @param {import("../types.js").Element} element */
export const marked = (own, { marks }) => (marks ? `${own} ${marks}` : own);

/** The class of a letter: that of its coordinate or parameter. @param {Scene} scene @param {string | undefined} name */
export const letterClass = (scene, name) => coordinateClass(scene, name) || parameterClass(scene, name);

/** The LaTeX of a coordinate or parameter. @param {Scene} scene @param {string | undefined} name */
export function latexOf(scene, name) {
  const found = [...scene.coordinates, ...scene.parameters].find((symbol) => symbol.name === name);
  return found?.latex || name || "";
}
