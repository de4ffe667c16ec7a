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

const bare = { name: "u", latex: "", unit: "m", value: 0, rate: 0, min: null, max: null };
const known = { name: "k", latex: "", unit: "N/m", value: 1, min: null, max: null };
for (const [about, of, expected] of /** @type {[string, any, any[]][]} */ ([
  ["a coordinate within its bounds", { coordinates: [scene.coordinates[0]] }, [["q_1(0)", -0.5, 0.5, 0.01, 2], ["\\dot{q}_1(0)", -2.5, 2.5, 0.05, 2]]],
  ["an angle, which goes round once", { coordinates: [scene.coordinates[1]] }, [["q_2(0)", -Math.PI, Math.PI, 0.05, 2], ["\\dot{q}_2(0)", -12.5, 12.5, 0.2, 1]]],
  ["an angle of more than one turn", { coordinates: [{ ...scene.coordinates[1], value: 7 }] }, [["q_2(0)", -Math.PI, 7, 0.1, 1], ["\\dot{q}_2(0)", -25, 25, 0.5, 1]]],
  ["a length that starts at nothing, without a letter of its own", { coordinates: [bare] }, [["u(0)", -1, 1, 0.02, 2], ["\\dot{u}(0)", -5, 5, 0.1, 1]]],
  ["a length that starts far out", { coordinates: [{ ...bare, value: -30 }] }, [["u(0)", -60, 60, 1, 0], ["\\dot{u}(0)", -250, 250, 5, 0]]],
  ["a length between bounds that are far off", { coordinates: [{ ...bare, value: 12, min: 10, max: 12 }] }, [["u(0)", 10, 12, 0.02, 2], ["\\dot{u}(0)", -5, 5, 0.1, 1]]],
  ["a length that may have one value", { coordinates: [{ ...bare, value: 3, min: 3, max: 3 }] }, [["u(0)", 3, 3, 1, 0], ["\\dot{u}(0)", -2.5, 2.5, 0.05, 2]]],
  ["a parameter without a letter of its own", { parameters: [known] }, [["k", 0, 4, 0.02, 2]]],
  ["a parameter with one", { parameters: [{ ...known, latex: "\\kappa", value: 0.1 }] }, [["\\kappa", 0, 1, 0.01, 2]]],
  ["a negative parameter", { parameters: [{ ...known, value: -2 }] }, [["k", -8, 1, 0.05, 2]]],
])) {
  test(`sliders of ${about}: letter, from, to, step, decimals`, () => {
    const sliders = slidersOf({ ...scene, coordinates: [], parameters: [], ...of }, UNCHANGED);
    const rounded = (/** @type {number} */ step) => Number(step.toPrecision(12));
    assert.deepEqual(sliders.map((s) => [s.latex, s.min, s.max, rounded(s.step), s.decimals]), expected);
  });
}

test("sliders stand where the values have been moved to", () => {
  const moved = slidersOf(scene, { initial: { phi: { value: 0.5, rate: 2 } }, parameters: { m: 3 } });
  assert.deepEqual(moved.map((s) => s.value), [0.1, 0, 0.5, 2, 3, 9.81]);
});

test("a scene that guides nothing need not say so", () => {
  const { guides: _, ...silent } = scene;
  assert.deepEqual(slidersOf(/** @type {any} */ (silent), UNCHANGED), slidersOf(scene, UNCHANGED));
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

test("of what has not been changed yet, value and rate are those of the scene", () => {
  const turning = { ...scene, coordinates: [scene.coordinates[0], { ...scene.coordinates[1], rate: 0.3 }] };
  assert.deepEqual(changed(turning, UNCHANGED, sliderOf("initial-phi-value"), 0.5).initial, { phi: { value: 0.5, rate: 0.3 } });
  assert.deepEqual(changed(turning, UNCHANGED, sliderOf("initial-phi-rate"), 2).initial, { phi: { value: 1, rate: 2 } });
});

test("what is typed may leave the range that nobody set: a scene of one's own has sliders from its values", () => {
  assert.equal(changed(scene, UNCHANGED, sliderOf("parameter-g-value"), 99).parameters.g, 99);
  assert.equal(changed(scene, UNCHANGED, sliderOf("parameter-g-value"), -1).parameters.g, 0);
  assert.deepEqual(changed(scene, UNCHANGED, sliderOf("initial-phi-value"), 7).initial.phi, { value: 7, rate: 0 });
  assert.equal(changed(scene, UNCHANGED, sliderOf("initial-phi-rate"), -500).initial.phi.rate, -500);
});

test("what is typed outside of the scene's bounds is held there; what is no number changes nothing", () => {
  assert.equal(changed(scene, UNCHANGED, sliderOf("parameter-m-value"), 99).parameters.m, 5);
  assert.equal(changed(scene, UNCHANGED, sliderOf("initial-y-value"), -99).initial.y.value, -0.5);
  assert.equal(changed(scene, UNCHANGED, sliderOf("initial-y-rate"), -99).initial.y.rate, -99);
  assert.equal(changed(scene, UNCHANGED, sliderOf("parameter-m-value"), NaN), UNCHANGED);
});

for (const [bounds, lang, text] of /** @type {const} */ ([[[0.2, 2], "de", "0,2 … 2"], [[0.2, Infinity], "en", "≥ 0.2"], [[-Infinity, 1500], "de", "≤ 1500"], [[1 / 7, 2 / 3], "en", "0.142857 … 0.666667"]]))
  test(`the range is told as ${text}`, () => assert.equal(rangeText({ ...sliderOf("parameter-m-value"), least: bounds[0], most: bounds[1] }, lang), text));

const DOTS = [["q_1", "\\dot{q}_1"], ["\\varphi", "\\dot{\\varphi}"], ["x", "\\dot{x}"], ["q_{12}", "\\dot{q}_{12}"], ["x'", "\\dot{x'}"], ["\\hat{q}_1", "\\dot{\\hat{q}_1}"], ["AB_2", "\\dot{AB}_2"], ["q^2_1", "\\dot{q^2_1}"]];
for (const [latex, expected] of DOTS) {
  test(`the rate of ${latex}`, () => assert.equal(dotted(latex), expected));
}

test("changes have an address, and what is not one is passed over", () => {
  const text = "l:0.5,phi:0.6:-1.25";
  assert.deepEqual(readChanges(text), { parameters: { l: 0.5 }, initial: { phi: { value: 0.6, rate: -1.25 } } });
  assert.equal(writeChanges(readChanges(text)), text);
  assert.deepEqual(readChanges("l,:3,m:x,k:,a:1:2:3,phi:1:x,psi:y:1,chi:1:"), UNCHANGED);
  assert.equal(writeChanges(UNCHANGED), "");
});
