/** The path that a place has just left, fainter with age. */

import { knotsBetween, traced } from "../curve.js";
import { smoothPath } from "../interpolation.js";
import { polyline } from "./geometry.js";
import { unlessMoved } from "./stage.js";

/** @typedef {import("../types.js").Element} Element */
/** @typedef {import("../types.js").Figure} Figure */
/** @typedef {import("./stage.js").Stage} Stage */
/** @typedef {import("../types.js").Snapshot} Snapshot */

/** A trail is made of this many pieces of so many seconds, each fainter with age. */
const PIECES = 10;
const PIECE = 0.16;
const STRONGEST = 0.55;
/** Opacity changes by whole steps of this, so that few pieces are touched in one frame. */
const SHADE = 0.05;

/** The path of a place from one time to a later one. @param {Stage} stage @param {string} place @param {number} from @param {number} to */
export function trailOf({ trajectory, project, once }, place, from, to) {
  const { t: times, positions } = trajectory;
  if (!positions[place] || to <= from) return "";
  const path = once(`path ${place}`, () => smoothPath(times, positions[place]));
  return polyline(traced((t) => project(path(t)), knotsBetween(times, from, to)).points);
}

/**
 * Pieces are cut at fixed times: all but the newest stay as they are while they fade.
 * @param {Element} element @param {Stage} stage @param {Snapshot} now @param {string} key
 * @returns {Figure}
 */
export function trail(element, stage, now, key) {
  const newest = Math.floor(now.t / PIECE);
  const path = (/** @type {number} */ n, /** @type {number} */ end) =>
    n < 0 ? "" : trailOf(stage, element.at ?? "", n * PIECE, end);
  const shapes = Array.from({ length: PIECES }, (_, i) => {
    const n = newest - ((((newest - i) % PIECES) + PIECES) % PIECES);
    const fresh = Math.max(0, 1 - (now.t - n * PIECE) / (PIECES * PIECE));
    const shade = Math.round((fresh ** 1.6 * STRONGEST) / SHADE);
    const piece = (/** @type {number} */ end) => ({
      key: `${key}-${i}`,
      d: path(n, end),
      className: "trail",
      opacity: shade * SHADE,
    });
    return n === newest
      ? piece(now.t)
      : unlessMoved(stage, `${key}-${i}`, `${n} ${shade}`, () => piece((n + 1) * PIECE));
  });
  return { shapes, labels: [] };
}
