/**
 * Variation and differential of the positions at one moment, side by side.
 *
 * δr = Σ ∂r/∂qᵢ δqᵢ compares two configurations at the same time; dr = Σ ∂r/∂qᵢ dqᵢ + ∂r/∂t dt follows the motion.
 * Lengths in metres, works in joules.
 */

import { configured, moved } from "../kinematics/kinematics.js";

/** Below this part of δr there is nothing to see of a summand. */
const LEAST = 1e-3;

/** @typedef {import("../types.js").Snapshot} Snapshot */
/** @typedef {import("../kinematics/kinematics.js").Kinematics} Kinematics */
/** @typedef {import("../kinematics/expression.js").Values} Values */

/**
 * @typedef {{body: string, at: number[], variation: number[], parts: {coordinate: string, vector: number[]}[], frozen: number[], explicit: number[]}} Displacement
 *   from `at`: δr, the part ∂r/∂qᵢ δqᵢ of each coordinate that moves it, and the two parts of dr, with the time frozen and because of the time alone
 * @typedef {{varied: Snapshot, later: Snapshot | null, displacements: Displacement[], works: {load: string, work: number}[], total: number}} Virtual
 */

/**
 * @param {Kinematics} kinematics @param {Snapshot} now @param {readonly string[]} bodies
 * @param {import("./choice.js").Choice} choice
 * @returns {Virtual}
 */
export function virtualOf(kinematics, now, bodies, { delta, dt }) {
  const q = now.coordinates;
  const along = scaled(now.rates, dt);
  const [variation, frozen, explicit] = [
    kinematics.slope(q, now.t, delta),
    kinematics.slope(q, now.t, only(along, kinematics.free)),
    kinematics.slope(q, now.t, {}, dt),
  ];
  const parts = kinematics.free
    .filter((name) => delta[name])
    .map((name) => ({ coordinate: name, slope: kinematics.slope(q, now.t, only(delta, [name])) }));
  const works = kinematics.works(q, now.rates, now.t, delta);
  return {
    varied: configured(kinematics, now, moved(q, delta)),
    later: dt ? configured(kinematics, { ...now, t: now.t + dt }, moved(q, along)) : null,
    displacements: bodies
      .filter((body) => variation[body]?.every(Number.isFinite))
      .map((body) => ({
        body,
        at: now.positions[body],
        variation: variation[body],
        parts: parts
          .map(({ coordinate, slope }) => ({ coordinate, vector: slope[body] }))
          .filter(({ vector }) => Math.hypot(...vector) > LEAST * Math.hypot(...variation[body])),
        frozen: frozen[body],
        explicit: explicit[body],
      })),
    works,
    total: works.reduce((sum, { work }) => sum + work, 0),
  };
}

/** @param {Values} values @param {number} s @returns {Values} */
export const scaled = (values, s) =>
  Object.fromEntries(Object.entries(values).map(([name, value]) => [name, value * s]));

/** @param {Values} values @param {readonly string[]} names @returns {Values} */
const only = (values, names) => Object.fromEntries(names.map((name) => [name, values[name] ?? 0]));
