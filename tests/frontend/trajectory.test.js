import { strict as assert } from "node:assert";
import { test } from "node:test";
import { traced } from "../../frontend/model/curve.js";
import { blendAt, scalarAt, smooth } from "../../frontend/model/interpolation.js";
import { judged } from "../../frontend/model/sampling.js";
import { caveatsOf, coordinateAt, endOf, largestError, leastRange, snapshotAt, trustedUntil } from "../../frontend/model/trajectory.js";
import { trajectory } from "./fixtures.js";

/** A sine with its rate, sampled. @param {number} h @param {number[]} [more] times after the last */
function sine(h, more = []) {
  const t = [...Array.from({ length: Math.round(4 / h) + 1 }, (_, i) => i * h), ...more];
  return { ...trajectory, t, coordinates: { x: t.map(Math.sin) }, rates: { x: t.map(Math.cos) }, positions: { p: t.map((s) => [Math.sin(s), 1]) }, loads: {}, energy: undefined };
}

/** Times from the very start to the very end. */
const WITHIN = Array.from({ length: 801 }, (_, i) => i / 200);
const worst = (/** @type {(t: number) => number} */ off) => Math.max(...WITHIN.map((t) => Math.abs(off(t))));

test("samples are met exactly", () => {
  const motion = sine(0.5);
  for (const t of motion.t) {
    const { coordinates, rates, positions } = snapshotAt(motion, t);
    assert.deepEqual([coordinates.x, rates.x, positions.p[0]].map((x) => x.toFixed(12)), [Math.sin(t), Math.cos(t), Math.sin(t)].map((x) => x.toFixed(12)));
  }
});

/** @type {[string, (motion: ReturnType<typeof sine>, t: number) => number][]} */
const KINDS = [
  ["a coordinate", (motion, t) => snapshotAt(motion, t).coordinates.x - Math.sin(t)],
  ["a rate", (motion, t) => snapshotAt(motion, t).rates.x - Math.cos(t)],
  ["a place", (motion, t) => snapshotAt(motion, t).positions.p[0] - Math.sin(t)],
];
for (const [kind, off] of KINDS) {
  test(`between samples, and in the first and last interval too, the error of ${kind} is of fourth order`, () => {
    const [coarse, fine] = [0.2, 0.1].map((h) => {
      const motion = sine(h);
      return worst((t) => off(motion, t));
    });
    assert.ok(Math.log2(coarse / fine) > 3.8, `${coarse} ${fine}`);
    assert.ok(coarse < 2e-5);
  });
}

test("a coordinate has the rate that was computed, not the slope of its neighbours", () => {
  const motion = { ...trajectory, t: [0, 1], coordinates: { x: [0, 0] }, rates: { x: [4, -4] }, positions: {}, loads: {}, energy: undefined };
  assert.equal(coordinateAt(motion, "x", 0.5), 1);
});

test("for many moments and for one, it is the same curve", () => {
  const motion = sine(0.37, [4.0701]);
  const curve = smooth(motion.t, motion.coordinates.x);
  for (const t of WITHIN) assert.ok(Math.abs(curve(t) - scalarAt(motion.coordinates.x, blendAt(motion.t, t))) < 1e-12);
});

test("an event close behind the last sample does not bend what is before it", () => {
  const rounded = (/** @type {number} */ x) => Number(x.toFixed(6));
  const event = 4 + 1e-7;
  const { t, positions } = sine(0.1, [event]);
  const curve = smooth(t, positions.p.map(([x]) => rounded(x)));
  assert.ok(worst((s) => curve(s) - Math.sin(s)) < 2e-5);
});

/** A ball thrown up with 3, which the ground gives back 0.6 of its speed, at impacts twice: t, height, speed. @param {number} h */
function bounces(h) {
  const impacts = [0.6, 0.96, 1.176].map((time, n) => ({ time, speed: 3 * 0.6 ** n }));
  const at = (/** @type {number} */ t, after = true) => {
    const last = impacts.filter(({ time }) => (after ? time <= t : time < t)).at(-1);
    const [from, speed] = last ? [last.time, 0.6 * last.speed] : [0, 3];
    return [t, (t - from) * (speed - 5 * (t - from)), speed - 10 * (t - from)];
  };
  const even = Array.from({ length: Math.round(1.3 / h) + 1 }, (_, i) => at(i * h)).filter(([t]) => !impacts.some(({ time }) => time === t));
  const rows = [...even, ...impacts.flatMap(({ time }) => [at(time, false), at(time)])].sort((a, b) => a[0] - b[0]);
  const [t, z, v] = [0, 1, 2].map((k) => rows.map((row) => row[k]));
  return { motion: { ...trajectory, t, coordinates: { z }, rates: { z: v }, positions: { ball: z.map((s) => [0, s]) }, loads: {}, energy: undefined }, at };
}

