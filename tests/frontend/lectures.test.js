import { strict as assert } from "node:assert";
import { readdirSync, readFileSync } from "node:fs";
import { test } from "node:test";
import { appended, fragmentOfLecture, KEY, keepDraft, lectureInFragment, readDraft, replaced } from "../../frontend/model/lectures/draft.js";
import { backward, jumped, onward, started, wantedStep } from "../../frontend/model/lectures/giving.js";
import { areStrokes, drawnOn, erased, pathOf, pointIn, withStroke } from "../../frontend/model/lectures/ink.js";
import { fileNameOf, FORMAT, lectureIn, lectureOf, MOST, problemsOf, textOf } from "../../frontend/model/lectures/lecture.js";
import { createDeskLine, createHallLine } from "../../frontend/model/lectures/line.js";
import { begun, blank, changed, emptyPoll, fewerChoices, moreChoices, moved, undone, withChoice, withoutStop, withPatch, withStop } from "../../frontend/model/lectures/outline.js";
import { beginningOf, frameAddress, frameOf, framesOf, isPlace, placeOf } from "../../frontend/model/lectures/place.js";

const POLL = { question: "Which?", choices: ["$a$", "b"], right: 2 };
const STOP = { place: "scene?scene=pendulum&step=position:bob", title: "Position", notes: "Drag it.\nThen ask.", hide: true, poll: POLL };
const LECTURE = { format: FORMAT, title: "Pendulums", lang: "en", stops: [STOP, { place: "proof", title: "Proof" }] };
const with_ = (/** @type {object} */ patch) => ({ ...LECTURE, ...patch });
const stop = (/** @type {object} */ patch) => with_({ stops: [{ place: "proof", title: "Proof" }, { ...STOP, ...patch }] });
const poll = (/** @type {object} */ patch) => stop({ poll: { ...POLL, ...patch } });
const long = (/** @type {number} */ count) => "x".repeat(count);

test("a lecture is what it is after a way through a file", () => {
  assert.deepEqual(lectureIn(textOf(/** @type {any} */ (LECTURE))), { lecture: LECTURE, problems: [] });
});

