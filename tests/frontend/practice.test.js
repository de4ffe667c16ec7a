/** Practice without end: what the browser remembers, when it comes back, and what leads to the next level. */

import { strict as assert } from "node:assert";
import { test } from "node:test";
import { createEmptyCard, fsrs, Rating } from "../../frontend/node_modules/ts-fsrs/dist/index.mjs";
import { ahead, blank, due, ENOUGH, KEY, onward, opened, readMemory, shown, solved, written, wrong } from "../../frontend/model/homework/memory.js";
import { createAnswering } from "../../frontend/model/homework/answering.js";
import { createExercise } from "../../frontend/model/homework/exercise.js";
import { LEVELS, NO_DRILL, readAsked, writeAsked } from "../../frontend/model/homework/place.js";
import { createPractice } from "../../frontend/model/homework/practice.js";
import { apart, BLANK, createProgress } from "../../frontend/model/homework/progress.js";
import { begin } from "../../frontend/model/homework/state.js";
import { createStore } from "../../frontend/model/store.js";
import { scene, trajectory } from "./fixtures.js";

const MONDAY = new Date(2026, 10, 23, 9, 0);
const MINUTE = 60_000;
const DAY = 24 * 60 * MINUTE;
const after = (/** @type {number} */ ms) => new Date(MONDAY.getTime() + ms);
const half = () => 0.5;
const FIRST_TRY = { tries: 1, hints: 0 };

/** @param {Record<string, string>} [records] */
function storage(records = {}) {
  const kept = new Map(Object.entries(records));
  return {
    kept,
    get length() {
      return kept.size;
    },
    key: (/** @type {number} */ i) => [...kept.keys()][i] ?? null,
    getItem: (/** @type {string} */ key) => kept.get(key) ?? null,
    setItem: (/** @type {string} */ key, /** @type {string} */ value) => void kept.set(key, value),
  };
}

/** A fresh memory on its first exercise. */
const first = () => onward(blank(half), MONDAY);
/** One that has got an exercise wrong in a known way. */
const mistaken = () => wrong(first(), "gravity-sign", "potential-energy", 1, MONDAY);

test("three exercises of a level lead to the next one, and no further than the last", () => {
  let memory = blank(half);
  const levels = [];
  for (let n = 0; n < ENOUGH * (LEVELS.length + 1); n += 1) {
    memory = solved(onward(memory, MONDAY), FIRST_TRY, MONDAY);
    levels.push(memory.level);
  }
  assert.deepEqual(levels.filter((_, n) => n % ENOUGH === ENOUGH - 1), [2, 3, 4, 5, 6, 6, 6]);
  assert.deepEqual(levels.slice(0, 4), [1, 1, 2, 2]);
});

test("an exercise counts once, and not after its solution was shown", () => {
  const once = solved(first(), FIRST_TRY, MONDAY);
  assert.equal(solved(once, FIRST_TRY, MONDAY), once);
  assert.equal(solved(shown(first(), MONDAY), FIRST_TRY, MONDAY).solved, 0);
  assert.equal(opened(once, { ...NO_DRILL, series: "other", number: 7 }, true).open?.done, true);
});

test("no exercise comes again", () => {
  let memory = blank(half);
  const names = Array.from({ length: 30 }, () => {
    memory = solved(onward(memory, MONDAY), FIRST_TRY, MONDAY);
    return `${memory.open?.drill.series}/${memory.open?.drill.number}`;
  });
  assert.equal(new Set(names).size, 30);
});

test("a mistake comes back soon, on an exercise of its kind, and before anything new", () => {
  const memory = mistaken();
  const [lesson] = memory.lessons;
  assert.ok(lesson.card.due > MONDAY && lesson.card.due <= after(10 * MINUTE), String(lesson.card.due));
  assert.equal(onward(memory, MONDAY).open?.drill.recall, "", "not before it is due");
  const { drill } = /** @type {import("../../frontend/model/homework/memory.js").Open} */ (onward(memory, after(10 * MINUTE)).open);
  assert.deepEqual([drill.recall, drill.kind], ["gravity-sign", "potential-energy"]);
});

