import { strict as assert } from "node:assert";
import { test } from "node:test";
import { ApiError } from "../../frontend/model/api.js";
import { problemsIn } from "../../frontend/model/attempts.js";
import { documentIn } from "../../frontend/model/own.js";
import { HOME } from "../../frontend/model/url.js";
import { busy, derivation, failure, own, page, rest, settled, swing } from "./server.js";

/** @type {any} */
const lines = ["a", "b", "c"].map((id, index) => ({ step: { id }, index }));
const entries = [{ id: "pendulum" }, { id: "elastic-pendulum" }];
const at = (/** @type {any} */ place) => ({ ...HOME, scene: "swing", lang: "en", ...place });

for (const [from, by, to] of /** @type {[string, number, string][]} */ ([["a", 1, "b"], ["b", -1, "a"], ["c", 1, "c"], ["a", -1, "a"], ["a", 2, "c"]])) {
  test(`from step ${from} by ${by}`, () => {
    const { session, get } = page({ lines, place: at({ step: from, part: 2 }) });
    session.go(by);
    assert.deepEqual([get().place.step, get().place.part], [to, 0]);
  });
}

test("whoever goes to a step leaves what lies above the page", () => {
  const { session, get } = page({ lines, overlay: "overview", place: at({ step: "a", part: 2 }) });
  session.goTo("c");
  assert.deepEqual([get().place.step, get().place.part, get().overlay], ["c", 0, ""]);
  session.goTo("b", 4);
  assert.deepEqual([get().place.step, get().place.part], ["b", 4]);
});

test("the same key lays something above the page and takes it away; its words are fetched once", () => {
  const { session, get, all } = page({ catalog: /** @type {any} */ ({ page: {} }) });
  session.overlay("overview");
  assert.equal(get().overlay, "overview");
  session.overlay("goto");
  assert.equal(get().overlay, "goto");
  session.overlay("goto");
  assert.equal(get().overlay, "");
  assert.deepEqual(all("catalog").map(({ given }) => given), [["en", "methods", "lecture"]]);
});

test("a page without an address begins with the lecture's main example", async () => {
  const { session, last, asked, get } = page({ place: at({ scene: "" }) });
  void session.start(at({ scene: "", lang: "de" }));
  await settled();
  assert.deepEqual(asked().sort(), ["catalog", "methods", "scenes"]);
  assert.deepEqual(last("catalog").given, ["de", "methods"]);
  await last("catalog").answer({ page: {} });
  await last("methods").answer({ methods: [{ id: "rk4" }] });
  await last("scenes").answer({ scenes: entries });
  assert.deepEqual([get().scenes, get().methods, get().catalog], [entries, [{ id: "rk4" }], { page: {} }]);
  assert.deepEqual([get().place.scene, last("scene").given], ["elastic-pendulum", ["elastic-pendulum", "de", 0]]);
});

test("a scene in the address waits for no list, one with a method for the list of methods", async () => {
  const quick = page();
  void quick.session.start(at({ step: "b", n: 3, set: "m:2" }));
  await settled();
  assert.deepEqual(quick.last("scene").given, ["swing", "en", 3]);
  assert.deepEqual([quick.get().place.step, quick.get().place.n, quick.get().changes.parameters], ["b", 3, { m: 2 }]);
  const slow = page();
  void slow.session.start(at({ method: "rk4" }));
  await settled();
  assert.equal(slow.asked().includes("scene"), false);
  await slow.last("scenes").answer({ scenes: entries });
  await slow.last("methods").answer({ methods: [{ id: "rk4", adaptive: false }] });
  await slow.pass(0);
  assert.equal(slow.last("simulate").given[0].method, "rk4");
});

test("one's own scene comes with the address; without it there is none to be shown", async () => {
  const with_ = page();
  void with_.session.start(at({ scene: "own" }), own);
  for (const end = performance.now() + 5000; !with_.get().fragment && performance.now() < end; ) await settled();
  assert.deepEqual(with_.last("derive").given[0].scene, own);
  assert.deepEqual(await documentIn(with_.get().fragment), own);
  const without = page();
  void without.session.start(at({ scene: "own" }));
  await settled();
  assert.deepEqual([without.asked().sort(), without.get().fragment], [["catalog", "methods", "scenes"], ""]);
});

