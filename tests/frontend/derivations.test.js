import { strict as assert } from "node:assert";
import { test } from "node:test";
import { isUnderWay, missingIn } from "../../frontend/model/derivations.js";
import { scene } from "./fixtures.js";
import { derivation, failure, own, page } from "./server.js";

const ids = (/** @type {any} */ state) =>
  state.lines.map((/** @type {any} */ line) => line.step.id);

test("a derivation is asked for by scene, language, formulation and the number of members", async () => {
  for (const [place, expected] of /** @type {[any, any][]} */ ([
    [
      { scene: "swing", lang: "de" },
      { scene: "swing", lang: "de", formulation: "dalembert-lagrange" },
    ],
    [
      { scene: "swing", formulation: "hamilton" },
      { scene: "swing", lang: "en", formulation: "hamilton" },
    ],
    [
      { scene: "chain", n: 4 },
      {
        scene: "chain",
        lang: "en",
        formulation: "dalembert-lagrange",
        parameters: { n: 4 },
      },
    ],
    [
      { scene: "own" },
      { scene: own, lang: "en", formulation: "dalembert-lagrange" },
    ],
    [
      { scene: "swing", more: "canonical", release: "l,y" },
      { scene: "swing", lang: "en", formulation: "dalembert-lagrange", canonical: true, release: ["l", "y"] },
    ],
  ])) {
    const { session, last } = page({ place, own });
    void session.formulate(place.formulation ?? "dalembert-lagrange");
    assert.deepEqual(last("derive").given, [
      { ...expected, chapters: "ready" },
    ]);
  }
});

test("its steps are on the page, at the one that the address names, else at the first", async () => {
  for (const [step, shown] of [
    ["b", "b"],
    ["elsewhere", "a"],
    ["", "a"],
  ]) {
    const { session, last, get } = page({
      place: /** @type {any} */ ({ step }),
    });
    void session.formulate("hamilton");
    const answer = derivation("a", "b");
    await last("derive").answer(answer);
    assert.deepEqual(
      [get().derivation, ids(get()), get().place.step],
      [answer, ["a", "b"], shown],
    );
  }
});

for (const [
  name,
  overtake,
] of /** @type {[string, (page: ReturnType<typeof import("./server.js").page>) => void][]} */ ([
  ["scene", ({ session }) => session.choose("other")],
  ["scene of one's own", ({ store }) => store.set({ own: { ...own } })],
  ["language", ({ session }) => session.move({ lang: "de" })],
  ["formulation", ({ session }) => session.formulate("hamilton")],
  ["number of members", ({ session }) => session.choose("swing", "", 5)],
  ["release", ({ session }) => session.release("l")],
])) {
  test(`a derivation for another ${name} than the one on the page is not shown, however late it comes`, async () => {
    const about = name.endsWith("own")
      ? page({ place: /** @type {any} */ ({ scene: "own" }), own })
      : page();
    void about.session.formulate("dalembert-lagrange");
    const early = about.last("derive");
    overtake(about);
    await early.answer(derivation("overtaken"));
    assert.deepEqual(
      [about.get().derivation, about.get().lines, about.get().place.step],
      [null, [], ""],
    );
    if (about.last("derive") === early) return;
    await about.last("derive").answer(derivation("wanted"));
    assert.deepEqual(ids(about.get()), ["wanted"]);
  });
}

test("what force holds a length is asked with it, and the chapter opens at what it leads to", async () => {
  const { session, last, get } = page();
  const done = session.release("l");
  assert.deepEqual(last("derive").given[0].release, ["l"]);
  const answer = derivation("a", "b");
  answer.chapters.push({
    ...answer.chapters[0],
    id: "reactions",
    steps: derivation("release:l", "reaction:l").chapters[0].steps,
  });
  await last("derive").answer(answer);
  await done;
  assert.deepEqual(
    [get().place.release, get().place.step],
    ["l", "reaction:l"],
  );
});

test("what is wanted stays when an overtaken answer comes after it", async () => {
  const { session, all, get } = page();
  void session.formulate("dalembert-lagrange");
  void session.formulate("hamilton");
  const [early, late] = all("derive");
  await late.answer(derivation("wanted"));
  await early.answer(derivation("overtaken"));
  assert.deepEqual(ids(get()), ["wanted"]);
});

test("a failure is told of the derivation, and forgotten with the next answer", async () => {
  const { session, last, get } = page();
  void session.formulate("hamilton");
  await last("derive").refuse();
  assert.deepEqual(get().failures, {
    page: null,
    scene: null,
    derivation: failure,
    simulation: null,
    export: null,
  });
  void session.formulate("hamilton");
  await last("derive").answer(derivation("a"));
  assert.equal(get().failures.derivation, null);
});

