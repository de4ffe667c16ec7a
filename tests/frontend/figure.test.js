import { strict as assert } from "node:assert";
import { test } from "node:test";
import { portraitsOf } from "../../frontend/model/figure/phase.js";
import { differences, keyOf, readRuns, withoutRun, withRun } from "../../frontend/model/figure/runs.js";
import { rowsOf, tracesOf } from "../../frontend/model/plots.js";
import { readChanges } from "../../frontend/model/values.js";
import { scene, trajectory } from "./fixtures.js";

const asked = (/** @type {string} */ text, method = "") => ({ changes: readChanges(text), method });

test("runs have an address; the oldest makes room, and none is there twice", () => {
  const first = withRun("", asked("m:2"));
  const second = withRun(first, asked("phi:0.5:0", "rk4"));
  assert.equal(second, "m:2@+phi:0.5:0@rk4");
  assert.deepEqual(readRuns(second).map(keyOf), second.split("+"));
  assert.equal(withRun(second, asked("m:2")), "phi:0.5:0@rk4+m:2@");
  assert.equal(withRun(second, asked("")), "phi:0.5:0@rk4+@");
  assert.equal(withoutRun(second, "m:2@"), "phi:0.5:0@rk4");
  assert.deepEqual(readRuns(""), []);
});

test("a run is named by what sets it apart", () => {
  assert.deepEqual(differences([asked("m:2"), asked("phi:0.5:0"), asked("")], scene), [
    ["m = 2", "q_2(0) = 1"], ["m = 1", "q_2(0) = 0.5"], ["m = 1", "q_2(0) = 1"],
  ]);
  assert.deepEqual(differences([asked(""), asked("", "rk4")], scene), [[], []]);
});

test("the curves of another run are dashed, in the row of the same quantity, over its own times", () => {
  const other = { ...trajectory, t: [0, 2], coordinates: { y: [0, 1], phi: [1, 0] }, energy: undefined };
  const rows = rowsOf(scene, trajectory, [other]);
  assert.deepEqual(rows.map((row) => row.curves.filter(({ beside }) => beside).map(({ key, dash }) => `${key} ${dash}`)), [["y dash"], ["phi dash"], []]);
  const traces = tracesOf(rows, trajectory, { ink: "", muted: "", grid: "", paper: "", of: () => "red" });
  assert.deepEqual(traces.filter(({ line }) => "dash" in line && line.dash === "dash").map(({ x }) => x), [[0, 2], [0, 2]]);
});

test("a phase portrait of a harmonic motion is an ellipse, and knows the moment of each place", () => {
  const t = Array.from({ length: 201 }, (_, i) => i / 20);
  const swing = { ...trajectory, t, coordinates: { phi: t.map((s) => Math.cos(s)) }, rates: undefined };
  const [portrait, ...rest] = portraitsOf(scene, [swing], { width: 400, height: 300 }, 10);
  assert.equal(rest.length, 0);
  const [start, quarter, half] = [0, Math.PI / 2, Math.PI].map(portrait.where);
  assert.ok(start[0] > quarter[0] && quarter[0] > half[0]);
  assert.ok(quarter[1] > start[1] + 50 && Math.abs(start[1] - half[1]) < 2);
  const moment = portrait.nearest(portrait.where(2.013));
  assert.ok(Math.abs(moment.t - 2.013) < 0.03 && moment.far < 3);
  assert.ok(portrait.columns.length >= 2 && portrait.rows.length >= 2);
  assert.doesNotMatch(portrait.paths[0], /NaN/);
});