test("the start ends with all that it has asked for", async () => {
  const { session, last, asked, pass } = page();
  let ended = false;
  void session.start(at({})).then(() => (ended = true));
  await pass(0);
  /** @type {Record<string, any>} */
  const answers = { catalog: { page: {} }, methods: { methods: [] }, scenes: { scenes: entries }, scene: { id: "swing" }, derive: derivation("a") };
  for (const name of Object.keys(answers)) {
    assert.equal(ended, false, name);
    await last(name).answer(answers[name]);
  }
  assert.equal(ended, true);
  assert.ok(asked().includes("simulate"));
});

test("without scenes the page says why, and shows none", async () => {
  const { session, last, get, asked } = page({ place: at({ scene: "" }) });
  void session.start(at({ scene: "" }));
  await settled();
  await last("methods").answer({ methods: [] });
  await last("scenes").refuse();
  assert.deepEqual([get().failures.page, asked().includes("scene")], [failure, false]);
});

test("what is wrong is what the server says, and nothing where it could not be asked", () => {
  const problems = [{ code: "unknown-name", message: "?", pointer: "/value" }];
  assert.deepEqual(problemsIn(new ApiError(/** @type {any} */ ({ ...failure, problems }))), problems);
  assert.deepEqual([problemsIn(busy()), problemsIn(new Error("gone"))], [[], []]);
});

test("without words the page says why", async () => {
  const { session, last, get } = page();
  void session.language("de");
  await last("catalog").refuse();
  assert.deepEqual(get().failures, { page: failure, scene: null, derivation: null, simulation: null, export: null });
});

test("what a place shows brings its words from the start", async () => {
  for (const [place, sections] of /** @type {[any, string[]][]} */ ([[{ edit: "form" }, ["methods", "editor"]], [{ view: "lecture" }, ["methods", "lecture"]]])) {
    const { session, last } = page();
    void session.start(at(place));
    await settled();
    assert.deepEqual(last("catalog").given, ["en", ...sections]);
  }
});

test("in another language come the words first, then the derivation and what is said of the motion", async () => {
  const { session, last, asked, get, pass } = page();
  void session.language("de");
  assert.deepEqual([get().place.lang, asked()], ["de", ["catalog"]]);
  await last("catalog").answer({ page: { title: "δq" } });
  assert.deepEqual([get().catalog, last("derive").given[0].lang], [{ page: { title: "δq" } }, "de"]);
  await last("derive").answer(derivation("a"));
  await pass(0);
  assert.equal(last("simulate").given[0].lang, "de");
});

test("another formulation is in the address, and has its derivation but no other motion", async () => {
  const { session, last, asked, get, pass } = page();
  void session.formulate("hamilton");
  await pass(200);
  assert.deepEqual([get().place.formulation, asked(), last("derive").given[0].formulation], ["hamilton", ["derive"], "hamilton"]);
});

test("moving on the page changes the address, fetches words and nothing else", async () => {
  const { session, get, last, asked, pass } = page({ catalog: /** @type {any} */ ({ page: {} }) });
  session.move({ edit: "form", panel: "values" });
  await pass(200);
  assert.deepEqual([get().place, asked()], [at({ edit: "form", panel: "values" }), ["catalog"]]);
  assert.deepEqual(last("catalog").given, ["en", "methods", "editor"]);
});

test("words that are wanted from now on are fetched once", () => {
  const { session, all } = page({ catalog: /** @type {any} */ ({ page: {} }) });
  session.need("handout");
  session.need("handout");
  assert.deepEqual(all("catalog").map(({ given }) => given), [["en", "methods", "handout"]]);
});

test("another way to simulate is in the address and in the request", async () => {
  const { session, get, last, pass } = page();
  session.resimulate({ duration: 3 });
  await pass(0);
  assert.deepEqual([get().place.duration, last("simulate").given[0].t_end], [3, 3]);
});

test("a slider moves the address and the motion; what is typed beyond the scene's bounds is held and told", async () => {
  const { session, get, last, pass } = page();
  /** @type {any} */
  const slider = { key: "parameter-m-value", group: "parameter", field: "value", name: "m", least: 0.1, most: 5 };
  for (const [value, kept, held] of /** @type {[number, number, any][]} */ ([[2, 2, null], [9, 5, { key: slider.key, asked: 9 }], [3, 3, null], [Infinity, 3, null]])) {
    session.slide(slider, value);
    assert.deepEqual([get().changes.parameters.m, get().place.set, get().held], [kept, `m:${kept}`, held]);
  }
  await pass(0);
  assert.deepEqual(last("simulate").given[0].parameters, { m: 3 });
  session.reset();
  assert.deepEqual([get().changes, get().place.set], [{ initial: {}, parameters: {} }, ""]);
  await last("simulate").answer(rest(last("simulate").given[0]));
  await pass(100);
  assert.deepEqual(last("simulate").given[0].parameters, {});
});