for (const [name, value, pointer, code] of /** @type {[string, unknown, string, string][]} */ ([
  ["nothing", null, "", "table"],
  ["a list", [], "", "table"],
  ["no format", with_({ format: undefined }), "/format", "format"],
  ["the format to come", with_({ format: "deltaq-lecture/2" }), "/format", "format"],
  ["no title", with_({ title: undefined }), "/title", "text"],
  ["a title of spaces", with_({ title: "  " }), "/title", "empty"],
  ["a title too long", with_({ title: long(MOST.title + 1) }), "/title", "long"],
  ["a title over two lines", with_({ title: "a\nb" }), "/title", "control"],
  ["a language nobody speaks here", with_({ lang: "fr" }), "/lang", "lang"],
  ["a member that is misspelt", with_({ stop: [] }), "/stop", "unknown"],
  ["a member with a name of two parts", with_({ "a/b~c": 1 }), "/a~1b~0c", "unknown"],
  ["no stops", with_({ stops: undefined }), "/stops", "list"],
  ["stops by name", with_({ stops: {} }), "/stops", "list"],
  ["too many stops", with_({ stops: Array(MOST.stops + 1).fill(STOP) }), "/stops", "many"],
  ["a stop that is a text", with_({ stops: ["proof"] }), "/stops/0", "table"],
  ["a stop without place", stop({ place: undefined }), "/stops/1/place", "place"],
  ["another site", stop({ place: "https://example.org/scene" }), "/stops/1/place", "place"],
  ["another site without its scheme", stop({ place: "//example.org/scene" }), "/stops/1/place", "place"],
  ["a script", stop({ place: "javascript:alert(1)" }), "/stops/1/place", "place"],
  ["a page where nothing can be shown", stop({ place: "docs" }), "/stops/1/place", "place"],
  ["a path upwards", stop({ place: "scene/../api/v1/health" }), "/stops/1/place", "place"],
  ["an address with a space", stop({ place: "scene?scene=a b" }), "/stops/1/place", "place"],
  ["an address with a quote", stop({ place: 'scene?scene="' }), "/stops/1/place", "place"],
  ["a backslash", stop({ place: "scene?a\\b" }), "/stops/1/place", "place"],
  ["an address without end", stop({ place: `scene?${long(60_000)}` }), "/stops/1/place", "place"],
  ["a stop without title", stop({ title: "" }), "/stops/1/title", "empty"],
  ["a stop's title too long", stop({ title: long(MOST.stop + 1) }), "/stops/1/title", "long"],
  ["notes that are a number", stop({ notes: 3 }), "/stops/1/notes", "text"],
  ["notes too long", stop({ notes: long(MOST.notes + 1) }), "/stops/1/notes", "long"],
  ["notes with a bell", stop({ notes: "\u0007" }), "/stops/1/notes", "control"],
  ["hiding by a word", stop({ hide: "yes" }), "/stops/1/hide", "flag"],
  ["a stop with a member too many", stop({ html: "<b>" }), "/stops/1/html", "unknown"],
  ["a poll that is a list", stop({ poll: [] }), "/stops/1/poll", "table"],
  ["a poll without question", poll({ question: "" }), "/stops/1/poll/question", "empty"],
  ["a question too long", poll({ question: long(MOST.question + 1) }), "/stops/1/poll/question", "long"],
  ["one choice", poll({ choices: ["a"] }), "/stops/1/poll/choices", "choices"],
  ["five choices", poll({ choices: ["a", "b", "c", "d", "e"] }), "/stops/1/poll/choices", "choices"],
  ["choices in a text", poll({ choices: "ab" }), "/stops/1/poll/choices", "choices"],
  ["an empty choice", poll({ choices: ["a", ""] }), "/stops/1/poll/choices/1", "empty"],
  ["a choice too long", poll({ choices: [long(MOST.choice + 1), "b"] }), "/stops/1/poll/choices/0", "long"],
  ["no right one", poll({ right: undefined }), "/stops/1/poll/right", "right"],
  ["counted from nought", poll({ right: 0 }), "/stops/1/poll/right", "right"],
  ["beyond the last", poll({ right: 3 }), "/stops/1/poll/right", "right"],
  ["between two", poll({ right: 1.5 }), "/stops/1/poll/right", "right"],
  ["two right ones", poll({ right: [1, 2] }), "/stops/1/poll/right", "right"],
  ["a poll with a member too many", poll({ hint: "b" }), "/stops/1/poll/hint", "unknown"],
])) {
  test(`refused where it is wrong: ${name}`, () => {
    const { lecture, problems } = lectureOf(value);
    assert.equal(lecture, null);
    assert.deepEqual(problems.map((problem) => [problem.pointer, problem.code]), [[pointer, code]]);
  });
}

test("texts may be as long as they may", () => {
  assert.deepEqual(problemsOf(with_({ title: long(MOST.title), stops: [{ ...STOP, title: long(MOST.stop), notes: long(MOST.notes) }] })), []);
});

test("all that is wrong is said at once, and no file breaks the reader", () => {
  assert.equal(problemsOf(stop({ title: "", hide: 1, poll: { ...POLL, right: 9 } })).length, 3);
  assert.deepEqual(lectureIn("{").problems, [{ pointer: "", code: "json" }]);
  assert.deepEqual(lectureIn(long(MOST.document + 1)).problems.map(({ code }) => code), ["long"]);
});

test("places are what pages have as their addresses, without what belongs to the reader", () => {
  const site = "http://127.0.0.1:8000";
  assert.equal(placeOf(`${site}/scene?scene=pendulum&step=a:b&lang=de&theme=dark&view=lecture#s=ab-_`, site), "scene?scene=pendulum&step=a:b#s=ab-_");
  assert.equal(placeOf("/proof?lang=en", site), "proof");
  assert.equal(placeOf(" labs?lab=chaos&q.phi1=2&t=1e-3 ", site), "labs?lab=chaos&q.phi1=2&t=1e-3");
  assert.equal(placeOf("http://127.0.0.1:8000.example.org/scene", site), null);
  assert.equal(placeOf(`${site}5scene`, site), null);
  assert.equal(placeOf("https://example.org/scene", site), null);
  assert.ok(isPlace("variations?kind=value&expression=[l*sin(phi),+y]&samples=x:t%5E2;y:1"));
});

