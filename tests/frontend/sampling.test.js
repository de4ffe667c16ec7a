import { strict as assert } from "node:assert";
import { test } from "node:test";
import { knotsBetween, traced } from "../../frontend/model/curve.js";
import { judged, sampled, samplesFor } from "../../frontend/model/sampling.js";
import { snapshotAt } from "../../frontend/model/trajectory.js";
import { trajectory } from "./fixtures.js";

/** Seconds of every motion here. */
const END = 10;

/**
 * A server that knows motions in closed form, and counts what it is asked for.
 * @param {(t: number) => [number, number]} motion  a coordinate and its rate
 * @param {object} [more]
 */
function serverOf(motion, more = {}) {
  /** @type {number[]} */
  const asked = [];
  /** @param {any} request @returns {Promise<any>} */
  async function simulate({ samples }) {
    asked.push(samples);
    const t = Array.from({ length: samples }, (_, i) => (END * i) / (samples - 1));
    const states = t.map(motion);
    const [x, v] = [0, 1].map((k) => states.map((state) => state[k]));
    return { ...trajectory, t, coordinates: { x }, rates: { x: v }, positions: { p: x.map((s) => [s, 0]) }, loads: {}, energy: undefined, cost: { steps: 1 }, error: {}, ...more };
  }
  return { asked, simulate };
}

/** The largest error of what is drawn, in pixels of a projector, as parts of the ranges. @param {any} motion @param {(t: number) => [number, number]} truth */
function pixelsOff(motion, truth) {
  const times = Array.from({ length: 5003 }, (_, i) => (END * i) / 5002);
  const [x, v] = [motion.coordinates.x, motion.rates.x].map((values) => Math.max(...values) - Math.min(...values));
  return 800 * Math.max(...times.map((t) => {
    const { coordinates, rates } = snapshotAt(motion, t);
    const [q, u] = truth(t);
    return Math.max(Math.abs(coordinates.x - q) / x, Math.abs(rates.x - u) / v);
  }));
}

/** @type {(frequency: number, phase?: number, size?: number) => (t: number) => [number, number]} */
const swing = (frequency, phase = 0, size = 1) => {
  const omega = 2 * Math.PI * frequency;
  return (t) => [size * Math.cos(omega * t + phase), -size * omega * Math.sin(omega * t + phase)];
};

for (const frequency of [0.3, 2, 12.5, 24.9, 25, 25.2, 50, 75.3, 125]) {
  test(`a swing of ${frequency} Hz is drawn to half a pixel, at whatever multiple of the samples it lies`, async () => {
    for (const phase of [0, Math.PI / 2, 1]) {
      const truth = swing(frequency, phase);
      const found = await sampled(serverOf(truth).simulate)({ t_end: END, samples: samplesFor(251) });
      assert.equal(found.coarse, false);
      assert.ok(pixelsOff(found, truth) < 0.5, `${phase} ${pixelsOff(found, truth)}`);
    }
  });
}

for (const frequency of [25, 50, 60]) {
  test(`a ripple of ${frequency} Hz on a slow swing is not met at the same phase in every sample`, async () => {
    const truth = (/** @type {number} */ t) => {
      const [slow, fast] = [swing(0.4)(t), swing(frequency, 0, 3e-3)(t)];
      return /** @type {[number, number]} */ ([slow[0] + fast[0], slow[1] + fast[1]]);
    };
    const found = await sampled(serverOf(truth).simulate)({ t_end: END, samples: samplesFor(251) });
    assert.ok(pixelsOff(found, truth) < 0.5, `${pixelsOff(found, truth)}`);
  });
}

test("a slow motion is asked for once; many steps to a sample are looked into", async () => {
  const slow = serverOf(swing(0.3));
  await sampled(slow.simulate)({ t_end: END, samples: 252 });
  assert.deepEqual(slow.asked, [252]);
  const busy = serverOf(swing(0.3), { cost: { steps: 1500 } });
  await sampled(busy.simulate)({ t_end: END, samples: 252 });
  assert.equal(busy.asked.length, 2);
  const stepped = serverOf(swing(0.3), { cost: { steps: 1500 } });
  await sampled(stepped.simulate)({ t_end: END, samples: 252, step: 0.01 });
  assert.deepEqual(stepped.asked, [252]);
});

test("what no number of samples shows is said to be too coarse, after a bounded number of requests", async () => {
  const wild = serverOf(swing(7001.7));
  const found = await sampled(wild.simulate)({ t_end: END, samples: 252 });
  assert.equal(found.coarse, true);
  assert.ok(wild.asked.length <= 7 && Math.max(...wild.asked) <= 20001, String(wild.asked));
});

