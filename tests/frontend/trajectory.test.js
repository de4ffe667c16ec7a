import { strict as assert } from "node:assert";
import { test } from "node:test";
import { blendAt, scalarAt, smooth } from "../../frontend/model/interpolation.js";
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
