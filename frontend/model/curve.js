/** A curve as a polyline that cannot be told from it on a screen. */

import { spanAt } from "./interpolation.js";

/** @typedef {import("./types.js").Pixel} Pixel */
/** @typedef {{t: number[], points: Pixel[]}} Trace  the corners of a polyline and their times */

/** Pixels that a chord may lie beside its curve, and within which corners are one. */
const SAG = 0.1;
/** Halvings of an interval between two knots: the curve between them is a cubic, of which 2¹⁰ chords see everything. */
const DEEPEST = 10;

/** The time just before another. @param {number} t */
export const before = (t) => t * (1 - Number.EPSILON);

/**
 * The curve from the first knot to the last. A knot that stands twice is a jump: the curve comes to its value before
 * and goes on from that behind. Corners lie closer where it bends more, in pixels: as many as it takes.
 * @param {(t: number) => Pixel} place @param {readonly number[]} knots  times between which the curve is a single cubic
 * @returns {Trace}
 */
export function traced(place, knots) {
  /** @type {Trace} */
  const trace = { t: [], points: [] };
  let begin = knots[0];
  let from = place(begin);
  add(trace, begin, from);
  for (let k = 1; k < knots.length; k += 1) {
    const knot = knots[k] === knots[k + 1] ? before(knots[k]) : knots[k];
    const to = place(knot);
    bend(trace, place, begin, from, knot, to, DEEPEST);
    [begin, from] = [knot, to];
  }
  end(trace, begin, from);
  return trace;
}

/**
 * The corners after `a` up to `b`, by halving where the chord is seen to leave the curve.
 * @param {Trace} trace @param {(t: number) => Pixel} place
 * @param {number} a @param {Pixel} from @param {number} b @param {Pixel} to @param {number} depth
 */
function bend(trace, place, a, from, b, to, depth) {
  const middle = (a + b) / 2;
  const half = place(middle);
  // A cubic may cross its chord in the middle, but not in the quarters, too.
  const straight =
    beside(half, from, to) < SAG &&
    beside(place((a + middle) / 2), from, to) < SAG &&
    beside(place((middle + b) / 2), from, to) < SAG;
  if (depth === 0 || straight || !half.every(Number.isFinite)) return add(trace, b, to);
  bend(trace, place, a, from, middle, half, depth - 1);
  bend(trace, place, middle, half, b, to, depth - 1);
}

/** A corner, unless it cannot be told from the last one, or has no place. @param {Trace} trace @param {number} t @param {Pixel} point */
function add({ t: times, points }, t, point) {
  const last = points[points.length - 1];
  if (!Number.isFinite(point[0]) || !Number.isFinite(point[1])) return;
  if (last && Math.abs(point[0] - last[0]) < SAG && Math.abs(point[1] - last[1]) < SAG) return;
  times.push(t);
  points.push(point);
}

/** The last corner is where the curve ends. @param {Trace} trace @param {number} t @param {Pixel} point */
function end(trace, t, point) {
  if (trace.t[trace.t.length - 1] === t || !point.every(Number.isFinite)) return;
  trace.t.push(t);
  trace.points.push(point);
}

/**
 * A polyline in pieces: it is broken where its curve has no value, midway between two corners.
 * @param {Trace} trace @param {(t: number) => number} at  the curve's values @returns {Trace[]}
 */
export function unbroken({ t, points }, at) {
  const ends = t.flatMap((end, i) => (Number.isFinite(at((end + (t[i + 1] ?? end)) / 2)) ? [] : [i + 1]));
  const starts = [0, ...ends];
  return starts.map((from, i) => ({ t: t.slice(from, ends[i]), points: points.slice(from, ends[i]) }));
}

/** The part of a chord at which it is nearest to a point. @param {Pixel} point @param {Pixel} from @param {Pixel} to */
function partOf([x, y], [ax, ay], [bx, by]) {
  const [dx, dy] = [bx - ax, by - ay];
  const length = dx * dx + dy * dy;
  return length > 0 ? Math.max(0, Math.min(1, ((x - ax) * dx + (y - ay) * dy) / length)) : 0;
}

/** How far a point is from a chord. @param {Pixel} point @param {Pixel} from @param {Pixel} to */
function beside(point, from, to) {
  const s = partOf(point, from, to);
  return Math.hypot(point[0] - from[0] - s * (to[0] - from[0]), point[1] - from[1] - s * (to[1] - from[1]));
}

/** The moment at which a curve is nearest to a point, the first if it comes there again, and how far it is then. @param {Trace} trace @param {Pixel} point */
export function nearestOn({ t, points }, point) {
  let found = { t: t[0], far: Infinity, n: 0 };
  for (let n = 1; n < t.length; n += 1) {
    const far = beside(point, points[n - 1], points[n]);
    const again = n > found.n + 1;
    if (far < found.far - (again ? SAG : 0))
      found = { t: t[n - 1] + partOf(point, points[n - 1], points[n]) * (t[n] - t[n - 1]), far, n };
  }
  return found;
}

/** The knots from one time to another: both, and the samples between them. @param {readonly number[]} times @param {number} from @param {number} to */
export function knotsBetween(times, from, to) {
  const [first, last] = [spanAt(times, from).i, spanAt(times, to).j];
  return [from, ...times.slice(first, last + 1).filter((t) => t > from && t < to), to];
}
