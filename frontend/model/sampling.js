/**
 * How many samples show a motion: the answer itself tells, and where they are too few it is asked for again.
 *
 * Every other sample is left out and predicted from the rest, in the way in which curves are drawn. Intervals twice as
 * long have sixteen times the error of those that are drawn (fourth order).
 */

import { blendAt, hermiteAt, scalarAt, spanAt } from "./interpolation.js";
import { leastRange, usual } from "./trajectory.js";

/** @typedef {import("./types.js").Trajectory} Trajectory */
/** @typedef {import("./types.js").Sent<"/simulations">} Request */
/** @typedef {Pick<Request, "t_end" | "step"> & {samples: number}} Asked  of a request, what is looked at here */
/** @typedef {{values: readonly number[], rates?: readonly number[], doubt: (i: number) => number, low: number, high: number, range: number}} Quantity  shown from low to high, to a scale on which `range` fills the plot; doubt: by how much the sample of a number may be off beside its neighbours */

/** The server sends 20001 samples at most; this is one more than a prime number. */
const MOST = 19998;

/** Whether a number has no divisor but one and itself. @param {number} n */
function isPrime(n) {
  for (let d = 2; d * d <= n; d += 1) if (n % d === 0) return false;
  return true;
}

/**
 * About so many samples, not more than can be had. Their intervals are a prime number: a force of so and so many periods
 * is met at ever other phases of it, and not always at the same.
 * @param {number} wanted
 */
export function samplesFor(wanted) {
  let intervals = Math.min(MOST, Math.max(3, Math.ceil(wanted))) - 1;
  while (!isPrime(intervals)) intervals += 1;
  return intervals + 1;
}
/** A projector gives this many pixels to the range of a curve, and a curve may be this much of a pixel beside the motion. */
const PIXELS = 800;
const BESIDE = 0.3;
/** Part of its range by which a left-out sample may be missed. */
const MISSED = (16 * BESIDE) / PIXELS;
/** Part of its range by which a rate may miss the way that its coordinate goes. */
const ASTRAY = BESIDE / PIXELS;
/** Forces may jump, and an arrow is drawn turning for one interval then: for so much of the time at most. */
const TURNING = 0.03;
/** Fewer tell nothing about a motion that ended at once. */
const FEWEST = 17;

/** Of a curve with kinks the error falls more slowly: then so many times more samples are asked for at least, and at most. */
const LEAST_MORE = 1.5;
const MOST_MORE = 6;
const ROOM = 1.15;
/** Times that a motion is asked for again. */
const ROUNDS = 5;

/** An adaptive method takes three steps to a swing at least: with fewer to a sample, none swings unseen between two of them. */
const STEPS_TO_A_SAMPLE = 2;
const ENOUGH = 4001;

/** Values that tell where most of a curve is, when it may have run away. */
const SOME = 500;
/** A range is this part of the size at least, as in the plots. */
const STILL = 1e-6;
const SMALLEST = 1e-9;

/** An answer is rounded to this part of its error at most: half of the last of eight bits. */
const ROUNDING = 2 ** -8;
/** Roundings that may come together in what is predicted from neighbours, and its own. */
const TOGETHER = 3;

const exactly = () => 0;

/** By how much rounding may put a sample off beside its neighbours. @param {readonly (number | null)[] | null} [errors] */
const roundingBy = (errors) => (errors ? (/** @type {number} */ i) => TOGETHER * ROUNDING * (errors[i] ?? 0) : exactly);

/** A quantity as it is shown. @param {readonly number[]} values @param {Quantity["doubt"]} doubt @param {readonly number[]} [rates] @returns {Quantity} */
function quantity(values, doubt, rates) {
  const stride = Math.ceil(values.length / SOME);
  const few = values.filter((value, i) => Number.isFinite(value) && (i % stride === 0 || i === values.length - 1));
  const [low, high] = few.length ? usual(few.sort((a, b) => a - b)) : [0, 0];
  return {
    values,
    rates,
    doubt,
    low,
    high,
    range: Math.max(high - low, STILL * Math.max(Math.abs(low), Math.abs(high)), SMALLEST),
  };
}