test("what is due the longest comes first", () => {
  const both = wrong(wrong(first(), "late", "equation", 1, MONDAY), "later", "equation", 1, after(5 * MINUTE));
  assert.deepEqual(due(both, after(DAY)).map(({ id }) => id), ["late", "later"]);
  assert.deepEqual(due(both, after(4 * MINUTE)).map(({ id }) => id), ["late"]);
  assert.deepEqual(ahead(both).map(({ id }) => id), ["late", "later"]);
});

/** How long it takes to come back after each of some exercises in which it did not go wrong. @param {{tries: number, hints: number}} how */
function pauses(how) {
  let memory = mistaken();
  return Array.from({ length: 6 }, () => {
    const now = new Date(memory.lessons[0].card.due.getTime() + 1);
    memory = solved(onward(memory, now), how, now);
    return memory.lessons[0].card.due.getTime() - now.getTime();
  });
}

test("what is known comes back later and later, later where it was known at once", () => {
  const [easy, hard] = [pauses(FIRST_TRY), pauses({ tries: 2, hints: 1 })];
  for (const some of [easy, hard]) assert.ok(some.every((pause, n) => n === 0 || pause >= some[n - 1]), String(some));
  assert.ok(easy[5] > 10 * DAY && easy[5] > 1.5 * hard[5], `${easy} ${hard}`);
});

test("the dates are those of FSRS as its authors publish it", () => {
  const scheduler = fsrs({ enable_fuzz: false });
  let [card, memory] = [scheduler.next(createEmptyCard(MONDAY), MONDAY, Rating.Again).card, mistaken()];
  for (const [how, rating] of /** @type {const} */ ([[FIRST_TRY, Rating.Good], [{ tries: 1, hints: 2 }, Rating.Hard], [FIRST_TRY, Rating.Good], [{ tries: 3, hints: 0 }, Rating.Hard]])) {
    const now = new Date(card.due.getTime() + DAY);
    card = scheduler.next(card, now, rating).card;
    memory = solved(onward(memory, now), how, now);
    assert.deepEqual(memory.lessons[0].card, card);
  }
});

test("made again, passed over or shown, it comes back soon", () => {
  const late = after(DAY);
  const open = onward(mistaken(), late);
  const soon = (/** @type {import("../../frontend/model/homework/memory.js").Memory} */ memory) => memory.lessons[0].card.due.getTime() - late.getTime() <= 10 * MINUTE;
  const again = wrong(open, "gravity-sign", "equation", 2, late);
  assert.ok(soon(again) && soon(solved(again, FIRST_TRY, late)), "right in the end, but made on the way");
  assert.deepEqual([again.lessons.length, again.lessons[0].kind, again.lessons[0].level], [1, "equation", 2]);
  assert.ok(soon(onward(open, late)) && onward(open, late).open?.drill.recall === "");
  assert.ok(soon(shown(open, late)));
  const [known, missed] = [solved(open, FIRST_TRY, late), shown(open, late)].map(({ lessons }) => lessons[0].card.due);
  assert.ok(known > missed);
});

test("a mistake counts once an exercise", () => {
  const memory = mistaken();
  assert.equal(wrong(memory, "gravity-sign", "potential-energy", 1, MONDAY), memory);
});

test("what is written is what is read", () => {
  for (const memory of [blank(half), first(), mistaken(), onward(mistaken(), after(DAY)), solved(onward(mistaken(), after(DAY)), FIRST_TRY, after(DAY))])
    assert.deepEqual(readMemory(written(memory), half), JSON.parse(JSON.stringify(memory), (key, value) => (["due", "last_review"].includes(key) ? new Date(value) : value)));
});

test("what a later version wrote is not taken for this one's", () => {
  const later = JSON.stringify({ ...JSON.parse(written({ ...mistaken(), level: 5 })), format: 2 });
  assert.deepEqual(readMemory(later, half), blank(half));
});

/** Every value of a document, one by one, in the place of which anything else may stand. @param {unknown} value @param {unknown} other @returns {unknown[]} */
function spoilt(value, other) {
  if (typeof value !== "object" || value === null) return [other];
  return Object.entries(value).flatMap(([key, inner]) => [undefined, ...spoilt(inner, other)].map((one) => (Array.isArray(value) ? Object.assign([...value], { [key]: one }) : { ...value, [key]: one })));
}

