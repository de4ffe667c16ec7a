import { strict as assert } from "node:assert";
import { test } from "node:test";
import { changed, dotted, isChanged, rangeText, slidersOf, readChanges, UNCHANGED, writeChanges } from "../../frontend/model/values.js";
import { scene } from "./fixtures.js";

const sliderOf = (/** @type {string} */ key) => /** @type {import("../../frontend/model/values.js").Slider} */ (slidersOf(scene, UNCHANGED).find((s) => s.key === key));

test("value and rate of every coordinate, and every parameter", () => {
  assert.deepEqual(slidersOf(scene, UNCHANGED).map((s) => s.key), [
    "initial-y-value", "initial-y-rate", "initial-phi-value", "initial-phi-rate", "parameter-m-value", "parameter-g-value",
  ]);
});

test("a guided coordinate has no initial value", () => {
  const guided = { ...scene, guides: [{ coordinate: "y", value: "sin(t)" }] };
  assert.deepEqual(slidersOf(guided, UNCHANGED).filter((s) => s.group === "initial").map((s) => s.name), ["phi", "phi"]);
});

test("ranges come from the scene, else from the value; an angle has a full turn", () => {
  assert.deepEqual([sliderOf("parameter-m-value").min, sliderOf("parameter-m-value").max], [0.1, 5]);
  assert.deepEqual([sliderOf("parameter-g-value").min, sliderOf("parameter-g-value").max], [0, 4 * 9.81]);
  assert.deepEqual([sliderOf("initial-phi-value").min, sliderOf("initial-phi-value").max], [-Math.PI, Math.PI]);
});

test("the rate of what has no unit has one", () => {
  const [angle, bare] = ["rad", ""].map((unit) => ({ ...scene.coordinates[1], unit }));
  const units = (/** @type {typeof angle} */ coordinate) => slidersOf({ ...scene, coordinates: [coordinate], parameters: [] }, UNCHANGED).map(({ unit }) => unit);
  assert.deepEqual([units(angle), units(bare)], [["rad", "rad/s"], ["", "1/s"]]);
});

test("a slider carries the colour of its coordinate", () => {
  assert.equal(sliderOf("initial-phi-rate").className, "q-1");
  assert.equal(sliderOf("parameter-m-value").className, "");
});

test("one change keeps the others", () => {
  const first = changed(scene, UNCHANGED, sliderOf("initial-phi-value"), 0.5);
  const second = changed(scene, first, sliderOf("initial-phi-rate"), 2);
  const third = changed(scene, second, sliderOf("parameter-m-value"), 3);
  assert.deepEqual(third, { initial: { phi: { value: 0.5, rate: 2 } }, parameters: { m: 3 } });
  assert.equal(isChanged(third), true);
  assert.equal(isChanged(UNCHANGED), false);
});

test("what is typed may leave the range that nobody set: a scene of one's own has sliders from its values", () => {
  assert.equal(changed(scene, UNCHANGED, sliderOf("parameter-g-value"), 99).parameters.g, 99);
  assert.equal(changed(scene, UNCHANGED, sliderOf("parameter-g-value"), -1).parameters.g, 0);
  assert.deepEqual(changed(scene, UNCHANGED, sliderOf("initial-phi-value"), 7).initial.phi, { value: 7, rate: 0 });
  assert.equal(changed(scene, UNCHANGED, sliderOf("initial-phi-rate"), -500).initial.phi.rate, -500);
});

test("what is typed outside of the scene's bounds is held there; what is no number changes nothing", () => {
  assert.equal(changed(scene, UNCHANGED, sliderOf("parameter-m-value"), 99).parameters.m, 5);
  assert.equal(changed(scene, UNCHANGED, sliderOf("parameter-m-value"), NaN), UNCHANGED);
});

for (const [bounds, lang, text] of /** @type {const} */ ([[[0.2, 2], "de", "0,2 … 2"], [[0.2, Infinity], "en", "≥ 0.2"], [[-Infinity, 1500], "de", "≤ 1.500"]]))
  test(`the range is told as ${text}`, () => assert.equal(rangeText({ ...sliderOf("parameter-m-value"), least: bounds[0], most: bounds[1] }, lang), text));

const DOTS = [["q_1", "\\dot{q}_1"], ["\\varphi", "\\dot{\\varphi}"], ["x", "\\dot{x}"], ["q_{12}", "\\dot{q}_{12}"], ["x'", "\\dot{x'}"]];
for (const [latex, expected] of DOTS) {
  test(`the rate of ${latex}`, () => assert.equal(dotted(latex), expected));
}

test("changes have an address, and what is not one is passed over", () => {
  const text = "l:0.5,phi:0.6:-1.25";
  assert.deepEqual(readChanges(text), { parameters: { l: 0.5 }, initial: { phi: { value: 0.6, rate: -1.25 } } });
  assert.equal(writeChanges(readChanges(text)), text);
  assert.deepEqual(readChanges("l,:3,m:x,k:,a:1:2:3"), UNCHANGED);
  assert.equal(writeChanges(UNCHANGED), "");
});
