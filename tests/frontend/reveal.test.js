import { strict as assert } from "node:assert";
import { test } from "node:test";
import { indexOf, linesOf, moved } from "../../frontend/model/reveal.js";

const step = (/** @type {string} */ id) => ({ id, rule: "", title: id, text: "", latex: "", marked: "", verified: true, sources: [], substeps: [] });
const chapters = [
  { id: "configuration", title: "", steps: [step("position:bob")] },
  { id: "variation", title: "", steps: [step("chain-rule"), step("virtual-displacement:bob")] },
];
const lines = linesOf(chapters);

test("steps are numbered by chapter", () => {
  assert.deepEqual(lines.map((line) => [line.number, line.index]), [["1.1", 0], ["2.1", 1], ["2.2", 2]]);
});

const MOVES = [
  ["on", "position:bob", 1, "chain-rule"],
  ["back", "chain-rule", -1, "position:bob"],
  ["held at the start", "position:bob", -1, "position:bob"],
  ["held at the end", "virtual-displacement:bob", 1, "virtual-displacement:bob"],
  ["to the end", "position:bob", Infinity, "virtual-displacement:bob"],
  ["to the start", "virtual-displacement:bob", -Infinity, "position:bob"],
  ["from an unknown step to the first", "no-such-step", 0, "position:bob"],
];

for (const [name, from, by, to] of MOVES) {
  test(`moving ${name}`, () => assert.equal(moved(lines, from, by), to));
}

test("an empty derivation moves nowhere", () => assert.equal(moved([], "x", 1), "x"));
test("where a step stands", () => assert.equal(indexOf(lines, "virtual-displacement:bob"), 2));
