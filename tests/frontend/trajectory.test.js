import { strict as assert } from "node:assert";
import { test } from "node:test";
import { blendAt, endOf, largestError, samplesNeeded, scalarAt, snapshotAt, trailOf } from "../../frontend/model/trajectory.js";
import { trajectory } from "./fixtures.js";

test("samples are met exactly", () => {
  for (const t of trajectory.t) {
    assert.deepEqual(snapshotAt(trajectory, t).positions.bob.map((x) => x.toFixed(12)), trajectory.positions.bob[t].map((x) => x.toFixed(12)));
  }
});

test("between samples the error falls with the third power of their distance or faster", () => {
  const error = (/** @type {number} */ h) => {
    const times = Array.from({ length: Math.round(4 / h) + 1 }, (_, i) => i * h);
    const values = times.map(Math.sin);
    const within = Array.from({ length: 400 }, (_, i) => 0.5 + (3 * i) / 400);
    return Math.max(...within.map((t) => Math.abs(scalarAt(values, blendAt(times, t)) - Math.sin(t))));
  };
  assert.ok(Math.log2(error(0.1) / error(0.05)) > 2.8);
});

test("before the start and after the end the ends are held", () => {
  assert.equal(snapshotAt(trajectory, -1).coordinates.phi, 0);
  assert.equal(snapshotAt(trajectory, 99).coordinates.phi, 1);
});

test("a single sample is a motion too", () => {
  assert.equal(scalarAt([7], blendAt([0], 0.3)), 7);
});

test("energies come along, and may be absent", () => {
  assert.equal(snapshotAt(trajectory, 2).energy?.kinetic, 2);
  assert.equal(snapshotAt({ ...trajectory, energy: undefined }, 2).energy, null);
});

test("a trail begins and ends at its times", () => {
  const trail = trailOf(trajectory, "bob", 0, 1, 4);
  assert.equal(trail.length, 5);
  assert.deepEqual(trail[0], [0, 1]);
  assert.ok(Math.abs(trail[4][0] - Math.sin(0.25)) < 1e-12);
  assert.deepEqual(trailOf(trajectory, "bob", 1, 1, 4), []);
  assert.deepEqual(trailOf(trajectory, "nobody", 2, 5, 4), []);
});

test("end and largest error", () => {
  assert.equal(endOf(trajectory), 4);
  assert.equal(endOf(null), 0);
  assert.equal(largestError(trajectory), 4e-9);
  assert.equal(largestError({ ...trajectory, error: { estimate: [null, 2] } }), 2);
  assert.equal(largestError({ ...trajectory, error: {} }), null);
});

const DENSITIES = [
  ["enough for a slow motion", 301, 148, 301],
  ["a little too few is enough", 301, 180, 301],
  ["too few for fast swings", 301, 475, 951],
  ["not without end", 301, 1e6, 4001],
];

for (const [name, samples, steps, needed] of DENSITIES) {
  test(`samples: ${name}`, () => {
    const t = Array.from({ length: samples }, (_, i) => i);
    assert.equal(samplesNeeded({ ...trajectory, t, cost: { steps } }), needed);
  });
}
