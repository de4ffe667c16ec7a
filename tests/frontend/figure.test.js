import { strict as assert } from "node:assert";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { test } from "node:test";
import { originsOf } from "../../frontend/model/figure/origins.js";
import { portraitsOf } from "../../frontend/model/figure/phase.js";
import { differences, keyOf, readRuns, withoutRun, withRun } from "../../frontend/model/figure/runs.js";
import { linesOf } from "../../frontend/model/reveal.js";
import { rowsOf } from "../../frontend/model/curves.js";
import { tracesOf } from "../../frontend/model/plots.js";
import { readChanges } from "../../frontend/model/values.js";
import { scene, trajectory } from "./fixtures.js";

const katex = createRequire(new URL("../../frontend/package.json", import.meta.url))("katex");

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
  assert.deepEqual(differences([asked("phi:1:0.5"), asked("")], scene), [["\\dot{q}_2(0) = 0.5"], ["\\dot{q}_2(0) = 0"]]);
});

test("the curves of another run are dashed, in the row of the same quantity, over its own times", () => {
  const other = { ...trajectory, t: [0, 2], coordinates: { y: [0, 1], phi: [1, 0] }, rates: { y: [0.5, 0.5], phi: [-0.5, -0.5] }, energy: undefined };
  const rows = rowsOf(scene, trajectory, [other]);
  assert.deepEqual(rows.map((row) => row.curves.filter(({ beside }) => beside).map(({ key, dash }) => `${key} ${dash}`)), [["y dash"], ["phi dash"], []]);
  const traces = tracesOf(rows, trajectory, { ink: "", muted: "", grid: "", paper: "", of: () => "red" }, { width: 500, height: 300, em: 16, duration: 4 });
  assert.deepEqual(traces.filter(({ line }) => "dash" in line && line.dash === "dash").map(({ x }) => x), [[0, 2], [0, 2]]);
});

test("a phase portrait of a harmonic motion is an ellipse, and knows the moment of each place", () => {
  const t = Array.from({ length: 201 }, (_, i) => i / 20);
  const swing = { ...trajectory, t, coordinates: { phi: t.map((s) => Math.cos(s)) }, rates: { phi: t.map((s) => -Math.sin(s)) } };
  const [portrait, ...rest] = portraitsOf(scene, [swing], { width: 400, height: 300 }, 10);
  assert.equal(rest.length, 0);
  const [start, quarter, half] = [0, Math.PI / 2, Math.PI].map(portrait.where);
  assert.ok(start[0] > quarter[0] && quarter[0] > half[0]);
  assert.ok(quarter[1] > start[1] + 50 && Math.abs(start[1] - half[1]) < 2);
  const moment = portrait.nearest(portrait.where(2.013));
  assert.ok(Math.abs(moment.t - 2.013) < 0.03 && moment.far < 3);
  assert.ok(portrait.columns.length >= 2 && portrait.rows.length >= 2);
  assert.doesNotMatch(portrait.paths[0], /NaN/);
  const [large] = portraitsOf(scene, [swing], { width: 1600, height: 900 }, 40);
  large.columns.slice(1).forEach(({ position }, i) => assert.ok(position - large.columns[i].position > 100, "numbers in large type have room"));
});

test("what is not trusted is apart from the rest of a portrait", () => {
  const t = [0, 1, 2, 3, 4];
  const line = { ...trajectory, t, coordinates: { phi: t }, rates: { phi: [1, 1, 1, 1, 1] } };
  const corners = (/** @type {string} */ d) => d.slice(1).split("L").map((pair) => Number(pair.split(" ")[0]));
  const [{ paths, doubted }] = portraitsOf(scene, [{ ...line, trusted_until: 2 }], { width: 400, height: 300 }, 10);
  const [{ paths: whole, doubted: none }] = portraitsOf(scene, [{ ...line, trusted_until: 4 * (1 - 1e-15) }], { width: 400, height: 300 }, 10);
  const ends = corners(whole[0]);
  assert.ok(Math.abs(corners(paths[0])[2] - (ends[0] + ends[4]) / 2) < 0.02 && corners(paths[0]).length === 3);
  assert.equal(corners(doubted).at(-1), ends[4]);
  assert.equal(none.split("L").length, 1);
});

for (const lang of ["de", "en"]) {
  test(`the laws can be typeset: ${lang}`, () => {
    const laws = JSON.parse(readFileSync(new URL(`../../backend/deltaq/narration/locales/${lang}/laws.json`, import.meta.url), "utf8"));
    for (const [rule, { law }] of Object.entries(laws)) {
      law.split("$").forEach((/** @type {string} */ part, /** @type {number} */ i) => i % 2 && assert.doesNotThrow(() => katex.renderToString(part, { strict: "error" }), rule));
    }
  });
}

/** A step as the server tells it. @param {string} id @param {string} marked @param {[string, [string, string][]][]} terms with their origins @param {object} more */
const step = (id, marked, terms, more = {}) => ({
  id, rule: id, title: id, text: "", latex: marked, marked, verified: true, evidence: { kind: "exact", points: 0, digits: 0 }, premises: [], sources: [], cancelled: [], substeps: [],
  terms: terms.map(([place, origins]) => ({ id: `${id}/${place}`, latex: "", sources: [], from: origins.map(([term, change]) => ({ term, change })) })), ...more,
});

test("terms of a result are marked with what became of them, and lead to the steps they come from", () => {
  const energy = step("energy", "V", [["0.1.0", []], ["0.1.1", []]]);
  const rate = step("rate", "p = \\htmlClass{t-0-1-0}{a} + \\htmlClass{body-b t-0-1-1}{b}", [["0.1.0", []], ["0.1.1", []]]);
  const equation = step(
    "equation", "& \\htmlClass{t-0-0-0}{P} \\Leftrightarrow \\htmlClass{t-0-1-0}{a} + \\htmlClass{load-w t-0-1-1}{c} - \\htmlClass{t-0-1-2}{d} = 0",
    [["0.0.0", [["rate/0.1.0", "kept"]]], ["0.1.0", [["equation/0.0.0", "differentiated"], ["rate/0.1.0", "kept"]]], ["0.1.1", [["energy/0.1.1", "sign-turned"]]], ["0.1.2", []]],
    { substeps: [rate], cancelled: ["rate/0.1.1"] },
  );
  const { formulas, from } = originsOf(linesOf(/** @type {any} */ ([{ id: "a", title: "", steps: [energy, equation] }])), 1);
  assert.equal(formulas.get(/** @type {any} */ (equation)), equation.marked.replace("{t-0-1-0}", "{t-0-1-0 term-kept}").replace("{load-w t-0-1-1}", "{load-w t-0-1-1 term-sign-turned}"));
  assert.equal(formulas.get(/** @type {any} */ (rate)), rate.marked.replace("{body-b t-0-1-1}", "{body-b t-0-1-1 term-gone}"));
  assert.deepEqual([...from], [["kept", ["1.2"]], ["sign-turned", ["1.1"]], ["gone", ["1.2"]]]);
});

test("a single term and a term that comes from nowhere have no mark", () => {
  const alone = step("alone", "\\htmlClass{t-0-1-0}{a}", [["0.0.0", []], ["0.1.0", [["alone/0.0.0", "kept"]]]]);
  const { formulas, from } = originsOf(linesOf(/** @type {any} */ ([{ id: "a", title: "", steps: [alone] }])), 0);
  assert.equal([...formulas.values()][0], alone.marked);
  assert.equal(from.size, 0);
});
