import { strict as assert } from "node:assert";
import { test } from "node:test";
import { KEYS, labelOf } from "../../frontend/model/keys.js";
import { table } from "../../frontend/view/keys.js";

const told = KEYS.flatMap(([names]) => names);

test("every key of the page is told once", () => {
  const meant = Object.keys(table(/** @type {any} */ ({})));
  assert.deepEqual(meant.filter((key) => !told.includes(key)), []);
  assert.equal(new Set(told).size, told.length);
});

test("keys are called by what stands on them", () => {
  const t = (/** @type {string} */ key) => `<${key}>`;
  assert.deepEqual(told.filter((key) => key.length > 1 || key === " ").map((key) => labelOf(key, t)), [
    "→", "<key.space>", "<key.page-down>", "←", "<key.page-up>", "<key.home>", "<key.end>", "<key.escape>", "↓", "↑", "<key.enter>",
  ]);
  assert.deepEqual(["w", ".", "?"].map((key) => labelOf(key, t)), ["W", ".", "?"]);
});
