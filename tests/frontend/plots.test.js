import { strict as assert } from "node:assert";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { translator } from "../../frontend/model/catalog.js";
import { rowsOf } from "../../frontend/model/curves.js";
import { slackTimes } from "../../frontend/model/forces.js";
import { picturesOf } from "../../frontend/model/history.js";
import { indeterminateIn } from "../../frontend/model/indeterminate.js";
import { tableOf } from "../../frontend/model/picture/table.js";
import { domainsOf, isShown, layoutOf, marginsOf, marksOf, timeScale, tracesOf } from "../../frontend/model/plots.js";
import { frictionsAt, multipliersAt } from "../../frontend/model/trajectory.js";
import { scene, trajectory } from "./fixtures.js";

const palette = { ink: "black", muted: "gray", grid: "silver", paper: "white", of: (/** @type {string} */ name) => `colour of ${name}` };
const FRAME = { width: 500, height: 300, em: 16, duration: 4 };

test("a row for each unit, and one for the energies", () => {
  assert.deepEqual(rowsOf(scene, trajectory).map((row) => [row.unit, row.curves.map((curve) => curve.key)]), [
    ["m", ["y"]], ["rad", ["phi"]], ["J", ["kinetic", "potential", "balance"]],
  ]);
});

test("reactions have a row above the energies, written as what they hold or as multipliers", () => {
  const multipliers = { lambda_1: trajectory.t.map((t) => t), l: trajectory.t.map((t) => -t) };
  const parameters = [{ name: "l", latex: "\\ell", unit: "m" }, { name: "m", unit: "kg" }];
  const rows = (/** @type {any} */ reactions) => {
    const found = rowsOf(/** @type {any} */ ({ ...scene, parameters }), { ...trajectory, multipliers, reactions }).slice(2, -1);
    return found.map(({ unit, curves }) => [unit, ...curves.map(({ latex, className, pulls }) => [latex, className, pulls])]);
  };
  const [multiplier, held] = [["\\lambda_{1}", "q-2"], ["Z_{\\ell}", "q-3"]];
  const kind = (/** @type {string} */ unit, of_rod = true) => ({ unit, of_rod });
  assert.deepEqual(rows({ lambda_1: kind("N"), l: kind("N") }), [["N", [...multiplier, true], [...held, true]]]);
  assert.deepEqual(rows({ lambda_1: kind("N", false), l: kind("N m", false) }), [["N", [...multiplier, false]], ["N m", [...held, false]]]);
  assert.deepEqual(rows(undefined), [["", [...multiplier, false], [...held, false]]]);
});

for (const [coordinate, unit] of [["y", "N"], ["phi", "N m"], ["y - 2", "N"], ["phi - y", ""], ["l*phi", ""]])
  test(`friction on ${coordinate} is told in ${unit || "no unit"}`, () => {
    const friction = { rubs: { force: trajectory.t, largest: trajectory.t } };
    const rubbed = /** @type {any} */ ({ ...scene, loads: [{ kind: "friction", name: "rubs", coordinate, force: "1" }] });
    const row = rowsOf(rubbed, { ...trajectory, friction }).find((one) => one.key === "friction0");
    assert.equal(row?.unit, unit);
  });

for (const [units, latex, unit] of /** @type {[string[], string[], string][]} */ ([[["N"], ["N"], "N"], [["N", "N"], ["N_{1}", "N_{2}"], "N"], [["N", "N m"], ["N_{1}", "N_{2}"], ""]]))
  test(`contacts in ${units.join(" and ")} share a row, those that never act have none`, () => {
    const contacts = Object.fromEntries(units.map((each, k) => [`c${k}`, { force: trajectory.t, unit: each }]));
    const row = rowsOf(scene, { ...trajectory, contacts }).find((one) => one.key === "contacts");
    assert.deepEqual([row?.unit, row?.curves.map((curve) => curve.latex)], [unit, latex]);
    const open = { wall: { force: trajectory.t.map(() => 0), unit: "N" } };
    assert.ok(rowsOf(scene, { ...trajectory, contacts: open }).every(({ key }) => key !== "contacts"));
  });

