import { strict as assert } from "node:assert";
import { test } from "node:test";
import { added, inDimension, numberOf, ofKind, removed, renamed, shifted, written } from "../../frontend/model/editor/changes.js";
import { marked, placed } from "../../frontend/model/editor/problems.js";
import { fieldsOf, isList, isTensor, otherInertia, SECTIONS, shownFields } from "../../frontend/model/editor/schema.js";
import { EMPTY, rowFor } from "../../frontend/model/editor/templates.js";
import { tomlOf } from "../../frontend/model/editor/toml.js";
import { completed, documentIn, fragmentOf, keepDraft, readDraft } from "../../frontend/model/own.js";
import { sketchOf } from "../../frontend/model/drawing/sketch.js";
import { scene, trajectory } from "./fixtures.js";

/** @param {string} pointer */
const problem = (pointer) => ({ pointer, offset: null, length: null, code: "x", message: "x" });

const PLACES = [
  ["a field", "/bodies/0/mass", "/bodies/0/mass"],
  ["a component", "/bodies/0/position/1", "/bodies/0/position/1"],
  ["a vector as a whole: its first component", "/bodies/0/position", "/bodies/0/position/0"],
  ["a field the form does not show: its row", "/bodies/0/colour", "/bodies/0"],
  ["a section", "/bodies", "/bodies"],
  ["an element of the drawing", "/drawing/elements/3/at", "/drawing"],
  ["a row that is not there", "/guides/4/value", "/guides"],
  ["what the form knows nothing of: on top", "/labels/bob", ""],
  ["the document as a whole: on top", "", ""],
];

for (const [name, pointer, place] of PLACES) {
  test(`a problem stands at its place: ${name}`, () => assert.deepEqual([...placed([problem(pointer)], scene).keys()], [place]));
}

const MARKS = [
  ["in the middle", "2*mas", 2, 3, ["2*", "mas", ""]],
  ["past the end", "2*", 2, 1, ["2*", "\u00a0", ""]],
  ["without a length", "a+b", 1, null, ["a", "+", "b"]],
  ["behind a letter of two code units", "𝜑+x", 2, 1, ["𝜑+", "x", ""]],
];

for (const [name, text, offset, length, parts] of MARKS) {
  test(`a place in a text: ${name}`, () => {
    assert.deepEqual(marked(String(text), /** @type {any} */ ({ offset, length })), parts);
  });
}

test("no place, no mark", () => assert.equal(marked("x", problem("")), null));

