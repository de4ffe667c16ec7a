import { strict as assert } from "node:assert";
import { test } from "node:test";
import { readingOf, rowsOf } from "../../frontend/model/curves.js";
import { between, folded, readLook, spanOf, toggled, wrap, writeLook, zoomed } from "../../frontend/model/look.js";
import { layoutOf, timeScale, tracesOf } from "../../frontend/model/plots.js";
import { scene, trajectory } from "./fixtures.js";

const palette = { ink: "black", muted: "gray", grid: "silver", paper: "white", of: (/** @type {string} */ name) => name };
const ALL = readLook("");

for (const text of ["", "wrapped", "one", "each,-phi", "-phi,-kinetic", "wrapped,each,-y,0.5:2.25"])
  test(`a look has an address: "${text}"`, () => assert.equal(writeLook(readLook(text)), text));

for (const text of ["4:2", "2:2", "a:b", "unknown", "-", "1:2:3", ":"])
  test(`what is no look is none: "${text}"`, () => assert.deepEqual(readLook(text), ALL));

test("a curve is hidden and shown again", () => {
  const hidden = toggled(ALL, "phi");
  assert.deepEqual(hidden.hidden, ["phi"]);
  assert.deepEqual(toggled(hidden, "phi"), ALL);
});

test("a moment keeps its place while one zooms about it, and the whole is the end of it", () => {
  const near = zoomed(ALL, 10, 2.5, 0.5);
  assert.deepEqual(near.span, [1.25, 6.25]);
  assert.equal((2.5 - 1.25) / 5, 2.5 / 10);
  assert.equal(zoomed(near, 10, 2.5, 2).span, null);
  assert.deepEqual(zoomed(ALL, 10, 0, 0.5).span, [0, 5]);
  assert.deepEqual(zoomed(readLook("8:10"), 10, 10, 2).span, [6, 10]);
  const nearest = Array.from({ length: 80 }).reduce((/** @type {any} */ look) => zoomed(look, 10, 3, 0.5), ALL).span;
  assert.ok(nearest[1] - nearest[0] > 0.009 && nearest[0] <= 3 && nearest[1] >= 3);
});

test("a dragged part of the time may begin at either end; a mere press is none", () => {
  assert.deepEqual(between(ALL, 10, 7, 3).span, [3, 7]);
  assert.equal(between(ALL, 10, 3, 3).span, null);
});

test("a part of the time that the motion has not is not shown", () => {
  assert.deepEqual(spanOf(readLook("2:40"), 10), [2, 10]);
  assert.deepEqual(spanOf(readLook("20:40"), 10), [0, 10]);
});

for (const [angle, wrapped] of [[0, 0], [Math.PI, Math.PI], [-Math.PI, Math.PI], [4, 4 - 2 * Math.PI], [-4, 2 * Math.PI - 4], [20, 20 - 6 * Math.PI]])
  test(`${angle} rad is wrapped to (−π, π]`, () => assert.ok(Math.abs(wrap(angle) - wrapped) < 1e-12));

test("a folded line leaves at one edge and comes in at the other, each turn", () => {
  const { x, y } = folded([0, 1, 2], [0, 2 * Math.PI, -4 * Math.PI]);
  const gaps = y.flatMap((value, n) => (Number.isNaN(value) ? [n] : []));
  assert.equal(gaps.length, 1 + 3);
  for (const n of gaps) {
    assert.equal(y[n - 1], -y[n + 1]);
    assert.equal(Math.abs(y[n - 1]), Math.PI);
    assert.equal(x[n - 1], x[n + 1]);
  }
  assert.deepEqual(gaps.map((n) => y[n - 1] > 0), [true, false, false, false]);
  assert.ok(Math.abs(x[gaps[0]] - 0.5) < 1e-12);
  assert.ok(x.every((t, n) => n === 0 || t >= x[n - 1]));
  assert.ok(y.every((value) => Number.isNaN(value) || Math.abs(value) <= Math.PI));
});

const rolling = { ...trajectory, coordinates: { ...trajectory.coordinates, phi: trajectory.t.map((t) => 2 * t) }, rates: { ...trajectory.rates, phi: trajectory.t.map(() => 2) } };

/** @param {string} look */
function drawn(look) {
  const chosen = readLook(look);
  const [from, duration] = spanOf(chosen, 4);
  const frame = { width: 500, height: 300, em: 16, duration, from };
  const rows = rowsOf(scene, /** @type {any} */ (rolling), [], chosen);
  return { rows, traces: tracesOf(rows, /** @type {any} */ (rolling), palette, frame), layout: /** @type {any} */ (layoutOf(rows, duration, palette, "en", 300, 16, from)) };
}

test("a wrapped angle fills (−π, π] and reads as it is drawn", () => {
  const { rows, traces, layout } = drawn("wrapped");
  const phi = traces.find(({ name }) => name === "phi");
  assert.ok(phi?.y.every((/** @type {number} */ value) => !(Math.abs(value) > Math.PI)) && phi.y.some(Number.isNaN));
  assert.ok(layout.yaxis2.range[1] > Math.PI && layout.yaxis2.range[1] < 4);
  assert.ok(Math.abs(readingOf(rows[1].curves[0], 2) - (4 - 2 * Math.PI)) < 1e-9);
  assert.ok(Math.abs(readingOf(drawn("").rows[1].curves[0], 2) - 4) < 1e-9);
});

test("a hidden curve has a name, no line, and no say in the range", () => {
  const { rows, traces, layout } = drawn("-kinetic,-potential");
  assert.deepEqual(rows[2].curves.map(({ key, hidden }) => [key, hidden]), [["kinetic", true], ["potential", true], ["balance", false]]);
  assert.deepEqual(traces.map(({ name }) => name), ["y", "phi", "balance"]);
  assert.ok(layout.yaxis3.range[0] > 3.9);
});

test("a part of the time has the range of its values, and curves that fill it", () => {
  const { traces, layout } = drawn("1:2");
  assert.deepEqual(layout.xaxis.range, [1, 2]);
  const phi = traces.find(({ name }) => name === "phi");
  assert.deepEqual([phi?.x[0], phi?.x.at(-1)], [1, 2]);
  assert.ok(layout.yaxis2.range[0] > 1.5 && layout.yaxis2.range[1] < 4.5);
  const { pixel, time, holds } = timeScale(500, 2, 16, 1);
  assert.ok(Math.abs(time(pixel(1.3)) - 1.3) < 1e-12);
  assert.deepEqual([0.9, 1, 2, 2.1].map(holds), [false, true, true, false]);
});

test("curves of one unit share an axis, or have one each, when that is asked for", () => {
  const coordinates = ["a", "b"].map((name) => ({ ...scene.coordinates[0], name, unit: "rad" }));
  const motion = { ...trajectory, coordinates: { a: trajectory.t, b: trajectory.t.map((t) => 1000 * t) }, energy: null };
  const rows = (/** @type {string} */ look) => rowsOf(/** @type {any} */ ({ ...scene, coordinates }), /** @type {any} */ (motion), [], readLook(look)).length;
  assert.deepEqual(["", "one", "each"].map(rows), [2, 1, 2]);
});
