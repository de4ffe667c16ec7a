/** Which values of the coordinates bring a place where the hand is. */

import { moved } from "./kinematics.js";

/** @typedef {import("./kinematics.js").Kinematics} Kinematics */
/** @typedef {import("./expression.js").Values} Values */
/** @typedef {import("../types.js").Pixel} Pixel */

const ROUNDS = 40;
/** Damping against the square of the largest slope: it chooses the smallest change where several would do. */
const DAMPING = 1e-3;

/**
 * Levenberg and Marquardt's damped least squares on the screen: |project(r(q)) − target|² + λ|Δq|² → min, repeated with
 * less damping after a step that came nearer and with more after one that did not.
 * @param {Kinematics} kinematics @param {string} place @param {Values} q start @param {number} t
 * @param {Pixel} target @param {(position: number[]) => Pixel} project
 * @returns {Values}
 */
export function reached(kinematics, place, q, t, target, project) {
  const missing = (/** @type {Values} */ at) => {
    const [x, y] = project(kinematics.places(at, t)[place]);
    return /** @type {Pixel} */ ([target[0] - x, target[1] - y]);
  };
  let [now, damping] = [q, DAMPING];
  for (let round = 0; round < ROUNDS; round += 1) {
    const error = missing(now);
    const columns = kinematics.free.map((name) => columnOf(kinematics, place, now, t, name, project));
    const step = solved(columns, error, damping);
    const next = moved(now, Object.fromEntries(kinematics.free.map((name, i) => [name, step[i]])));
    const nearer = Math.hypot(...missing(next)) < Math.hypot(...error);
    if (nearer) now = next;
    damping = Math.max(DAMPING, damping * (nearer ? 0.2 : 10));
    if (Math.max(...step.map(Math.abs)) < 1e-7) break;
  }
  return now;
}

/** Pixels that a place moves per unit of a coordinate. @param {Kinematics} kinematics @param {string} place @param {Values} q @param {number} t @param {string} name @param {(position: number[]) => Pixel} project @returns {Pixel} */
function columnOf(kinematics, place, q, t, name, project) {
  const slope = kinematics.slope(q, t, { [name]: 1 })[place];
  const [origin, tip] = [project(slope.map(() => 0)), project(slope)];
  return [tip[0] - origin[0], tip[1] - origin[1]];
}

/** Jᵀ (J Jᵀ + λ)⁻¹ b: two rows, so the inverse is written down. @param {Pixel[]} columns @param {Pixel} b @param {number} relative */
function solved(columns, b, relative) {
  const dot = (/** @type {0 | 1} */ r, /** @type {0 | 1} */ s) =>
    columns.reduce((sum, column) => sum + column[r] * column[s], 0);
  const damping = relative * Math.max(...columns.map(([x, y]) => x * x + y * y), 1e-12);
  const [a, c, d] = [dot(0, 0) + damping, dot(0, 1), dot(1, 1) + damping];
  const size = a * d - c * c;
  const [u, v] = [(d * b[0] - c * b[1]) / size, (a * b[1] - c * b[0]) / size];
  return columns.map(([x, y]) => x * u + y * v);
}
