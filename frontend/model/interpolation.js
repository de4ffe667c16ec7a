/**
 * Curves through samples, piece by piece cubic and with one slope at each sample.
 *
 * Coordinates follow the cubic that has the computed values and rates at both ends of an interval (Hermite), error
 * h⁴ q⁗/384. What comes without its own rate (rates, places, forces, energies) takes as slope at a sample that of the
 * quartic through it and its four nearest neighbours (error of fourth order, too).
 *
 * Where a motion jumps or bends (impacts, sticking), a time stands twice, before and behind: no curve runs across.
 */

/** @typedef {{i: number, j: number, s: number, h: number}} Span  between the samples i and j, at the part s of their distance h */
/** @typedef {{index: number[], weight: number[]}} Blend  neighbouring samples and their weights */

/**
 * Where a moment lies among the samples; held at both ends.
 * @param {readonly number[]} times increasing @param {number} t
 * @returns {Span}
 */
export function spanAt(times, t) {
  const i = intervalOf(times, t);
  const j = Math.min(i + 1, times.length - 1);
  const h = times[j] - times[i];
  return { i, j, h, s: h > 0 ? Math.max(0, Math.min(1, (t - times[i]) / h)) : 0 };
}

/** The i with times[i] ≤ t < times[i+1], by bisection. @param {readonly number[]} times @param {number} t */
function intervalOf(times, t) {
  let low = 0;
  let high = Math.max(0, times.length - 2);
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (times[middle] <= t) low = middle;
    else high = middle - 1;
  }
  return low;
}

/** Hermite's cubics: of the value before, the value after, the slope before, the slope after. @param {number} s @returns {[number, number, number, number]} */
function cubics(s) {
  const r = 1 - s;
  return [(1 + 2 * s) * r * r, s * s * (3 - 2 * s), s * r * r, -s * s * r];
}

/**
 * A quantity whose rate is known at the samples.
 * @param {readonly number[]} values @param {readonly number[]} rates @param {Span} span
 */
export function hermiteAt(values, rates, { i, j, s, h }) {
  const [before, after, out, into] = cubics(s);
  return before * values[i] + after * values[j] + h * (out * rates[i] + into * rates[j]);
}

/** A sample at the end of a smooth stretch, this much nearer than the next distance, is too near to tell a slope by. */
const NEAR = 0.25;
/** Samples that tell a slope. */
const STENCIL = 5;

/**
 * The samples around number k up to the ends of its smooth stretch, k among them; those that are too near to an end
 * are left out, or the end itself where the slope is not asked there.
 * @param {readonly number[]} times @param {number} k
 */
function stretchAround(times, k) {
  let [first, last] = [k, k];
  while (first > k - STENCIL - 1 && times[first - 1] < times[first]) first -= 1;
  while (last < k + STENCIL + 1 && times[last + 1] > times[last]) last += 1;
  const gap = (/** @type {number} */ n) => times[n + 1] - times[n];
  const many = last - first > 1;
  const starts = !(times[first - 1] < times[first]);
  const ends = !(times[last + 1] > times[last]);
  const left = [];
  if (many && starts && gap(first) < NEAR * gap(first + 1)) left.push(k === first ? first + 1 : first);
  if (many && ends && gap(last - 1) < NEAR * gap(last - 2)) left.push(k === last ? last - 1 : last);
  const found = [];
  for (let n = first; n <= last; n += 1) if (n === k || !left.includes(n)) found.push(n);
  return found;
}

/** The samples that tell the slope at number k, k among them. @param {readonly number[]} times @param {number} k */
function neighbours(times, k) {
  const found = stretchAround(times, k);
  const from = Math.max(0, Math.min(found.indexOf(k) - 2, found.length - STENCIL));
  return found.slice(from, from + STENCIL);
}

/**
 * Weights of the slope at sample k: the derivative of the polynomial through the samples `at`.
 * @param {readonly number[]} times @param {readonly number[]} at @param {number} k
 */
function slopeWeights(times, at, k) {
  let own = 0;
  const weights = at.map((m) => {
    if (m === k) return 0;
    let [over, under] = [1, times[m] - times[k]];
    for (const n of at) {
      if (n === m || n === k) continue;
      over *= times[k] - times[n];
      under *= times[m] - times[n];
    }
    own += over / under;
    return over / under;
  });
  // A constant has no slope.
  weights[at.indexOf(k)] = -own;
  return weights;
}

/**
 * The weights of neighbouring samples at time t, for what comes without its own rate.
 * @param {readonly number[]} times increasing @param {number} t
 * @returns {Blend}
 */
export function blendAt(times, t) {
  const { i, j, s, h } = spanAt(times, t);
  const [before, after, out, into] = cubics(s);
  const index = [i, j];
  const weight = [before, after];
  for (const [k, part] of [
    [i, out],
    [j, into],
  ]) {
    const at = neighbours(times, k);
    slopeWeights(times, at, k).forEach((w, n) => {
      index.push(at[n]);
      weight.push(h * part * w);
    });
  }
  return { index, weight };
}

/** Written out, because it is wanted a hundred times in a frame. @param {readonly number[]} values @param {Blend} blend */
export function scalarAt(values, { index, weight }) {
  let sum = 0;
  for (let n = 0; n < index.length; n += 1) sum += weight[n] * values[index[n]];
  return sum;
}

/** @param {readonly number[][]} vectors @param {Blend} blend */
export function vectorAt(vectors, { index, weight }) {
  return vectors[0].map((_, k) => {
    let sum = 0;
    for (let n = 0; n < index.length; n += 1) sum += weight[n] * vectors[index[n]][k];
    return sum;
  });
}

/** The slope of a quantity at each of its samples. @param {readonly number[]} times @param {readonly number[]} values */
function slopesOf(times, values) {
  return values.map((_, k) => {
    const at = neighbours(times, k);
    const weights = slopeWeights(times, at, k);
    return at.reduce((sum, n, m) => sum + weights[m] * values[n], 0);
  });
}

/**
 * A quantity that comes without its own rate as a function of time: the same as by blends, for many moments at once.
 * @param {readonly number[]} times @param {readonly number[]} values
 * @returns {(t: number) => number}
 */
export function smooth(times, values) {
  const slopes = slopesOf(times, values);
  return (t) => hermiteAt(values, slopes, spanAt(times, t));
}

/** A place or a force as a function of time. @param {readonly number[]} times @param {readonly number[][]} vectors @returns {(t: number) => number[]} */
export function smoothPath(times, vectors) {
  const parts = (vectors[0] ?? []).map((_, c) =>
    smooth(
      times,
      vectors.map((vector) => vector[c]),
    ),
  );
  return (t) => parts.map((part) => part(t));
}