test("without a scene a slider moves nothing", () => {
  const { session, get, asked } = page({ scene: null });
  session.slide(/** @type {any} */ ({ group: "parameter", name: "m", least: 0, most: 5 }), 2);
  assert.deepEqual([get().changes, asked()], [{ initial: {}, parameters: {} }, []]);
});

test("a motion beside the present one has values and a method of its own, is refined, and leaves the page as it is", async () => {
  const { session, last, all, get } = page({ methods: /** @type {any} */ ([{ id: "rk4", adaptive: false }, { id: "dop853", adaptive: true }]) });
  const before = get();
  const run = session.run({ initial: {}, parameters: { m: 2 } }, "dop853");
  const { scene, parameters, method, samples } = last("simulate").given[0];
  assert.deepEqual([scene, parameters, method], ["swing", { m: 2 }, "dop853"]);
  await last("simulate").answer(swing(last("simulate").given[0], 5));
  assert.ok(last("simulate").given[0].samples > samples);
  await last("simulate").answer(swing(last("simulate").given[0], 5));
  const motion = await run;
  assert.deepEqual([motion.coarse, all("simulate").length, get()], [false, 2, before]);
  session.compare(/** @type {any} */ ([{ motion }]));
  assert.deepEqual(get().runs, [{ motion }]);
});

for (const [there, asked] of /** @type {[any, string[]][]} */ ([
  [{ step: "b" }, []],
  [{ set: "m:2" }, ["simulate"]],
  [{ release: "l" }, ["derive", "simulate"]],
  [{ more: "canonical" }, ["derive"]],
  [{ duration: 20 }, ["simulate"]],
  [{ method: "rk4" }, ["simulate"]],
  [{ method: "rk4", duration: 20 }, ["simulate"]],
  [{ formulation: "hamilton" }, ["derive"]],
  [{ scene: "top", step: "x", set: "C:3" }, ["derive", "scene", "simulate"]],
  [{ n: 4 }, ["derive", "scene", "simulate"]],
])) {
  test(`going back to ${JSON.stringify(there)} asks for ${asked.join() || "nothing"}`, async () => {
    const held = { key: "m", asked: 9 };
    const { session, get, asked: questions, pass } = page({ lines, held, catalog: /** @type {any} */ ({ page: {} }), overlay: "overview", place: at({ step: "a" }) });
    void session.restore(at({ step: "a", ...there }));
    await pass(1000);
    assert.deepEqual(questions().sort(), asked);
    assert.deepEqual([get().place, get().overlay], [at({ step: "a", ...there }), ""]);
    assert.deepEqual(get().changes.parameters, there.set ? { [there.set[0]]: Number(there.set.slice(2)) } : {});
    assert.deepEqual(get().held, there.set || there.n ? null : held);
  });
}

/** A derivation with a second chapter. @param {string} id @param {string[]} steps */
const withChapter = (id, ...steps) => ({ chapters: [...derivation("a").chapters, { ...derivation(...steps).chapters[0], id }] });

for (const [what, answer, told, released] of /** @type {[string, any, string, string][]} */ ([
  ["its steps", (/** @type {string} */ id) => withChapter(id, "c", "d", "e"), "c", "e"],
  ["no steps", (/** @type {string} */ id) => withChapter(id), "a", "a"],
  ["another's steps", () => withChapter("model", "c"), "a", "a"],
  ["an error", null, "a", "a"],
])) {
  test(`a chapter that was asked for and comes with ${what} is opened where there is something to read`, async () => {
    for (const [ask, id, step] of /** @type {[(session: any) => Promise<void>, string, string][]} */ ([
      [(session) => session.tellMore("canonical"), "canonical", told],
      [(session) => session.release("l"), "reactions", released],
    ])) {
      const { session, get, last } = page({ place: at({ step: "a" }) });
      const done = ask(session);
      assert.deepEqual([get().place.more, get().place.release], id === "reactions" ? ["", "l"] : ["canonical", ""]);
      await (answer ? last("derive").answer(answer(id)) : last("derive").refuse());
      await done;
      assert.equal(get().place.step, step);
    }
  });
}
