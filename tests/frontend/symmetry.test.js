import assert from "node:assert/strict";
import { test } from "node:test";
import { shiftedBy, variationBy } from "../../frontend/model/virtual/symmetry.js";

const integral = (step, shifts, time = "0") => ({
  step,
  generator: {
    shifts: Object.fromEntries(Object.entries(shifts).map(([q, plain]) => [q, { plain, latex: "" }])),
    time: { plain: time, latex: "" },
  },
});
const rotation = integral("noether:1", { x: "-y", y: "x" });
const free = ["x", "y", "z"].map((name) => ({ name, unit: "m", min: -2, max: 2, value: 0 }));

test("only what moves coordinates and leaves the time is shown", () => {
  const result = { conserved: [integral("jacobi-energy", {}, "1"), integral("noether:2", { x: "t" }, "1"), rotation] };
  assert.equal(shiftedBy(result, "noether:1"), rotation);
  assert.equal(shiftedBy(result, "noether:2"), undefined);
  assert.equal(shiftedBy(result, "jacobi-energy"), undefined);
  assert.equal(shiftedBy(undefined, "noether:1"), undefined);
});

test("a rotation varies the coordinates at a right angle to where they are, whatever the size", () => {
  for (const [x, y] of [
    [1, 0],
    [0.3, -1.1],
    [1e-3, 2e-3],
  ]) {
    const { delta, dt } = variationBy(rotation, free, { x, y, z: 5, t: 0 });
    assert.equal(dt, 0);
    assert.ok(Math.abs(delta.x * x + delta.y * y) < 1e-12);
    assert.ok(delta.x * y <= 0 && delta.y * x >= 0);
    assert.equal(Math.max(Math.abs(delta.x), Math.abs(delta.y)).toFixed(6), "0.600000");
    assert.equal(delta.z, 0);
  }
});

test("where nothing is shifted nothing is varied", () => {
  const { delta } = variationBy(rotation, free, { x: 0, y: 0, z: 1, t: 0 });
  assert.deepEqual(Object.values(delta).map(Math.abs), [0, 0, 0]);
});
