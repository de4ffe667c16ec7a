import { strict as assert } from "node:assert";
import { test } from "node:test";
import { courseOf, keepsEnergy } from "../../frontend/model/summary.js";
import { translator } from "../../frontend/model/catalog.js";
import { summary } from "../../frontend/view/summary.js";
import { scene, trajectory } from "./fixtures.js";

const times = Array.from({ length: 401 }, (_, i) => i / 40);
const near = (/** @type {number} */ a, /** @type {number} */ b) => assert.ok(Math.abs(a - b) < 0.02, `${a} is not ${b}`);

test("a swing has bounds and a period", () => {
  const course = courseOf(times, (t) => 0.3 + 0.5 * Math.cos((2 * Math.PI * t) / 2.5));
  assert.equal(course.kind, "swings");
  if (course.kind !== "swings") return;
  near(course.low, -0.2);
  near(course.high, 0.8);
  near(course.period, 2.5);
});

test("bounds between the samples are met, too", () => {
  const few = times.filter((_, i) => i % 32 === 0);
  const course = courseOf(few, (t) => Math.sin((2 * Math.PI * t) / 2.5));
  near(course.kind === "swings" ? course.high : NaN, 1);
});

test("what grows goes, what does not move rests", () => {
  assert.deepEqual(courseOf(times, (t) => 2 * t), { kind: "goes", from: 0, to: 20 });
  assert.deepEqual(courseOf(times, () => 0.25), { kind: "rests", from: 0.25 });
  assert.deepEqual(courseOf(times, (t) => 1 + 1e-9 * t), { kind: "rests", from: 1 });
});

test("the energy of both kinds together is kept or not, or unknown", () => {
  assert.equal(keepsEnergy(/** @type {any} */ (trajectory)), true);
  assert.equal(keepsEnergy(/** @type {any} */ ({ energy: { kinetic: [0, 1, 2], potential: [0, 0, 0] } })), false);
  assert.equal(keepsEnergy(/** @type {any} */ ({})), null);
});

test("the motion in a sentence", () => {
  const t = translator({
    motion: "Over {time} s: {told}.", "motion.goes": "{name} from {from} to {to} {unit}", "motion.rests": "{name} at {from} {unit}",
    "motion.energy-kept": "energy kept",
  });
  assert.equal(summary(/** @type {any} */ (scene), /** @type {any} */ (trajectory), t, "de"), "Over 4,00 s: y at 0,00 m; phi from 0,00 to 1,00 rad; energy kept.");
});