/** A force that is not determined between two events, whose times stand twice. */
const broken = () => {
  const force = [1, 2, NaN, NaN, 5, 6];
  return { ...trajectory, t: [0, 1, 1, 3, 3, 4], coordinates: {}, rates: {}, energy: null, friction: { rubs: { force, largest: force.map(() => 9) } }, multipliers: { rod: force } };
};

test("a curve is broken where its force is not determined, and reaches the events on both sides", () => {
  const rows = rowsOf(scene, /** @type {any} */ (broken()));
  for (const name of ["friction-rubs", "reaction-rod"]) {
    const trace = tracesOf(rows, /** @type {any} */ (broken()), /** @type {any} */ (palette), FRAME).find((one) => one.name === name);
    const drawn = /** @type {any} */ (trace).x.map((/** @type {number} */ x, /** @type {number} */ i) => [x, /** @type {any} */ (trace).y[i]]);
    const at = drawn.findIndex((/** @type {number[]} */ [, y]) => !Number.isFinite(y));
    assert.ok(drawn.every((/** @type {number[]} */ [, y], /** @type {number} */ i) => Number.isFinite(y) === (i !== at)));
    assert.deepEqual([drawn[0], drawn.at(-1)], [[0, 1], [4, 6]]);
    assert.ok(Math.abs(drawn[at - 1][0] - 1) < 1e-9 && Math.abs(drawn[at + 1][0] - 3) < 1e-9, JSON.stringify(drawn));
  }
  const still = picturesOf(scene, /** @type {any} */ (broken())).flatMap(({ lines }) => lines);
  assert.deepEqual(still.map(({ path }) => path.split("M").length - 1), [2, 2]);
});

test("values in a gap are dashes, and no arrow is drawn there", () => {
  const motion = /** @type {any} */ (broken());
  assert.deepEqual([0.5, 2, 3.5].map((t) => Number.isFinite(frictionsAt(motion, t).rubs)), [true, false, true]);
  assert.deepEqual([0.5, 2, 3.5].map((t) => Number.isFinite(multipliersAt(motion, t).rod)), [true, false, true]);
  const csv = tableOf(rowsOf(scene, motion), isShown).split("\r\n");
  assert.deepEqual(csv.slice(1, 5).map((line) => line.split(",").slice(0, 3)), [["0", "1", "1"], ["1", "2", "2"], ["1", "", ""], ["3", "", ""]]);
});

test("forces that are not determined are named as in the plots, with when and why", () => {
  const page = (/** @type {string} */ lang) => translator(JSON.parse(readFileSync(new URL(`../../backend/deltaq/narration/locales/${lang}/page.json`, import.meta.url), "utf8")));
  const events = [{ name: "wall", title: { de: "Wand für 3 $", en: "wall" } }];
  const span = (/** @type {number} */ start, /** @type {number} */ end, names = ["a", "rod", "wall"]) => ({ names, start, end });
  const said = (/** @type {string} */ lang, /** @type {any} */ told) =>
    indeterminateIn(/** @type {any} */ ({ ...trajectory, friction: { a: {}, b: {} }, ...told }), /** @type {any} */ ({ ...scene, events }), page(lang), lang);
  assert.deepEqual(said("en", { indeterminate: [] }), []);
  const [one] = said("en", { indeterminate: [span(0, 4)] });
  assert.match(one, /^Statically indeterminate throughout: \$R_\{1\}\$, \$\\mathit\{rod\}\$, the contact force \(“wall”\)\. /);
  assert.match(said("de", { indeterminate: [span(0.5, 1)] })[0], /^Statisch unbestimmt von 0,50 bis 1,00 s: \$R_\{1\}\$, .*„Wand für 3 ＄“/);
  const several = said("en", { indeterminate: [span(0.5, 1), span(1, 2, ["b"]), span(3, 4)] });
  assert.deepEqual(several.map((sentence) => sentence.split(":")[0]), ["Statically indeterminate in 2 spans of time, first from 0.50 to 1.00 s", "Statically indeterminate from 1.00 to 2.00 s"]);
  assert.match(said("en", { undetermined: ["lambda_1", "lambda_2"], indeterminate: [] })[0], /^Not unique, .*: \$\\lambda_\{1\}\$, \$\\lambda_\{2\}\$\. /);
});