test("no curve runs across an impact: what is parabolic on both sides is drawn as it is", () => {
  const { motion, at } = bounces(0.11);
  for (let t = 0; t < 1.3; t += 0.0037) {
    const { coordinates, rates, positions } = snapshotAt(motion, t);
    const [, z, v] = at(t);
    for (const [drawn, true_] of [[coordinates.z, z], [rates.z, v], [positions.ball[1], z]]) assert.ok(Math.abs(drawn - true_) < 1e-12, `${t} ${drawn} ${true_}`);
  }
  const rate = smooth(motion.t, motion.rates.z);
  const { t, points } = traced((s) => [100 * s, 100 * rate(s)], motion.t);
  const corners = [0.6, 0.96, 1.176].map((time) => points.filter((_, n) => Math.abs(t[n] - time) < 1e-9).map(([, y]) => Math.round(y)));
  assert.deepEqual(corners, [[-300, 180], [-180, 108], [-108, 65]]);
});

test("samples are enough for a motion that jumps if they are enough between its jumps", () => {
  const asked = { t_end: 1.3, samples: 40 };
  assert.equal(judged(bounces(1.3 / 39).motion, asked, 1).again, null);
});

test("before the start and after the end the ends are held", () => {
  assert.equal(snapshotAt(trajectory, -1).coordinates.phi, 0);
  assert.equal(snapshotAt(trajectory, 99).coordinates.phi, 1);
});

for (const count of [1, 2, 3, 4]) {
  test(`a motion may have ${count} samples`, () => {
    const t = [0, 1, 2, 3].slice(0, count);
    const line = { ...trajectory, t, coordinates: { x: t.map((s) => 7 + 2 * s) }, rates: { x: t.map(() => 2) }, positions: { p: t.map((s) => [s, 1]) }, loads: {}, energy: undefined };
    const { coordinates, positions } = snapshotAt(line, Math.min(0.3, count - 1));
    assert.ok(Math.abs(coordinates.x - (count > 1 ? 7.6 : 7)) < 1e-12);
    assert.ok(Math.abs(positions.p[0] - (count > 1 ? 0.3 : 0)) < 1e-12);
  });
}

test("energies come along, and may be absent", () => {
  assert.ok(Math.abs((snapshotAt(trajectory, 2).energy?.kinetic ?? 0) - 2) < 1e-12);
  assert.equal(snapshotAt({ ...trajectory, energy: undefined }, 2).energy, null);
});

test("end, what is trusted, and largest error", () => {
  assert.equal(endOf(trajectory), 4);
  assert.equal(endOf(null), 0);
  assert.equal(trustedUntil(trajectory), 4);
  assert.equal(trustedUntil({ ...trajectory, trusted_until: 2.5 }), 2.5);
  assert.equal(largestError(trajectory), 4e-9);
  assert.equal(largestError({ ...trajectory, error: { estimate: [null, 2] } }), 2);
  assert.equal(largestError({ ...trajectory, error: {} }), null);
});

test("what moves less than its error is not shown as a motion; what moves more is never flattened", () => {
  assert.equal(leastRange({ ...trajectory, error: { estimate: [1e-7] } }), 1e-6);
  assert.equal(leastRange({ ...trajectory, error: { estimate: [3] } }), 1e-3);
});

const t = (/** @type {string} */ key, /** @type {any} */ given = {}) => [key, ...Object.values(given)].join(" ");

test("a status that there is no word for yet is told with its reason and remedy", () => {
  assert.deepEqual(caveatsOf(trajectory, t), []);
  const unheard = { ...trajectory, status: "unheard-of", reason: "So it is.", remedy: "Do this." };
  assert.deepEqual(caveatsOf(unheard, t), ["So it is.", "Do this."]);
  assert.deepEqual(caveatsOf({ ...unheard, reason: null, remedy: null }, t), ["status.incomplete"]);
  assert.deepEqual(caveatsOf({ ...unheard, coarse: true }, t), ["So it is.", "Do this.", "status.coarse 5"]);
  assert.deepEqual(caveatsOf({ ...trajectory, coarse: true }, t), ["status.coarse 5"]);
});