/** The equations, behind which the last chapter is still to come. @param {string[]} steps */
const early = (...steps) => ({
  ...derivation(...steps),
  left_out: [{ part: "model", reason: "later", text: "follows" }],
});
const late = (/** @type {string[]} */ ...steps) => ({
  ...derivation(...steps),
  left_out: [],
});

test("the equations are shown before the last chapter, which is put behind them", async () => {
  const { session, all, last, get } = page();
  void session.formulate("hamilton");
  await last("derive").answer(early("a", "b"));
  assert.deepEqual(
    [ids(get()), missingIn(get().derivation)?.text],
    [["a", "b"], "follows"],
  );
  assert.deepEqual(
    all("derive").map(({ given }) => given[0].chapters),
    ["ready", "model"],
  );
  await last("derive").answer(late("c"));
  assert.deepEqual(
    [ids(get()), missingIn(get().derivation)],
    [["a", "b", "c"], null],
  );
});

test("a step of the chapter that is to come stays the one that is wanted", async () => {
  const { session, last, get } = page({
    place: /** @type {any} */ ({ step: "c" }),
  });
  void session.formulate("hamilton");
  await last("derive").answer(early("a", "b"));
  assert.equal(get().place.step, "c");
  await last("derive").answer(late("c"));
  assert.equal(get().place.step, "c");
});

test("equations stay where the last chapter fails, which is told behind them", async () => {
  const { session, last, get } = page();
  void session.formulate("hamilton");
  await last("derive").answer(early("a"));
  await last("derive").refuse();
  assert.deepEqual([ids(get()), get().failures.derivation], [["a"], null]);
  assert.deepEqual(missingIn(get().derivation), {
    part: "model",
    reason: "failed",
    text: failure.title,
  });
});

test("a last chapter that was overtaken is not put behind another scene's equations", async () => {
  const { session, last, get } = page();
  void session.formulate("hamilton");
  await last("derive").answer(early("a"));
  const rest = last("derive");
  void session.formulate("dalembert-lagrange");
  await last("derive").answer(late("other"));
  await rest.answer(late("c"));
  assert.deepEqual(ids(get()), ["other"]);
});

test("only what is said of the whole last chapter is said to be missing", () => {
  const told = (/** @type {string} */ part, /** @type {string} */ reason) => ({ part, reason, text: "" });
  for (const [left_out, missing, under_way] of /** @type {[any, any, boolean][]} */ ([
    [undefined, null, false],
    [[], null, false],
    [[told("impacts", "later")], null, false],
    [[told("impacts", "later"), told("model", "budget")], told("model", "budget"), false],
    [[told("model", "later")], told("model", "later"), true],
  ])) {
    const about = { ...derivation("a"), ...(left_out && { left_out }) };
    assert.deepEqual([missingIn(/** @type {any} */ (about)), isUnderWay(/** @type {any} */ (about))], [missing, under_way]);
  }
  assert.deepEqual([missingIn(null), isUnderWay(null)], [null, false]);
});

test("an error of the page's own is none of the last chapter: it is thrown on", async () => {
  const { session, last } = page();
  const done = session.formulate("hamilton");
  await last("derive").answer(early("a"));
  await Promise.all([assert.rejects(done, /broken/), last("derive").refuse(new TypeError("broken"))]);
});

/** One step with a formula, and within it another. */
const told = { ...derivation("a"), chapters: [{ id: "only", title: "", steps: [{ id: "a", latex: "m+u", substeps: [{ id: "b", latex: "m" }] }] }] };
const formulas = (/** @type {any} */ { derivation, lines }) =>
  [derivation.chapters[0].steps[0], derivation.chapters[0].steps[0].substeps[0], lines[0].step].map(({ marked }) => marked);

test("symbols of the scene are marked in all steps; where the scene comes later, from then on", async () => {
  const marked = ["\\htmlClass{p-0}{m}+u", "\\htmlClass{p-0}{m}", "\\htmlClass{p-0}{m}+u"];
  const here = page();
  void here.session.formulate("hamilton");
  await here.last("derive").answer(told);
  assert.deepEqual(formulas(here.get()), marked);
  const later = page();
  void later.session.choose("other");
  await later.last("derive").answer(told);
  assert.deepEqual(formulas(later.get()), [undefined, undefined, undefined]);
  await later.last("scene").answer(scene);
  assert.deepEqual(formulas(later.get()), marked);
});

test("in a scene of one's own its own symbols are marked", async () => {
  const { session, last, get } = page({ place: /** @type {any} */ ({ scene: "own" }), own: { ...own, parameters: [{ name: "u" }] } });
  void session.formulate("hamilton");
  await last("derive").answer(told);
  assert.deepEqual(formulas(get())[0], "m+\\htmlClass{p-0}{u}");
});
