import { strict as assert } from "node:assert";
import { test } from "node:test";
import { led, termsOf } from "../../frontend/model/spoken.js";

const spoken = "E equals m over two, plus V. L equals E";

test("what is said is cut into its terms, without the pauses between them", () => {
  assert.deepEqual(termsOf({ spoken, spoken_terms: [0, 2, 21, 29, 31] }), [
    "E", "equals m over two", "plus V", "L", "equals E",
  ]);
  assert.deepEqual(termsOf({}), []);
});

test("arrows lead through the terms and stop at both ends; Escape leads out, other keys nowhere", () => {
  assert.deepEqual(["ArrowRight", "ArrowLeft", "Home", "End", "Enter"].map((key) => led(key, 1, 3)), [2, 0, 0, 2, 1]);
  assert.deepEqual([led("ArrowRight", 2, 3), led("ArrowLeft", 0, 3)], [2, 0]);
  assert.equal(led("Escape", 1, 3), null);
  assert.equal(led("n", 1, 3), undefined);
});