test("stops of one derivation share a frame; others have their own", () => {
  const stops = ["scene?scene=a&step=x&part=2", "proof", "scene?scene=a&step=y", "scene?scene=a&n=2", "homework?scene=a&step=y", "homework?scene=a"].map((place) => ({ place }));
  assert.deepEqual(framesOf(stops).map(({ place }) => place), [0, 1, 3, 4, 5].map((i) => stops[i].place));
  assert.equal(frameOf(stops[0].place), frameOf(stops[2].place));
  assert.deepEqual(beginningOf(stops[0].place), { step: "x", part: 2 });
  assert.equal(frameAddress("proof", { lang: "de", theme: "auto" }), "/proof?lang=de&view=lecture");
  assert.equal(frameAddress("labs?lab=chaos&lang=en#s=a", { lang: "de", theme: "dark" }), "/labs?lab=chaos&lang=de&theme=dark#s=a");
});

const titles = (/** @type {{stops: {title: string}[]}} */ { stops }) => stops.map(({ title }) => title).join("");
const abc = ["a", "b", "c"].reduce((all, title) => withStop(all, { place: "proof", title }), blank("x"));

for (const [from, to, after] of /** @type {[number, number, string][]} */ ([
  [0, 1, "bac"], [0, 2, "bca"], [0, 9, "bca"], [2, 0, "cab"], [2, -4, "cab"], [1, 1, "abc"], [7, 0, "abc"],
])) test(`the stop at ${from} moved to ${to}: ${after}`, () => assert.equal(titles(moved(abc, from, to)), after));

test("stops are added at the end or behind another one, cut to length, until there are too many", () => {
  assert.equal(titles(withStop(abc, { place: "proof", title: "d" }, 0)), "adbc");
  assert.equal(withStop(abc, { place: "proof", title: ` ${long(300)}\n` }).stops[3].title.length, MOST.stop);
  assert.equal(withStop(abc, { place: "proof", title: "" }).stops[3].title, "proof");
  const full = { ...abc, stops: Array(MOST.stops).fill(STOP) };
  assert.equal(withStop(full, STOP), full);
  assert.equal(titles(withoutStop(abc, 1)), "ac");
  assert.equal(titles(withPatch(abc, 1, { title: "B" })), "aBc");
});

test("a text is taken back whole, other changes one by one", () => {
  let outline = begun(abc);
  for (const title of ["a1", "a12"]) outline = changed(outline, withPatch(outline.lecture, 0, { title }), "title-1");
  outline = changed(outline, withoutStop(outline.lecture, 1));
  outline = changed(outline, withPatch(outline.lecture, 0, { title: "a3" }), "title-1");
  assert.equal(titles(outline.lecture), "a3c");
  assert.equal(titles((outline = undone(outline)).lecture), "a12c");
  assert.equal(titles((outline = undone(outline)).lecture), "a12bc");
  assert.equal(titles((outline = undone(outline)).lecture), "abc");
  assert.equal(undone(outline).lecture, outline.lecture);
});

test("a poll has two to four choices, and the right one stays the right one", () => {
  const three = withChoice(moreChoices(emptyPoll()), 2, "c");
  assert.deepEqual(fewerChoices({ ...three, right: 3 }, 0), { question: "", choices: ["", "c"], right: 2 });
  assert.equal(fewerChoices({ ...three, right: 2 }, 1).right, 1);
  assert.equal(fewerChoices({ ...three, right: 1 }, 2).right, 1);
  assert.equal(fewerChoices(emptyPoll(), 0).choices.length, 2);
  assert.equal(moreChoices(moreChoices(moreChoices(three))).choices.length, 4);
});

const memory = () => {
  /** @type {Record<string, string>} */
  const kept = {};
  return { kept, getItem: (/** @type {string} */ key) => kept[key] ?? null, setItem: (/** @type {string} */ key, /** @type {string} */ text) => void (kept[key] = text) };
};

test("the draft outlives the page, unfinished texts and all; what is damaged in it is left out", () => {
  const keeper = memory();
  assert.deepEqual(readDraft(keeper), { lecture: null, earlier: [] });
  assert.equal(appended(keeper, { place: "proof", title: "One" }, ""), 1);
  assert.equal(appended(keeper, STOP, ""), 2);
  const { lecture } = readDraft(keeper);
  assert.deepEqual(lecture, { format: FORMAT, title: "", stops: [{ place: "proof", title: "One" }, STOP] });
  keepDraft(keeper, { lecture: withPatch(/** @type {any} */ (lecture), 0, { title: "", poll: emptyPoll() }), earlier: [] });
  assert.equal(readDraft(keeper).lecture?.stops.length, 2);
  keeper.kept[KEY] = JSON.stringify({ lecture: { ...LECTURE, stops: [STOP, { place: "//evil", title: "x" }, 3] }, earlier: [1, LECTURE] });
  assert.deepEqual([readDraft(keeper).lecture?.stops.length, readDraft(keeper).earlier.length], [1, 1]);
  keeper.kept[KEY] = "{";
  assert.deepEqual(readDraft(keeper), { lecture: null, earlier: [] });
  assert.equal(appended({ ...keeper, setItem: () => { throw new Error("full"); } }, STOP, ""), 0);
});

