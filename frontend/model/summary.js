/** A motion in words, for those who do not see it: what each coordinate does, and what becomes of the energy. */

/** @typedef {import("./types.js").Trajectory} Trajectory */
/**
 * What a coordinate does: it rests; swings between two values, with a period; or goes from one value to another.
 * @typedef {{kind: "rests", from: number} | {kind: "swings", low: number, high: number, period: number} | {kind: "goes", from: number, to: number}} Course
 */

/** What moves less than this part of its size, or of one unit, rests. */
const STILL = 1e-6;
/** An energy that changes less than this part of its range of parts is kept. */
const KEPT = 1e-3;

/** Points of a curve between two samples: extremes and passages lie between them. */
const FINER = 8;

/**
 * @param {readonly number[]} samples  times @param {(t: number) => number} at
 * @returns {Course}
 */
export function courseOf(samples, at) {
  const between = (/** @type {number} */ t, /** @type {number} */ i) =>
    Array.from({ length: FINER }, (_, k) => t + (k / FINER) * (samples[i + 1] - t));
  const times = samples.flatMap((t, i) => (i + 1 < samples.length ? between(t, i) : [t]));
  const values = times.map(at);
  const [low, high] = extremesOf(values);
  if (high - low <= STILL * Math.max(1, Math.abs(high))) return { kind: "rests", from: values[0] };
  const rises = risesThrough(times, values, (low + high) / 2);
  if (rises.length > 1)
    return { kind: "swings", low, high, period: (rises[rises.length - 1] - rises[0]) / (rises.length - 1) };
  return { kind: "goes", from: values[0], to: values[values.length - 1] };
}

/** @param {readonly number[]} values @returns {[number, number]} */
const extremesOf = (values) =>
  values.reduce(([low, high], value) => [Math.min(low, value), Math.max(high, value)], [Infinity, -Infinity]);

/** The times at which the values pass a level upwards. @param {readonly number[]} times @param {readonly number[]} values @param {number} level */
function risesThrough(times, values, level) {
  return times.slice(1).flatMap((t, i) => {
    const [before, after] = [values[i], values[i + 1]];
    return before < level && after >= level ? [times[i] + ((level - before) / (after - before)) * (t - times[i])] : [];
  });
}

/** Whether kinetic and potential energy together stay the same; null where they are not known. @param {Trajectory} trajectory */
export function keepsEnergy({ energy }) {
  if (!energy?.kinetic.length) return null;
  const sums = energy.kinetic.map((kinetic, i) => kinetic + energy.potential[i]);
  const spread = (/** @type {readonly number[]} */ values) => extremesOf(values).reduce((low, high) => high - low);
  return spread(sums) <= KEPT * Math.max(spread(energy.kinetic), Number.MIN_VALUE);
}