for (const [height, ticks] of [[700, 4], [300, 4], [240, 3], [130, 2], [20, 2]])
  test(`in plots of ${height} pixels an axis has ${ticks} ticks at most`, () => {
    const layout = /** @type {any} */ (layoutOf(rowsOf(scene, trajectory), 4, palette, "en", height, 16));
    assert.equal(layout.yaxis.nticks, ticks);
  });

for (const [works, name] of /** @type {[boolean, string][]} */ ([[true, "E + V − ∫P dt"], [false, "E + V"]]))
  test(`the balance of energies is ${name} where ${works ? "something" : "nothing"} else works`, () => {
    const energy = { kinetic: trajectory.t, potential: trajectory.t, balance: trajectory.t, works };
    assert.deepEqual(rowsOf(scene, { ...trajectory, energy }).at(-1)?.curves.map((curve) => curve.name), ["E", "V", name]);
  });

test("where the force of a rod changes its sign a string would go slack", () => {
  const t = Array.from({ length: 81 }, (_, i) => i / 20);
  const curve = (/** @type {boolean} */ pulls) => /** @type {any} */ ({ pulls, times: t, values: t.map(Math.cos), at: Math.cos, className: "q-2" });
  assert.deepEqual(slackTimes(curve(true)).map((time) => time.toFixed(10)), [(Math.PI / 2).toFixed(10)]);
  assert.deepEqual(slackTimes(curve(false)), []);
  const rows = /** @type {any} */ ([{ curves: [] }, { curves: [curve(true)] }]);
  const [mark, ...others] = marksOf(trajectory, rows, palette);
  assert.deepEqual([mark.yref, mark.x0.toFixed(6), mark.line.color, others], ["y2 domain", "1.570796", "colour of q-2", []]);
});

test("coordinates of one unit share a row, each in its own colour", () => {
  const twins = { ...scene, coordinates: scene.coordinates.map((c) => ({ ...c, unit: "m" })) };
  assert.deepEqual(rowsOf(twins, trajectory)[0].curves.map((curve) => curve.className), ["q-0", "q-1"]);
});

for (const [name, ranges, rows] of /** @type {[string, number[], string[][]][]} */ ([
  ["all to be seen", [1, 3, 10], [["a", "b", "c"]]],
  ["the spin of a top beside its nutation", [20, 0.3, 400], [["a"], ["b"], ["c"]]],
  ["two of one size, one apart", [1, 400, 2], [["a", "c"], ["b"]]],
  ["what rests takes no axis", [5, 0, 4], [["a", "b", "c"]]],
  ["one that runs away", [1, 1e300, 2], [["a", "c"], ["b"]]],
]))
  test(`curves of one unit have an axis on which each is to be seen: ${name}`, () => {
    const coordinates = ["a", "b", "c"].map((each) => ({ ...scene.coordinates[0], name: each, unit: "rad" }));
    const values = Object.fromEntries(ranges.map((range, i) => ["abc"[i], trajectory.t.map((t) => (t && range) * (t / (trajectory.t.at(-1) ?? 1)))]));
    const motion = { ...trajectory, coordinates: values, rates: {}, energy: null };
    const told = (/** @type {any} */ one, /** @type {any[]} */ beside = []) => rowsOf(/** @type {any} */ ({ ...scene, coordinates }), one, beside);
    assert.deepEqual(told(motion).map(({ curves }) => curves.map(({ key }) => key)), rows);
    const others = { ...motion, coordinates: { a: values.a, b: values.a, c: values.a } };
    assert.deepEqual(told(motion, [others]).map(({ curves }) => curves.map(({ key }) => key)), rows.map((row) => [...row, ...row]), "runs beside it keep to its rows");
  });