test("a document returns from its fragment, and rubbish does not", async () => {
  const document = { ...scene, title: { de: "Übung φ̇ „𝜑“", en: "" }, left: null };
  const fragment = await fragmentOf(document);
  assert.match(fragment, /^#s=[\w-]+$/);
  assert.deepEqual(await documentIn(fragment), document);
  for (const bad of ["", "#edit", "#s=", "#s=%%%", "#s=AAAA", fragment.slice(0, -9)]) assert.equal(await documentIn(bad), null);
  assert.equal(await documentIn(await fragmentOf(/** @type {any} */ ([1]))), null);
});

test("a fragment that blows up is refused", async () => {
  assert.equal(await documentIn(await fragmentOf({ text: "a".repeat(500_000) })), null);
});

test("a draft is kept with what cannot be read yet", () => {
  /** @type {Map<string, string>} */
  const kept = new Map();
  const keeper = { getItem: (/** @type {string} */ key) => kept.get(key) ?? null, setItem: (/** @type {string} */ key, /** @type {string} */ value) => void kept.set(key, value) };
  assert.equal(readDraft(keeper), null);
  const draft = { document: { id: "a" }, text: "{ not yet", earlier: [{ id: "b" }] };
  assert.equal(keepDraft(keeper, draft), true);
  assert.deepEqual(readDraft(keeper), draft);
  assert.equal(keepDraft({ ...keeper, setItem: () => { throw new Error("full"); } }, draft), false);
});

test("TOML in the manner of the scene files", () => {
  const document = { format: 1, id: "a", title: { de: "Ü", en: "\"U\"" }, coordinates: [{ name: "phi", latex: "\\varphi", value: 1, max: null }],
    guides: [], bodies: [{ name: "b", position: ["0", "l"], material: [{ name: "s", from: "0", to: "l" }] }],
    drawing: { vertical: "down", elements: [{ kind: "bob", at: "b" }] }, labels: { b: { de: "x\ny" } } };
  assert.equal(tomlOf(document), [
    'format = 1', 'id = "a"', 'title = { de = "Ü", en = "\\"U\\"" }', 'guides = []', '',
    '[[coordinates]]', 'name = "phi"', 'latex = "\\\\varphi"', 'value = 1', '',
    '[[bodies]]', 'name = "b"', 'position = ["0", "l"]', 'material = [', '  { name = "s", from = "0", to = "l" },', ']', '',
    '[drawing]', 'vertical = "down"', 'elements = [', '  { kind = "bob", at = "b" },', ']', '',
    '[labels]', 'b = { de = "x\\ny" }', '',
  ].join("\n"));
});

test("writing changes one field and shares the rest", () => {
  const next = written(scene, "/bodies/0/position/1", "l");
  assert.deepEqual(next.bodies[0].position, ["sin(phi)", "l"]);
  assert.equal(next.points, scene.points);
  assert.deepEqual(written({ points: [{}] }, "/points/0/position/1", "y"), { points: [{ position: ["0", "y"] }] });
  assert.deepEqual(written({ a: 1, b: 2 }, "/a", undefined), { b: 2 });
});

const NUMBERS = [["1.5", 1.5], ["1,5", 1.5], [" 2 ", 2], ["-", "-"], ["1e", "1e"], ["", undefined], ["1e999", "1e999"]];
for (const [typed, value] of NUMBERS) test(`a number as typed: "${typed}"`, () => assert.equal(numberOf(String(typed)), value));

test("a new name is followed by all that hangs on it", () => {
  const next = /** @type {any} */ (renamed({ ...scene, labels: { bob: { de: "Masse" } } }, "bodies", 0, "mass"));
  assert.equal(next.loads[1].at, "mass");
  assert.deepEqual(Object.keys(next.labels), ["mass"]);
  assert.deepEqual(next.drawing.elements.slice(0, 2), [{ kind: "bob", at: "mass" }, { kind: "rod", from: "pivot", to: "mass" }]);
  assert.equal(/** @type {any} */ (renamed(scene, "bodies", 0, "pivot")).loads[1].at, "bob", "a taken name is not followed");
});

/** A row of a kind with all its fields. @param {import("../../frontend/model/editor/schema.js").Section} section @param {string} kind @param {number} dimension */
const full = (section, kind, dimension) => ({ kind, latex: "kept", ...Object.fromEntries(fieldsOf(section, { kind }, dimension).map((field) => [field.key, isList(field) ? ["1"] : "1"])) });

for (const section of SECTIONS.filter(({ kinds }) => kinds)) {
  for (const [from, to] of Object.keys(section.kinds ?? {}).flatMap((one) => Object.keys(section.kinds ?? {}).map((other) => [one, other]))) {
    test(`of ${from} that becomes ${to} nothing stays that the form does not show`, () => {
      const [row] = /** @type {any} */ (ofKind({ dimension: 2, [section.key]: [full(section, from, 2)] }, section.key, 0, to))[section.key];
      const shown = fieldsOf(section, { kind: to }, 2).map(({ key }) => key);
      assert.deepEqual(Object.keys(row).filter((key) => !shown.includes(key)), ["kind", "latex"]);
      assert.deepEqual([row.kind, row.name], [to, "1"]);
    });
  }
}

test("a rigid body in space has no angle, and three moments of inertia are no text", () => {
  const bodies = /** @type {any} */ (SECTIONS.find(({ key }) => key === "bodies"));
  const inPlane = { dimension: 2, bodies: [full(bodies, "rigid", 2)] };
  const inSpace = /** @type {any} */ (inDimension(inPlane, 3));
  assert.deepEqual(inSpace, { dimension: 3, bodies: [{ kind: "rigid", latex: "kept", name: "1", mass: "1", position: ["1"] }] });
  assert.deepEqual(inDimension(inPlane, 2), inPlane);
});

for (const [name, latex] of [["phi", "\\varphi"], ["y_0", "y_{0}"], ["y0", "y_{0}"], ["omega_max", "\\omega_{\\mathrm{max}}"], ["cm", "\\mathrm{cm}"], ["varepsilon2", "\\varepsilon_{2}"], ["m1x", "m_{1,x}"], ["Psi", "\\Psi"], ["L", "L"]])
  test(`a symbol without LaTeX of its own: ${name}`, () => {
    const given = completed({ coordinates: [{ name }], parameters: [{ name, latex: "\\Omega" }] });
    assert.deepEqual([given.coordinates[0].latex, given.parameters[0].latex], [latex, "\\Omega"]);
  });

test("what hung on a removed row goes too", () => {
  const next = /** @type {any} */ (removed(scene, "points", 0));
  assert.deepEqual(next.drawing.elements.map((/** @type {any} */ e) => e.kind), ["bob", "force"]);
});

test("an event follows the place it hangs on, and takes nothing along when it goes", () => {
  const event = { name: "slack", value: "k", at: String(/** @type {any} */ (scene).bodies[0].name) };
  const given = { ...scene, events: [event] };
  assert.equal(/** @type {any} */ (renamed(given, "bodies", 0, "mass")).events[0].at, "mass");
  assert.deepEqual(removed(given, "events", 0), { ...scene, events: [] });
  assert.deepEqual(rowFor(given, "events"), { name: "event", value: "" });
});

test("rows move, and stay within their list", () => {
  assert.deepEqual(/** @type {any} */ (shifted(scene, "coordinates", 0, 1)).coordinates.map((/** @type {any} */ q) => q.name), ["phi", "y"]);
  assert.equal(shifted(scene, "coordinates", 0, -1), scene);
});

test("new rows have free names", () => {
  const one = added(EMPTY, "bodies", rowFor(EMPTY, "bodies"));
  assert.deepEqual([rowFor(EMPTY, "bodies").name, rowFor(one, "bodies").name], ["body", "body2"]);
  assert.equal(rowFor({ ...EMPTY, dimension: 3 }, "points").position.length, 3);
});

test("a rigid body in space has an angular velocity, one in the plane an angle", () => {
  const bodies = /** @type {any} */ (SECTIONS.find(({ key }) => key === "bodies"));
  const keys = (/** @type {number} */ d) => fieldsOf(bodies, { kind: "rigid" }, d).map(({ key }) => key);
  assert.deepEqual([keys(2).at(-1), keys(3).at(-1)], ["angle", "angular_velocity"]);
});

test("surplus components of a vector are shown, not hidden", () => {
  const long = { points: [{ name: "p", position: ["0", "0", "0"] }] };
  assert.deepEqual(shownFields(long).map(({ pointer }) => pointer).slice(-1), ["/points/0/position/2"]);
});

test("a document is completed, and loads without a name are counted", () => {
  const given = completed({ title: "T", coordinates: [{ name: "q" }], loads: [{ kind: "spring" }, { kind: "spring" }, { kind: "force" }] });
  assert.deepEqual(given.loads.map((load) => load.name), ["spring-1", "spring-2", "force"]);
  assert.deepEqual([given.title.de, given.coordinates[0].value, given.dimension, given.bodies], ["T", 0, 2, []]);
});

test("the drawing is found in the motion: rod, ground, pivot, angle, force", () => {
  const plain = /** @type {any} */ ({ ...scene, drawing: { vertical: "down" } });
  assert.deepEqual(sketchOf(plain, trajectory), [
    { kind: "ground", at: "pivot" }, { kind: "trail", at: "bob" }, { kind: "rod", from: "pivot", to: "bob" }, { kind: "pivot", at: "pivot" },
    { kind: "angle", at: "pivot", coordinate: "phi" }, { kind: "force", load: "weight" }, { kind: "force", load: "F" }, { kind: "bob", at: "bob" },
  ]);
});

test("a distance that changes is no rod; a spring is drawn where a load says so", () => {
  const stretched = { ...trajectory, positions: { ...trajectory.positions, bob: trajectory.t.map((t) => [0, 1 + t]) } };
  const sprung = /** @type {any} */ ({ ...scene, drawing: null, loads: [{ kind: "spring", name: "c", from: "pivot", to: "bob" }] });
  assert.deepEqual(sketchOf(sprung, stretched).map(({ kind }) => kind), ["ground", "trail", "spring", "bob"]);
});

test("moments of inertia become the rows of a tensor and back, and all of their fields are shown", () => {
  const moments = ["A", "B", "C"];
  const rows = otherInertia(moments);
  assert.deepEqual(rows, [
    ["A", "0", "0"],
    ["0", "B", "0"],
    ["0", "0", "C"],
  ]);
  assert.deepEqual([isTensor(moments), isTensor(rows)], [false, true]);
  assert.deepEqual(otherInertia(rows), moments);
  const shown = (/** @type {unknown} */ inertia) => {
    const body = { name: "top", kind: "rigid", mass: "m", position: ["0", "0", "0"], inertia };
    const fields = shownFields(/** @type {any} */ ({ ...EMPTY, dimension: 3, bodies: [body] }));
    return fields.filter(({ pointer }) => pointer.startsWith("/bodies/0/inertia")).map(({ pointer, value }) => [pointer.slice(18), value]);
  };
  assert.deepEqual(shown(moments), [["0", "A"], ["1", "B"], ["2", "C"]]);
  assert.deepEqual(shown(rows).length, 9);
  assert.deepEqual(shown(rows)[4], ["1/1", "B"]);
});
