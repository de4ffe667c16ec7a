/** A motion as it was computed: everything at a moment, where it ends, and what of it can be seen. */

import { blendAt, hermiteAt, scalarAt, spanAt, vectorAt } from "./interpolation.js";

/** @typedef {import("./types.js").Trajectory} Trajectory */

/** The coordinate of a trajectory at a time. @param {Trajectory} trajectory @param {string} name @param {number} t */
export const coordinateAt = ({ t: times, coordinates, rates }, name, t) =>
  hermiteAt(coordinates[name], rates[name], spanAt(times, t));

/**
 * @template V, W
 * @param {Record<string, V>} record @param {(value: V, name: string) => W} change
 * @returns {Record<string, W>}
 */
function mapped(record, change) {
  /** @type {Record<string, W>} */
  const made = {};
  for (const name of Object.keys(record)) made[name] = change(record[name], name);
  return made;
}

/**
 * Everything at time t.
 * @param {Trajectory} trajectory @param {number} t
 * @returns {import("./types.js").Snapshot}
 */
export function snapshotAt(trajectory, t) {
  const { t: times, energy, rates } = trajectory;
  const [span, blend] = [spanAt(times, t), blendAt(times, t)];
  const scalar = (/** @type {number[]} */ values) => scalarAt(values, blend);
  const vector = (/** @type {number[][]} */ values) => vectorAt(values, blend);
  return {
    t,
    coordinates: mapped(trajectory.coordinates, (values, name) => hermiteAt(values, rates[name], span)),
    rates: mapped(rates, scalar),
    positions: mapped(trajectory.positions, vector),
    loads: mapped(trajectory.loads ?? {}, vector),
    energy: energy
      ? { kinetic: scalar(energy.kinetic), potential: scalar(energy.potential), balance: scalar(energy.balance) }
      : null,
  };
}

/** The multipliers of constraints at time t. @param {Trajectory} trajectory @param {number} t @returns {Record<string, number>} */
export const multipliersAt = ({ t: times, multipliers }, t) =>
  mapped(multipliers ?? {}, (values) => scalarAt(values, blendAt(times, t)));

/** The forces of dry friction at time t, by load. @param {Trajectory} trajectory @param {number} t @returns {Record<string, number>} */
export const frictionsAt = ({ t: times, friction }, t) =>
  mapped(friction ?? {}, ({ force }) => scalarAt(force, blendAt(times, t)));

/** The last time with a sample. @param {Trajectory | null} trajectory */
export function endOf(trajectory) {
  return trajectory?.t.at(-1) ?? 0;
}

/**
 * What is to be said of a motion that is not simply right, whatever its status is called: why, what helps, and whether
 * its samples show it at all.
 * @param {Trajectory} trajectory @param {import("./catalog.js").Translate} t
 */
export function caveatsOf({ status, reason, remedy, coarse, t: times }, t) {
  const told = status === "ok" ? [] : [reason || t("status.incomplete"), remedy ?? ""];
  return [...told, coarse ? t("status.coarse", { count: times.length }) : ""].filter(Boolean);
}

/** Times are rounded to fifteen digits. */
const ROUNDED = 1e-12;

/** The last time at which what is drawn can be believed. @param {Trajectory} trajectory */
export function trustedUntil(trajectory) {
  const [end, trusted] = [endOf(trajectory), trajectory.trusted_until ?? Infinity];
  return trusted < end * (1 - ROUNDED) ? trusted : end;
}

/** The largest error estimate, or null if there is none. @param {Trajectory} trajectory */
export function largestError(trajectory) {
  const known = (trajectory.error?.estimate ?? []).filter((e) => e !== null && Number.isFinite(e));
  return known.length
    ? known.reduce((most, e) => Math.max(/** @type {number} */ (most), /** @type {number} */ (e)), 0)
    : null;
}

/** Decimals of a number as it is written. @param {number} value */
function decimalsIn(value) {
  const [, fraction = "", power = "0"] = String(value).match(/\.?(\d*)(?:e([-+]\d+))?$/) ?? [];
  return Math.max(0, (String(value).includes(".") ? fraction.length : 0) - Number(power));
}

/** No double has more that mean something, next to a number of one's size. */
const MOST_DECIMALS = 15;

/**
 * How many decimals of a curve's values are known around a moment: up to the first one in doubt, by the error estimates
 * at its samples; where there are none, as many as its samples are written with.
 * @param {readonly number[]} times @param {readonly number[]} values @param {readonly (number | null)[]} errors at the samples
 */
export function decimalsKnown(times, values, errors) {
  return (/** @type {number} */ t) => {
    const { i, j, s } = spanAt(times, t);
    const near = s === 0 ? [i] : s === 1 ? [j] : [i, j];
    const error = Math.max(...near.map((at) => errors[at] ?? NaN));
    const decimals = error > 0 ? Math.ceil(-Math.log10(error)) : Math.max(...near.map((at) => decimalsIn(values[at])));
    return Math.max(0, Math.min(MOST_DECIMALS, decimals));
  };
}

/** So many times its error a coordinate moves before it is seen to move; more than this it does in any case. */
const DOUBTFUL = 10;
const SURE = 1e-3;

/** A range below which a curve of coordinates would show nothing but errors and rounding. @param {Trajectory} trajectory */
export const leastRange = (trajectory) => Math.min(DOUBTFUL * (largestError(trajectory) ?? 0), SURE);

/** A runaway curve leaves the frame when its outermost values lie this many times further out than the rest. */
const RUNAWAY = 4;

/** The range of the values, without the last few of them if they have run away. @param {readonly number[]} sorted */
export function usual(sorted) {
  const at = (/** @type {number} */ part) => sorted[Math.round((sorted.length - 1) * part)];
  const span = Math.max(at(0.97) - at(0.03), 1e-9);
  const held = (/** @type {number} */ extreme, /** @type {number} */ usual) =>
    Math.abs(extreme - usual) > RUNAWAY * span ? usual : extreme;
  return [held(at(0), at(0.03)), held(at(1), at(0.97))];
}