test("whatever was kept, practice goes on", () => {
  const whole = JSON.parse(written(onward(mistaken(), after(DAY))));
  const texts = [null, "", "{", "7", "[]", '"x"', "null", '{"format":2}', '{"format":1}', "\u0000"];
  const others = [null, -1, 1e400, 1.5, "", "x".repeat(1e4), "<b>", [], {}, true, "9999-99-99", "+275760-09-13T00:00:00.001Z"];
  const broken = others.flatMap((other) => spoilt(whole, other)).map((one) => JSON.stringify(one));
  for (const text of [...texts, ...broken]) {
    const memory = readMemory(text, half);
    assert.ok(memory.series && LEVELS.includes(memory.level) && memory.solved < ENOUGH, text ?? "");
    const next = solved(onward(memory, after(2 * DAY)), FIRST_TRY, after(2 * DAY));
    for (const { card } of next.lessons) assert.ok(!Number.isNaN(card.due.getTime()), text ?? "");
    assert.ok((next.open?.drill.number ?? 0) > 0);
    assert.doesNotThrow(() => readMemory(written(next), half));
  }
});

const task = { id: "potential-energy", kind: "potential-energy", subject: "", title: "", statement: "", form: "expression", form_text: "", components: null, points: 1, needs: [], hints: ["a"], solution: { chapter: "lagrange", steps: [] } };
const verdict = (/** @type {string} */ outcome, /** @type {string[]} */ ...ids) => ({ outcome, misconceptions: ids.map((id) => ({ id, title: id })) });

/** The page's state on an exercise. @param {import("../../frontend/model/homework/memory.js").Drill} drill @param {object} draft @param {string | null} recalled @returns {any} */
const state = (drill, draft, recalled = null) => ({
  asked: { side: "practice", drill },
  sheet: { recalled },
  entry: { key: `${drill.series}~${drill.number}`, task },
  draft: { ...BLANK, ...draft },
});

/** @param {ReturnType<typeof storage>} keeper */
const sessionOn = (keeper, now = MONDAY) => createPractice({ keeper, now: () => now, random: half });

test("a verdict is taken once, also after the page was loaded again", () => {
  const keeper = storage();
  const session = sessionOn(keeper);
  const drill = session.resumed();
  const missed = state(drill, { checked: { verdict: verdict("wrong", "gravity-sign", "load-missing") }, tries: 1 });
  for (let n = 0; n < 3; n += 1) session.observe(missed);
  assert.deepEqual(session.get().memory.lessons.map(({ id, card }) => [id, card.reps]), [["gravity-sign", 1]]);
  const right = { checked: { verdict: verdict("correct") }, tries: 2, solved: true };
  session.observe(state(drill, right));
  assert.equal(session.get().memory.solved, 1);
  const reloaded = sessionOn(keeper);
  reloaded.observe(state(drill, right));
  assert.equal(reloaded.get().memory.solved, 1);
  assert.notDeepEqual(reloaded.resumed(), drill, "the next one, since this one is done");
});

test("an exercise that is not done is the one to go on with; one solved before does not count again", () => {
  const keeper = storage();
  const session = sessionOn(keeper);
  const drill = session.resumed();
  assert.deepEqual(sessionOn(keeper).resumed(), drill);
  const there = { ...NO_DRILL, series: "elsewhere", level: 2, number: 9 };
  session.observe(state(there, { checked: { verdict: verdict("correct") }, tries: 1, solved: true }));
  assert.deepEqual([session.get().memory.solved, session.get().memory.level], [0, 1]);
});

test("what no system has does not come back for ever", () => {
  const keeper = storage({ [KEY]: written(mistaken()) });
  const session = sessionOn(keeper, after(DAY));
  const drill = session.next();
  assert.equal(drill.recall, "gravity-sign");
  session.observe(state(drill, {}, null));
  assert.deepEqual(session.get().memory.lessons, []);
});

test("what comes back on a system stays", () => {
  const session = sessionOn(storage({ [KEY]: written(mistaken()) }), after(DAY));
  session.observe(state(session.next(), {}, "gravity-sign"));
  assert.equal(session.get().memory.lessons.length, 1);
});

