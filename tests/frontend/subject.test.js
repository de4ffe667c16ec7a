import { strict as assert } from "node:assert";
import { test } from "node:test";
import { documentIn } from "../../frontend/model/own.js";
import { degreesOf, freedomsOf } from "../../frontend/model/subject.js";
import { scene, trajectory } from "./fixtures.js";
import { derivation, failure, own, page, rest, settled } from "./server.js";

const other = { ...scene, id: "other" };
const changes = { initial: {}, parameters: { m: 2 } };
const full = /** @type {any} */ ({
  derivation: derivation("a"), lines: [{}], trajectory, runs: [{}], changes, held: { key: "m", asked: 9 }, failures: { page: failure },
});

test("with another scene everything of the one before leaves the page, at once", () => {
  const { session, get, clock } = page(full);
  clock.setEnd(10);
  clock.seek(5);
  void session.choose("other");
  const { scene: none, derivation: no, lines, trajectory: nothing, runs, changes: unchanged, held, failures } = get();
  assert.deepEqual([none, no, lines, nothing, runs, held, clock.time], [null, null, [], null, [], null, 0]);
  assert.deepEqual(unchanged, { initial: {}, parameters: {} });
  assert.deepEqual(failures, { page: null, scene: null, derivation: null, simulation: null, export: null });
});

test("the address names the scene as it was chosen; what belonged to the one before is out of it", () => {
  const before = /** @type {any} */ ({ step: "a", part: 3, vary: "y", runs: "m:1", at: 4, set: "m:2", method: "rk4", duration: 20 });
  for (const [chosen, place] of /** @type {[any[], any][]} */ ([
    [["other"], { scene: "other", step: "", n: 0, set: "", part: 0, vary: "", runs: "", at: 0 }],
    [["other", "b", 4, "m:0.5"], { scene: "other", step: "b", n: 4, set: "m:0.5", part: 0, vary: "", runs: "", at: 0 }],
    [["swing"], { scene: "swing", step: "", n: 0, set: "", part: 3, vary: "y", runs: "m:1", at: 4 }],
  ])) {
    const { session, get } = page({ place: before });
    const usual = get().place;
    void session.choose(.../** @type {[string]} */ (chosen));
    assert.deepEqual(get().place, { ...usual, ...place });
  }
});

test("values in the address are those of the scene that is chosen, and of its motion", async () => {
  const { session, last, get, pass } = page();
  void session.choose("other", "", 0, "m:0.5,phi:1:2");
  await pass(0);
  const expected = { initial: { phi: { value: 1, rate: 2 } }, parameters: { m: 0.5 } };
  assert.deepEqual(get().changes, expected);
  const { scene: of, initial, parameters } = last("simulate").given[0];
  assert.deepEqual({ of, initial, parameters }, { of: "other", ...expected });
});

test("scene, derivation and motion are asked for together", async () => {
  const { session, last, asked, pass } = page({ place: /** @type {any} */ ({ lang: "de" }) });
  void session.choose("chain", "", 3);
  await pass(0);
  assert.deepEqual(asked().sort(), ["derive", "scene", "simulate"]);
  assert.deepEqual(last("scene").given, ["chain", "de", 3]);
});

test("the scene is shown with its derivation, not before it", async () => {
  const { session, last, get } = page();
  void session.choose("other");
  await last("scene").answer(other);
  assert.equal(get().scene, null);
  await last("derive").answer(derivation("a"));
  assert.equal(get().scene, other);
});

for (const [name, again, first] of /** @type {[string, [string, string?, number?], [string, string?, number?]][]} */ ([
  ["another scene", ["swing"], ["other"]],
  ["more members", ["chain", "", 4], ["chain", "", 3]],
])) {
  test(`a scene that was overtaken by ${name} is not shown`, async () => {
    const { session, all, get } = page();
    void session.choose(...first);
    void session.choose(...again);
    for (const one of all("derive")) await one.answer(derivation("a"));
    const [early, late] = all("scene");
    await early.answer(other);
    assert.equal(get().scene, null);
    await late.answer(scene);
    assert.equal(get().scene, scene);
  });
}