test("another lecture puts one with stops aside, once", () => {
  const first = replaced({ lecture: blank("empty"), earlier: [] }, abc);
  assert.deepEqual(first, { lecture: abc, earlier: [] });
  const other = blank("other");
  const second = replaced(first, other);
  assert.deepEqual(second, { lecture: other, earlier: [abc] });
  assert.deepEqual(replaced(second, abc), { lecture: abc, earlier: [] });
});

test("a link holds the lecture; a damaged one says so; others hold none", async () => {
  const link = await fragmentOfLecture(/** @type {any} */ (LECTURE));
  assert.match(link, /^#l=[\w-]+$/);
  assert.deepEqual(await lectureInFragment(link), { lecture: LECTURE, problems: [] });
  assert.deepEqual((await lectureInFragment("#l=abc"))?.problems, [{ pointer: "", code: "link" }]);
  assert.equal(await lectureInFragment("#s=abc"), null);
  assert.equal(fileNameOf(/** @type {any} */ ({ title: "Über Pendel: $x$!" })), "über-pendel-x");
  assert.equal(fileNameOf(/** @type {any} */ ({ title: "?" })), "lecture");
});

// Five steps, the second with two substeps.
const LINES = /** @type {any} */ (["a", "b", "c", "d", "e"].map((id, index) => ({ index, number: `1.${index}`, step: { id, substeps: id === "b" ? [{ id: "b1" }, { id: "b2" }] : [] } })));
const here = (/** @type {string} */ step, part = 0, pace = "") => /** @type {any} */ ({ lines: LINES, at: { step, part }, pace });
const S = (/** @type {string} */ step) => ({ place: `scene?scene=x&step=${step}`, title: step });
const STOPS = [S("a"), S("d"), { place: "labs", title: "labs", hide: true }, { ...S("b"), poll: POLL }, S("a")];

test("keys go through the steps that lead to the next stop of a derivation, then there", () => {
  let given = started(STOPS);
  assert.deepEqual(onward(STOPS, given, here("a")), { given, go: 1 });
  assert.deepEqual(onward(STOPS, given, here("b")), { given, go: 1 });
  ({ given } = onward(STOPS, given, here("c")));
  assert.deepEqual([given.index, given.phase, given.left], [1, "shown", { 0: { step: "c", part: 0 } }]);
  assert.deepEqual(wantedStep(STOPS, given), { step: "d", part: 0 });
});

test("another page, and a step that lies before, are gone to at once; substeps are gone through where the lecture does", () => {
  const at = { ...started(STOPS, 1) };
  assert.equal(onward(STOPS, at, here("d")).given.index, 2);
  const poll = { ...started(STOPS, 3), phase: /** @type {const} */ ("shown") };
  assert.equal(onward(STOPS, poll, here("b")).given.index, 4);
  assert.deepEqual(onward(STOPS, poll, here("b", 0, "substeps")), { given: poll, go: 1 });
  assert.equal(onward(STOPS, poll, here("b", 3, "substeps")).given.index, 4);
  assert.equal(onward(STOPS, started(STOPS, 0), null).given.index, 1);
  const last = started(STOPS, 4);
  assert.deepEqual(onward(STOPS, last, here("a")), { given: last });
});

test("what is hidden comes with the key, an answer before its result is all there is", () => {
  let { given } = onward(STOPS, started(STOPS, 1), here("d"));
  assert.equal(given.phase, "asked");
  ({ given } = onward(STOPS, given, null));
  assert.deepEqual([given.index, given.phase], [2, "shown"]);
  ({ given } = onward(STOPS, given, null));
  const phases = [given.phase];
  for (let i = 0; i < 2; i += 1) phases.push((given = onward(STOPS, given, here("b")).given).phase);
  assert.deepEqual(phases, ["asked", "answered", "shown"]);
});

test("back goes to where the stop began, then to the one before as it was left", () => {
  let given = jumped(STOPS, started(STOPS), 1, here("c"));
  assert.deepEqual(backward(STOPS, given, here("e")), { given, go: -1 });
  ({ given } = backward(STOPS, given, here("d")));
  assert.deepEqual([given.index, wantedStep(STOPS, given)], [0, { step: "c", part: 0 }]);
  assert.deepEqual(backward(STOPS, given, here("c")), { given, go: -1 });
  assert.deepEqual(backward(STOPS, given, here("a")), { given });
  const again = jumped(STOPS, given, 0, here("b"));
  assert.deepEqual(wantedStep(STOPS, again), { step: "a", part: 0 });
  assert.equal(backward(STOPS, started(STOPS, 3), here("b")).given.phase, "shown");
});

test("ink is drawn in fractions of the slide, and the eraser takes what it touches", () => {
  const frame = { left: 100, top: 50, width: 200, height: 100 };
  assert.deepEqual([pointIn(150, 75, frame), pointIn(0, 900, frame)], [[0.25, 0.25], [0, 1]]);
  const strokes = drawnOn(withStroke([{ colour: 1, points: [[0.9, 0.9]] }], { colour: 0, points: [[0.1, 0.1]] }), [0.2, 0.1]);
  assert.equal(pathOf(strokes[1]), "M0.1 0.1L0.2 0.1");
  assert.match(pathOf(strokes[0]), /^M0.9 0.9l/);
  assert.deepEqual(erased(strokes, [0.2, 0.11], 0.5).map(({ colour }) => colour), [1]);
  assert.deepEqual([0.5, 1].map((ratio) => erased(strokes, [0.2, 0.125], ratio).length), [1, 2]);
  assert.equal(erased(strokes, [0.5, 0.5], 0.5).length, 2);
  assert.deepEqual(drawnOn([], [0, 0]), []);
  assert.ok(areStrokes(strokes));
  for (const bad of [null, [{}], [{ colour: 0, points: [] }], [{ colour: 0, points: [[0, "x"]] }], [{ colour: "a", points: [[0, 0]] }]]) assert.ok(!areStrokes(bad));
});

test("hall and presenter's window tell each other what changes, and the lecture once", () => {
  /** @type {any[]} */
  const sent = [];
  const channel = () => /** @type {any} */ ({ onmessage: null, postMessage: (/** @type {any} */ message) => sent.push(message), close() {} });
  const [ours, theirs] = [channel(), channel()];
  let index = 0;
  /** @type {any[]} */
  const wishes = [];
  const standing = () => /** @type {any} */ ({ index, phase: "shown", at: { step: "", part: 0 }, black: false, ink: [], spot: null, size: [1, 1] });
  const line = createHallLine(ours, /** @type {any} */ (LECTURE), { standing, wish: (wish) => wishes.push(wish) });
  /** @type {any[]} */
  const heard = [];
  const desk = createDeskLine(theirs, (message) => heard.push(message));
  assert.deepEqual(sent.splice(0), [{ kind: "hello" }]);
  ours.onmessage({ data: { kind: "hello" } });
  assert.deepEqual(sent.splice(0)[0].lecture, LECTURE);
  line.tell();
  index = 1;
  line.tell();
  line.tell();
  assert.deepEqual(sent.map((message) => [message.index, message.lecture]), [[1, undefined]]);
  theirs.onmessage({ data: sent[0] });
  theirs.onmessage({ data: { kind: "go", by: 1 } });
  assert.equal(heard.length, 1);
  desk.wish({ kind: "go", by: 1 });
  ours.onmessage({ data: sent.pop() });
  ours.onmessage({ data: { kind: "ink", strokes: [{ colour: 0, points: [["x"]] }] } });
  ours.onmessage({ data: { kind: "hall" } });
  assert.deepEqual(wishes, [{ kind: "go", by: 1 }]);
});

const SHIPPED = new URL("../../backend/deltaq/lectures/", import.meta.url);
for (const file of readdirSync(SHIPPED).filter((name) => name.endsWith(".json")))
  test(`${file} is a lecture`, () => {
    const text = readFileSync(new URL(file, SHIPPED), "utf8");
    assert.deepEqual(lectureIn(text).problems, []);
    assert.equal(textOf(/** @type {any} */ (lectureIn(text).lecture)), text);
  });