/** The components of vectors. @param {readonly number[][]} vectors */
const componentsOf = (vectors) => (vectors[0] ?? []).map((_, c) => vectors.map((vector) => vector[c]));

/** Quantities that are drawn to one scale. @param {readonly Quantity[]} quantities @param {number} [least] */
function together(quantities, least = 0) {
  const range = Math.max(least, ...quantities.map((one) => one.range));
  return quantities.map((one) => ({ ...one, range }));
}

/** All that is drawn as a curve. @param {Trajectory} trajectory @returns {Quantity[]} */
function quantitiesOf(trajectory) {
  const { coordinates, rates, positions, energy, error } = trajectory;
  const least = leastRange(trajectory);
  const rounding = roundingBy(error?.estimate);
  return [
    ...Object.entries(coordinates).flatMap(([name, values]) =>
      together([quantity(values, rounding, rates[name])], least),
    ),
    ...Object.values(rates).flatMap((values) => together([quantity(values, rounding)], least)),
    ...together(
      Object.values(positions ?? {})
        .flatMap(componentsOf)
        .map((values) => quantity(values, rounding)),
    ),
    ...Object.entries(trajectory.multipliers ?? {}).map(([name, values]) =>
      quantity(values, roundingBy(error?.multipliers?.[name])),
    ),
    ...Object.values(trajectory.friction ?? {}).map(({ force }) => quantity(force, exactly)),
    ...Object.values(trajectory.contacts ?? {}).map(({ force }) => quantity(force, exactly)),
    ...(energy ? energiesOf(energy) : []),
  ];
}

/** What the balance departs from its start is error, also in its parts. @param {import("./types.js").Energy} energy */
function energiesOf({ kinetic, potential, balance }) {
  const drift = TOGETHER * largest(balance.map((value) => Math.abs(value - balance[0])));
  return together([kinetic, potential, balance].map((values) => quantity(values, () => drift)));
}

/** Numbers of samples that are kept when every other is left out; those at jumps, whose times stand twice, are. @param {readonly number[]} times */
function halved(times) {
  let since = -1;
  return times.flatMap((t, i) => {
    const isEdge = t === times[i - 1] || t === times[i + 1];
    since = isEdge ? 0 : since + 1;
    return since % 2 === 0 ? [i] : [];
  });
}

/**
 * By how much samples are missed when they are left out, as parts of the range.
 * @param {readonly number[]} times
 * @returns {(quantity: Quantity) => number[]}
 */
function missing(times) {
  const kept = halved(times);
  const few = kept.map((i) => times[i]);
  const last = kept[kept.length - 1];
  const here = new Set(kept);
  const left = times.map((_, i) => i).filter((i) => i < last && !here.has(i));
  const spans = left.map((i) => spanAt(few, times[i]));
  const blends = left.map((i) => blendAt(few, times[i]));
  return ({ values, rates, doubt, low, high, range }) => {
    const [some, slopes] = [kept.map((i) => values[i]), rates && kept.map((i) => rates[i])];
    const drawn = (/** @type {number} */ n) => (slopes ? hermiteAt(some, slopes, spans[n]) : scalarAt(some, blends[n]));
    const shown = (/** @type {number} */ value) => value > low - range && value < high + range;
    const off = (/** @type {number} */ i, /** @type {number} */ n) =>
      Math.max(0, Math.abs(drawn(n) - values[i]) - doubt(i));
    return left.map((i, n) => (shown(values[i]) ? off(i, n) / range : 0));
  };
}

/**
 * By how much rates miss the way that coordinates go, as parts of their range: what swings between two samples is seen
 * in its rate, or in that the rate does not lead to the next value (Simpson's rule over two intervals, fourth order).
 * @param {Trajectory} trajectory
 */