test("a scene that is not there is a failure of the scene", async () => {
  const { session, last, get } = page();
  void session.choose("nowhere");
  await last("scene").refuse();
  assert.deepEqual([get().scene, get().failures.scene], [null, failure]);
});

test("a motion on its way is called off with its scene", async () => {
  const { session, last, get, pass } = page();
  void session.choose("swing");
  await pass(0);
  const early = last("simulate");
  void session.choose("other");
  assert.deepEqual([early.given[1].aborted, get().simulating], [true, false]);
  await early.answer(rest(early.given[0]));
  assert.equal(get().trajectory, null);
});

test("one's own scene needs no server to be known; what it leaves out is as usual", async () => {
  const { session, last, asked, get } = page({ own });
  void session.choose("own");
  await last("derive").answer(derivation("a"));
  assert.equal(asked().includes("scene"), false);
  assert.deepEqual([get().scene?.id, get().scene?.coordinates], ["own", [{ unit: "", value: 0, rate: 0, name: "u", latex: "u" }]]);
});

test("where there is no scene of one's own, none is shown", async () => {
  const { session, last, get } = page({ scene: null });
  void session.choose("own");
  await last("derive").answer(derivation("a"));
  assert.equal(get().scene, null);
});

test("while one writes a scene, the page keeps what it shows until the new motion is there", async () => {
  const about = page({ ...full, place: { scene: "own", set: "m:2" }, own: { format: 1 } });
  const { session, last, get, pass } = about;
  void session.show(own);
  assert.deepEqual([get().own, get().changes, get().held, get().place.set], [own, { initial: {}, parameters: {} }, null, ""]);
  assert.deepEqual([get().scene, get().trajectory, get().derivation], [scene, trajectory, full.derivation]);
  await pass(0);
  assert.deepEqual([last("simulate").given[0].scene, last("derive").given[0].scene], [own, own]);
  const moves = rest(last("simulate").given[0]);
  await last("simulate").answer(moves);
  assert.deepEqual([get().trajectory?.t, get().scene?.coordinates[0].name], [moves.t, "u"]);
});

test("one's own scene takes the place of one of the library", async () => {
  const { session, last, get } = page(full);
  void session.show(own);
  assert.deepEqual([get().place.scene, get().trajectory, get().derivation], ["own", null, null]);
  await last("derive").answer(derivation("a"));
  assert.equal(get().scene?.id, "own");
});

test("the address of a scene that is being written holds all of it", async () => {
  const { session, get } = page();
  await session.address(own);
  assert.deepEqual(await documentIn(get().fragment), own);
  await settled();
});

test("coordinates less guides have equations; less constraints as well, they are degrees of freedom", () => {
  const told = (/** @type {number} */ count) => ({ id: "own", chapters: [], result: { degrees_of_freedom: count } });
  for (const [guides, constraints, derivation, freedoms, degrees] of /** @type {[any, any, any, number, number][]} */ ([
    [undefined, undefined, null, 2, 2],
    [[{}], undefined, null, 1, 1],
    [undefined, [{}], null, 2, 1],
    [[], [], null, 2, 2],
    [undefined, [{}, {}, {}], null, 2, 1], // one at least: a scene that moves, of which the derivation will tell more
    [undefined, [{}, {}, {}], told(1), 2, 1],
    [undefined, [{}], told(1), 2, 1],
    [undefined, [{}, {}], { id: "dalembert-lagrange", chapters: [] }, 2, 1], // a general proof, which tells nothing of it
    [undefined, undefined, told(1), 2, 2], // a frozen coordinate: the scene is as it was
  ])) {
    const counted = /** @type {any} */ ({ coordinates: scene.coordinates, guides, constraints });
    assert.deepEqual([freedomsOf(counted), degreesOf(counted, derivation)], [freedoms, degrees]);
  }
});