test("events behind which the motion went on are dotted lines, as long as they can be told apart", () => {
  const impact = (/** @type {number} */ time) => ({ name: "floor", time, kind: /** @type {const} */ ("impact"), loss: 1, error: null, together: [] });
  const at = (/** @type {number} */ count) => marksOf({ ...trajectory, events: Array.from({ length: count }, (_, i) => impact(i / 100)) }, [], palette);
  assert.deepEqual(at(3).map(({ x0, x1, line }) => [x0, x1, line.dash]), [[0, 0, "dot"], [0.01, 0.01, "dot"], [0.02, 0.02, "dot"]]);
  assert.deepEqual([marksOf(trajectory, [], palette), at(100)], [[], []]);
});

test("rows fill the height from the top, without overlap", () => {
  const domains = domainsOf(3, 300, 16);
  assert.equal(domains[0][1], 1);
  assert.ok(Math.abs(domains[2][0]) < 1e-12);
  assert.ok(domains[0][0] > domains[1][1] && domains[1][0] > domains[2][1]);
});

test("traces carry the colours of their quantities", () => {
  const traces = tracesOf(rowsOf(scene, trajectory), trajectory, palette, FRAME);
  assert.deepEqual(traces.map((trace) => trace.line.color), ["q-0", "q-1", "energy-kinetic", "energy-potential", "energy-balance"].map(palette.of));
});

test("an error that can be seen is a band around the curve; a small one is none", () => {
  const bands = (/** @type {number} */ e) => tracesOf(rowsOf(scene, trajectory), { ...trajectory, error: { estimate: trajectory.t.map(() => e) } }, palette, FRAME);
  const uncertain = { ...trajectory, error: { estimate: trajectory.t.map(() => 0.1) } };
  const traces = tracesOf(rowsOf(scene, uncertain), uncertain, palette, FRAME);
  const band = traces.find((trace) => "fill" in trace && trace.yaxis === "y2");
  assert.deepEqual([0, 1, 2].map((t) => Math.round(1000 * band?.y[band?.x.indexOf(t)]) / 1000), [0.1, 0.35, 0.6]);
  assert.equal(bands(1e-6).filter((trace) => "fill" in trace).length, 0);
});

test("a constant curve has a range of its own", () => {
  const layout = /** @type {any} */ (layoutOf(rowsOf(scene, trajectory), 4, palette, "de", 300, 16));
  assert.ok(layout.yaxis.range[0] < 0 && layout.yaxis.range[1] > 0);
  assert.equal(layout.separators, ",.");
  assert.deepEqual(layout.xaxis.range, [0, 4]);
});

test("the numbers beside a curve that is nearly constant are short", () => {
  for (const at of [0.3, -0.3, 17.25, 4321]) {
    const [rest, row] = [{ ...trajectory, t: [0, 4], coordinates: { a: [at, at * (1 + 1e-9)] } }, rowsOf(scene, trajectory)[0]];
    const rows = [{ ...row, curves: row.curves.map((curve) => ({ ...curve, values: rest.coordinates.a })) }];
    const [low, high] = /** @type {any} */ (layoutOf(rows, 4, palette, "de", 300, 16)).yaxis.range;
    assert.ok(low < at && at < high);
    assert.ok((high - low) / Math.abs(at) > 5e-4, "four digits tell its ends apart");
  }
});

test("pixels and times are inverse to each other, and held at the ends", () => {
  const { pixel, time } = timeScale(500, 10, 16);
  assert.equal(pixel(0), marginsOf(16).l);
  assert.equal(pixel(10), 500 - marginsOf(16).r);
  assert.ok(Math.abs(time(pixel(3.7)) - 3.7) < 1e-12);
  assert.equal(time(-50), 0);
  assert.equal(time(9999), 10);
});