function astray({ t, coordinates, rates, error }) {
  return Object.entries(coordinates).flatMap(([name, q]) => {
    const v = rates[name];
    const { range } = quantity(v, exactly);
    return t.slice(2).map((end, i) => {
      const [h, k] = [t[i + 1] - t[i], end - t[i + 1]];
      if (!(h > 0) || Math.abs(h - k) > 1e-6 * h) return 0;
      // Of both values, and twice h times that of the rates.
      const [first, last] = [error?.estimate?.[i] ?? 0, error?.estimate?.[i + 2] ?? 0];
      const rounding = ROUNDING * (first + last + 2 * h * Math.max(first, last));
      return (
        Math.max(0, Math.abs(q[i + 2] - q[i] - (h / 3) * (v[i] + 4 * v[i + 1] + v[i + 2])) - rounding) / (2 * h * range)
      );
    });
  });
}

/** How many times more samples are wanted; 1 where they are enough. @param {Trajectory} trajectory */
function more(trajectory) {
  if (trajectory.t.length < FEWEST) return trajectory.t.length > 1 ? MOST_MORE : 1;
  const missed = missing(trajectory.t);
  const off = Math.max(...quantitiesOf(trajectory).map((one) => largest(missed(one))));
  const worst = Math.max(off, largest(astray(trajectory)) * (MISSED / ASTRAY));
  if (worst > MISSED) return Math.min(MOST_MORE, Math.max(LEAST_MORE, ROOM * (worst / MISSED) ** 0.25));
  return turning(trajectory, missed) > TURNING ? 2 : 1;
}

/** @param {readonly number[]} values */
const largest = (values) => values.reduce((most, value) => Math.max(most, value), 0);

/** The part of the time in which an arrow is not where its samples are. @param {Trajectory} trajectory @param {(quantity: Quantity) => number[]} missed */
function turning({ loads }, missed) {
  const parts = Object.values(loads ?? {})
    .flatMap((vectors) => together(componentsOf(vectors).map((values) => quantity(values, exactly))))
    .map((one) => {
      const off = missed(one);
      return off.filter((part) => part > MISSED).length / Math.max(1, off.length);
    });
  return Math.max(0, ...parts);
}

/**
 * The number of samples that show the motion; the one that was asked for, if it does.
 * @param {Trajectory} trajectory @param {Asked} asked
 */
function samplesNeeded(trajectory, { samples, step }) {
  const steps = step === undefined ? (trajectory.cost?.steps ?? 0) : 0;
  const unseen = steps > STEPS_TO_A_SAMPLE * samples ? Math.min(ENOUGH, steps + 1) : 0;
  const wanted = Math.max((samples - 1) * more(trajectory) + 1, unseen);
  return wanted > samples ? Math.max(samples, samplesFor(wanted)) : samples;
}

/**
 * A motion that is asked for until its samples show it. Each answer is handed on, and says whether it is too coarse:
 * then curves through its samples are not the motion.
 * @param {(request: Request, signal?: AbortSignal) => Promise<Trajectory>} simulate
 */
export function sampled(simulate) {
  /** @template {Request & Asked} R @param {R} request @param {AbortSignal} [signal] @returns {Promise<Trajectory>} */
  async function ask(request, signal) {
    for (let [asked, round] = [request, 1]; ; round += 1) {
      const { trajectory, again } = judged(await simulate(asked, signal), asked, round);
      if (!again) return trajectory;
      asked = again;
    }
  }
  return ask;
}

/**
 * An answer with what its samples are worth, and the request that shows more, if there is one.
 * @template {Asked} R
 * @param {Trajectory} trajectory @param {R} asked @param {number} round  how often it was asked for
 * @returns {{trajectory: Trajectory, again: R | null}}
 */
export function judged(trajectory, asked, round) {
  const resolved = more(trajectory) === 1;
  const samples = samplesNeeded(trajectory, asked);
  const again = samples > asked.samples && round <= ROUNDS ? { ...asked, samples } : null;
  return { trajectory: { ...trajectory, coarse: !resolved }, again };
}
