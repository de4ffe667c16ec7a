/** A trajectory between its samples. */

/** @typedef {import("./types.js").Trajectory} Trajectory */
/** @typedef {{index: number[], weight: number[]}} Blend  four neighbouring samples and their weights */

/**
 * Catmull–Rom weights at time t: exact at the samples, smooth between them (error of third order in the spacing).
 * @param {readonly number[]} times increasing @param {number} t
 * @returns {Blend}
 */
export function blendAt(times, t) {
  const last = times.length - 1;
  if (last < 1) return { index: [0, 0, 0, 0], weight: [0, 1, 0, 0] };
  const i = intervalOf(times, t);
  const s = Math.max(0, Math.min(1, (t - times[i]) / (times[i + 1] - times[i])));
  const index = [Math.max(0, i - 1), i, i + 1, Math.min(last, i + 2)];
  const s2 = s * s;
  const s3 = s2 * s;
  const weight = [(-s3 + 2 * s2 - s) / 2, (3 * s3 - 5 * s2 + 2) / 2, (-3 * s3 + 4 * s2 + s) / 2, (s3 - s2) / 2];
  return { index, weight };
}

/** The i with times[i] ≤ t < times[i+1], by bisection. @param {readonly number[]} times @param {number} t */
function intervalOf(times, t) {
  let low = 0;
  let high = times.length - 2;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (times[middle] <= t) low = middle;
    else high = middle - 1;
  }
  return low;
}

/** Written out, because it is wanted a hundred times in a frame. @param {readonly number[]} values @param {Blend} blend */
export function scalarAt(values, { index: [a, b, c, d], weight: [u, v, w, x] }) {
  return u * values[a] + v * values[b] + w * values[c] + x * values[d];
}

/** @param {readonly number[][]} vectors @param {Blend} blend */
function vectorAt(vectors, { index, weight }) {
  const [a, b, c, d] = index.map((i) => vectors[i]);
  const [u, v, w, x] = weight;
  return vectors[0].map((_, k) => u * a[k] + v * b[k] + w * c[k] + x * d[k]);
}

/**
 * @template V, W
 * @param {Record<string, V>} record @param {(value: V) => W} change
 * @returns {Record<string, W>}
 */
function mapped(record, change) {
  /** @type {Record<string, W>} */
  const made = {};
  for (const name of Object.keys(record)) made[name] = change(record[name]);
  return made;
}

/**
 * Everything at time t.
 * @param {Trajectory} trajectory @param {number} t
 * @returns {import("./types.js").Snapshot}
 */
export function snapshotAt(trajectory, t) {
  const blend = blendAt(trajectory.t, t);
  const scalar = (/** @type {number[]} */ values) => scalarAt(values, blend);
  const vector = (/** @type {number[][]} */ values) => vectorAt(values, blend);
  const { energy } = trajectory;
  return {
    t,
    coordinates: mapped(trajectory.coordinates, scalar),
    rates: mapped(trajectory.rates ?? {}, scalar),
    positions: mapped(trajectory.positions, vector),
    loads: mapped(trajectory.loads ?? {}, vector),
    energy: energy
      ? { kinetic: scalar(energy.kinetic), potential: scalar(energy.potential), balance: scalar(energy.balance) }
      : null,
  };
}

/**
 * The path of a place from one time to a later one, oldest first.
 * @param {Trajectory} trajectory @param {string} place @param {number} from @param {number} to @param {number} count of intervals
 */
export function trailOf(trajectory, place, from, to, count) {
  const path = trajectory.positions[place];
  if (!path || to <= from) return [];
  const times = Array.from({ length: count + 1 }, (_, i) => from + ((to - from) * i) / count);
  return times.map((time) => vectorAt(path, blendAt(trajectory.t, time)));
}

/** Samples to a step of the integrator: an adaptive one takes a few steps to a period, a curve wants more points. */
const SAMPLES_TO_A_STEP = 2;
const MOST_SAMPLES = 4001;

/**
 * How many samples show every swing of a motion; the number it has, if that is enough.
 * @param {Trajectory} trajectory computed with steps chosen by the method
 */
export function samplesNeeded({ t, cost }) {
  const wanted = Math.min(MOST_SAMPLES, SAMPLES_TO_A_STEP * (cost?.steps ?? 0) + 1);
  return wanted > 1.3 * t.length ? wanted : t.length;
}

/** The last time with a sample. @param {Trajectory | null} trajectory */
export function endOf(trajectory) {
  return trajectory?.t.at(-1) ?? 0;
}

/** The largest error estimate, or null if there is none. @param {Trajectory} trajectory */
export function largestError(trajectory) {
  const known = (trajectory.error?.estimate ?? []).filter((e) => e !== null && Number.isFinite(e));
  return known.length ? Math.max(.../** @type {number[]} */ (known)) : null;
}