test("everything is forgotten when it is asked for twice", () => {
  const keeper = storage({ [KEY]: written(mistaken()) });
  const session = sessionOn(keeper);
  session.forget();
  assert.equal(session.get().memory.lessons.length, 1);
  session.spare();
  session.forget();
  session.forget();
  assert.deepEqual(readMemory(keeper.getItem(KEY), half).lessons, []);
});

test("a browser that keeps nothing practises all the same", () => {
  const refusing = { ...storage(), getItem: () => { throw new Error("no"); }, setItem: () => { throw new Error("no"); } };
  const session = sessionOn(/** @type {any} */ (refusing));
  session.observe(state(session.next(), { checked: { verdict: verdict("correct") }, tries: 1, solved: true }));
  assert.deepEqual([session.get().memory.solved, session.get().kept], [1, false]);
});

test("an exercise has an address", () => {
  const drill = { series: "k3f9", level: 4, number: 12, recall: "gravity-sign", kind: "potential-energy" };
  const asked = { ...readAsked(""), task: "potential-energy", seed: "", side: /** @type {const} */ ("practice"), drill };
  const query = writeAsked(/** @type {any} */ (asked));
  assert.match(query, /side=practice/);
  const turned = Object.fromEntries(Object.entries(drill).reverse());
  assert.equal(writeAsked(/** @type {any} */ ({ ...asked, drill: turned })), query, "and only one");
  assert.deepEqual([readAsked(query).drill, readAsked(query).side], [drill, "practice"]);
  assert.deepEqual([readAsked("?practice").side, readAsked("?practice").drill], ["practice", NO_DRILL]);
  for (const query of ["?practice&level=9&number=1e9&series=", "?practice&level=-1&number=x&series=a", `?practice&series=${"x".repeat(999)}&number=2&level=2`]) {
    const { level, number, series } = readAsked(query).drill;
    assert.ok(LEVELS.includes(level) && Number.isInteger(number) && series.length <= 64, query);
  }
});

test("what is written to exercises lasts as long as the window, and is no part of the work that is saved", () => {
  const [lasting, window] = [storage(), storage()];
  const progress = createProgress(apart(lasting, window));
  progress.write("practice~a~1~1~~/kinetic-energy", { ...BLANK, tries: 3 });
  progress.write("pendulum/kinetic-energy", { ...BLANK, tries: 2 });
  assert.deepEqual([lasting.kept.size, window.kept.size], [1, 1]);
  assert.equal(progress.draft("practice~a~1~1~~/kinetic-energy").tries, 3);
  assert.deepEqual(Object.keys(JSON.parse(progress.exported()).records), ["pendulum/kinetic-energy"]);
});

test("an exercise is asked for by seed, level and number, and who leaves comes back to the tasks", async () => {
  /** @type {[string, any][]} */
  const sent = [];
  const answer = { scene, symbols: [], task, level: 2, recalled: "gravity-sign" };
  const api = /** @type {any} */ ({
    scenes: async () => ({ scenes: [] }),
    simulate: async () => trajectory,
    post: async (/** @type {string} */ path, /** @type {any} */ body) => {
      sent.push([path, body]);
      return path === "/practice" ? answer : path === "/tasks" ? { scene, symbols: [], tasks: [task] } : { latex: "", plain: "", problems: [], readings: [] };
    },
  });
  const store = createStore(begin(/** @type {any} */ ({ ...readAsked("?scene=pendulum&lang=de"), drill: NO_DRILL })));
  const progress = createProgress(storage());
  const exercise = createExercise(store, api, progress, createAnswering(store, api, progress));
  const drill = { series: "a", level: 2, number: 3, recall: "gravity-sign", kind: "potential-energy" };
  await exercise.drill(drill);
  assert.deepEqual(sent[0], ["/practice", { seed: "a", level: 2, number: 3, recall: "gravity-sign", kind: "potential-energy", lang: "de" }]);
  assert.deepEqual(store.get().entry?.reference, { scene });
  assert.equal(store.get().sheet?.recalled, "gravity-sign");
  sent.length = 0;
  exercise.turn("task");
  await new Promise((done) => setTimeout(done, 5));
  assert.deepEqual(sent.filter(([path]) => path === "/tasks").map(([, body]) => body.scene), ["pendulum"]);
});
