/** What is drawn over a slide: strokes in fractions of its width and height, so that every window shows them alike. */

/** @typedef {[number, number]} Point */
/** @typedef {{colour: number, points: Point[]}} Stroke */

/** As many as there are colours in the style sheet. */
export const COLOURS = 4;
const MOST_STROKES = 400;
const MOST_POINTS = 4000;
/** How near the eraser must come, in fractions of the width. */
const NEAR = 0.015;

/** @param {number} value */
const rounded = (value) => Math.round(Math.max(0, Math.min(1, value)) * 1e4) / 1e4;

/** @param {number} x @param {number} y @param {{left: number, top: number, width: number, height: number}} frame @returns {Point} */
export const pointIn = (x, y, { left, top, width, height }) => [
  rounded((x - left) / (width || 1)),
  rounded((y - top) / (height || 1)),
];

/** @param {readonly Stroke[]} strokes @param {Stroke} stroke */
export const withStroke = (strokes, stroke) => [...strokes, stroke].slice(-MOST_STROKES);

/** The last stroke goes on. @param {readonly Stroke[]} strokes @param {Point} point @returns {Stroke[]} */
export function drawnOn(strokes, point) {
  const last = strokes[strokes.length - 1];
  if (!last || last.points.length >= MOST_POINTS) return [...strokes];
  return [...strokes.slice(0, -1), { ...last, points: [...last.points, point] }];
}

/** Without the strokes that a point touches. @param {readonly Stroke[]} strokes @param {Point} point @param {number} ratio  height over width */
export const erased = (strokes, [x, y], ratio) =>
  strokes.filter(({ points }) => points.every(([px, py]) => Math.hypot(px - x, (py - y) * ratio) > NEAR));

/** The outline in a box of 1 by 1; a dot where nothing has been drawn but a point. @param {Stroke} stroke */
export function pathOf({ points }) {
  const [[x, y], ...rest] = points;
  return `M${x} ${y}${rest.length ? rest.map(([a, b]) => `L${a} ${b}`).join("") : `l0.0001 0`}`;
}

/** What another window sent as strokes. @param {unknown} value @returns {value is Stroke[]} */
export const areStrokes = (value) =>
  Array.isArray(value) &&
  value.length <= MOST_STROKES &&
  value.every(
    (one) =>
      Number.isInteger(one?.colour) &&
      Array.isArray(one?.points) &&
      one.points.length > 0 &&
      one.points.every((/** @type {unknown} */ p) => Array.isArray(p) && p.length === 2 && p.every(Number.isFinite)),
  );