test("a motion that jumps is asked for a bounded number of times", async () => {
  const jump = serverOf((t) => (t < 5.001 ? [t, 1] : [t + 1, 1]));
  const found = await sampled(jump.simulate)({ t_end: END, samples: 252 });
  assert.ok(found.coarse && jump.asked.length <= 7);
});

test("an answer is judged by what it has: noise of a constant, and its rounding, are no motion", () => {
  const t = Array.from({ length: 252 }, (_, i) => (END * i) / 251);
  const noise = t.map((_, i) => 1e-11 * Math.sin(1e3 * i * i));
  const still = { ...trajectory, t, coordinates: { x: t.map((_, i) => 0.6 + noise[i]) }, rates: { x: t.map(() => 0) }, positions: {}, loads: {}, energy: undefined, error: { estimate: t.map(() => 1e-8) } };
  assert.equal(judged(still, { t_end: END, samples: 252 }, 1).again, null);
});

for (const error of [1e-4, 8e-8, 1e-11]) {
  test(`a uniform rotation is asked for once, whatever its error of ${error} lets be rounded`, () => {
    const unit = 2 ** (Math.ceil(Math.log2(error)) - 8), t = Array.from({ length: 252 }, (_, i) => (END * i) / 251);
    const rounded = (/** @type {number[]} */ values) => values.map((value) => Math.round(value / unit) * unit);
    const energy = { kinetic: t.map((_, i) => 1.125 + 1e-5 * error * (i % 3)), potential: t.map(() => 0), balance: t.map((_, i) => 1.125 + 1e-5 * error * (i % 3)), works: false };
    const turns = { ...trajectory, t, coordinates: { phi: rounded(t.map((s) => 1.5 * s)) }, rates: { phi: rounded(t.map((_, i) => 1.5 + ((i * 0.6180339887) % 1 - 0.5) * unit)) }, positions: {}, loads: {}, energy, error: { estimate: t.map(() => error) } };
    const found = judged(/** @type {any} */ (turns), { t_end: END, samples: 252 }, 1);
    assert.deepEqual([found.trajectory.coarse, found.again], [false, null]);
  });
}

test("a motion that ended at once is asked for more finely", () => {
  const short = { ...trajectory, status: "event", t: [0, 0.04, 0.05], coordinates: { x: [0, 1, 2] }, rates: { x: [0, 0, 0] }, positions: {}, loads: {}, energy: undefined };
  assert.ok((judged(short, { t_end: END, samples: 252 }, 1).again?.samples ?? 0) > 1000);
});

test("intervals are a prime number, and never more than the server has", () => {
  assert.deepEqual([3, 250, 252, 253, 1e9].map(samplesFor), [3, 252, 252, 258, 19998]);
  for (const n of [10, 500, 4001, 19998, 1e6]) assert.ok(samplesFor(n) <= 20001);
});

test("corners of a polyline leave the curve by a tenth of a pixel, wherever it bends", () => {
  const place = (/** @type {number} */ t) => /** @type {[number, number]} */ ([100 * t, 300 * Math.sin(7 * t)]);
  const { t, points } = traced(place, [0, 0.5, 1, 2, 4]);
  assert.deepEqual([t[0], t.at(-1)], [0, 4]);
  for (let n = 1; n < t.length; n += 1) {
    const [[ax, ay], [bx, by]] = [points[n - 1], points[n]];
    for (const s of [0.2, 0.4, 0.6, 0.8]) {
      const [x, y] = place(t[n - 1] + s * (t[n] - t[n - 1]));
      assert.ok(Math.abs((x - ax) * (by - ay) - (y - ay) * (bx - ax)) / Math.hypot(bx - ax, by - ay) < 0.2);
    }
  }
});

test("a line at rest has two corners at most, and what has no place none", () => {
  assert.equal(traced(() => [3, 4], [0, 1, 2, 3]).points.length, 2);
  assert.deepEqual(traced((t) => [t, NaN], [0, 1, 2]).points, []);
});

test("knots are both times and the samples between them", () => {
  assert.deepEqual(knotsBetween([0, 1, 2, 3], 0.5, 2), [0.5, 1, 2]);
  assert.deepEqual(knotsBetween([0, 1, 2, 3], 1.2, 1.4), [1.2, 1.4]);
  assert.deepEqual(knotsBetween([0, 1], 0.5, 7), [0.5, 1, 7]);
});
