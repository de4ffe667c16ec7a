import { strict as assert } from "node:assert";
import { test } from "node:test";
import { isComplete, joined, partsOf, placeIn } from "../../frontend/model/homework/answer.js";
import { createAnswering, isCurrent, partsIn } from "../../frontend/model/homework/answering.js";
import { assignmentIn, fragmentOfAssignment } from "../../frontend/model/homework/assignment.js";
import { createConversion } from "../../frontend/model/homework/conversion.js";
import { columnsFor, inRows, isWord, keyboardOf, shortcutsOf, written } from "../../frontend/model/homework/keys.js";
import { paired } from "../../frontend/model/homework/fences.js";
import { base64, createClassroom } from "../../frontend/model/homework/classroom.js";
import { patient } from "../../frontend/model/homework/patience.js";
import { createExercise } from "../../frontend/model/homework/exercise.js";
import { stepOf } from "../../frontend/model/homework/solution.js";
import { framed, parting } from "../../frontend/model/homework/motions.js";
import { readAsked, stepAddress, writeAsked } from "../../frontend/model/homework/place.js";
import { apart, BLANK, createProgress, draftOf, linesOf } from "../../frontend/model/homework/progress.js";
import { groupOf, pointsOf, referenceIn, sheetOfAssignment, sheetOfScene } from "../../frontend/model/homework/sheet.js";
import { begin } from "../../frontend/model/homework/state.js";
import { createTrail } from "../../frontend/model/homework/trail.js";
import { ApiError } from "../../frontend/model/api.js";
import { createStore } from "../../frontend/model/store.js";
import { scene, trajectory } from "./fixtures.js";

/** A browser's storage. */
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

const task = { id: "equation:phi", kind: "equation", subject: "phi", title: "", statement: "", form: "equation", form_text: "", components: null, points: 3, needs: [], hints: ["a", "b", "c"], solution: { chapter: "lagrange", steps: [] } };
const symbols = [
  { name: "y", latex: "q_1", kind: "coordinate", unit: "m", value: null },
  { name: "phi", latex: "q_2", kind: "coordinate", unit: "rad", value: null },
  { name: "m", latex: "m", kind: "parameter", unit: "kg", value: 1 },
];
/** @param {Partial<typeof task>[]} tasks */
const sheetOf = (...tasks) => sheetOfScene({ scene: "swing" }, /** @type {any} */ ({ scene, symbols, tasks: tasks.map((one) => ({ ...task, ...one })) }));

for (const [name, { form, components }, freedoms, count] of /** @type {const} */ ([
  ["one expression", { form: "expression", components: null }, 2, 1],
  ["components of a vector", { form: "vector", components: 3 }, 2, 3],
  ["an equation for each degree of freedom", { form: "equations", components: null }, 2, 2],
  ["a frequency for each", { form: "set", components: null }, 2, 2],
])) test(`parts: ${name}`, () => assert.equal(partsOf({ form, components }, freedoms), count));

for (const [name, parts, form, syntax, text] of /** @type {const} */ ([
  ["a single part is itself", ["a = b"], "equation", "plain", "a = b"],
  ["a vector in text", ["a", "b"], "vector", "plain", "[a, b]"],
  ["a vector in LaTeX", ["a", "b"], "vector", "latex", "\\begin{bmatrix} a \\\\ b \\end{bmatrix}"],
  ["a set of equations", ["a = 0", "b = 0"], "equations", "plain", "a = 0\nb = 0"],
  ["a whole vector in the first field", ["[a, b]", ""], "vector", "plain", "[a, b]"],
  ["a vector in parentheses", ["(a, b)", ""], "vector", "plain", "(a, b)"],
  ["components by name", ["x = a, y = b", ""], "vector", "plain", "x = a, y = b"],
  ["a sum of unit vectors", ["a e_x + b e_y", ""], "vector", "plain", "a e_x + b e_y"],
  ["a sum of unit vectors as a formula", ["a\\vec{e}_x+b\\vec{e}_y", ""], "vector", "latex", "a\\vec{e}_x+b\\vec{e}_y"],
  ["one component with decimals", ["0,5 a", ""], "vector", "plain", "[0,5 a, ]"],
  ["one component with two arguments", ["atan2(a, b)", ""], "vector", "plain", "[atan2(a, b), ]"],
  ["all equations in the first field", ["a = 0; b = 0", ""], "equations", "plain", "a = 0; b = 0"],
  ["a space is no separator", ["a\\;b = 0", "c = 0"], "equations", "latex", "a\\,b = 0\nc = 0"],
])) test(`joined: ${name}`, () => assert.equal(joined(parts, form, syntax), text));

test("an answer is complete when no part is missing, or when the first one is the whole", () => {
  assert.equal(isComplete(["a", " "], "vector"), false);
  assert.equal(isComplete(["[a, b]", ""], "vector"), true);
  assert.equal(isComplete(["a"], "expression"), true);
});

for (const [name, parts, form, syntax, offset, place] of /** @type {const} */ ([
  ["in the first component", ["foo", "b"], "vector", "plain", 1, { part: 0, offset: 0 }],
  ["in the second component", ["a", "b + foo"], "vector", "plain", 8, { part: 1, offset: 4 }],
  ["in a matrix", ["a", "b"], "vector", "latex", 21, { part: 1, offset: 0 }],
  ["in the second equation", ["a = 0", "foo"], "equations", "plain", 6, { part: 1, offset: 0 }],
  ["past the end", ["ab"], "expression", "plain", 9, { part: 0, offset: 2 }],
  ["letters of two units count once", ["𝜑𝜑", "foo"], "vector", "plain", 5, { part: 1, offset: 0 }],
])) test(`place of a problem: ${name}`, () => assert.deepEqual(placeIn(parts, form, syntax, offset), place));

test("the address holds scene, task, seed and side, and is read back", () => {
  const asked = readAsked("?scene=pendulum&lang=de&task=equation:phi&seed=Käthe&side=working");
  assert.equal(asked.seed, "Käthe");
  assert.deepEqual(readAsked(writeAsked(asked)), asked);
  assert.equal(writeAsked(readAsked("?side=else&theme=dark")), "?theme=dark");
  assert.equal(stepAddress("pendulum", "equation:phi", asked.place), "/scene?scene=pendulum&step=equation:phi&lang=de");
});

for (const [name, text, start, end, plain, value, caret] of /** @type {const} */ ([
  ["a name", "a", 1, 1, "dot(phi)", "adot(phi)", 9],
  ["a function around nothing", "", 0, 0, "sin(|)", "sin()", 4],
  ["a function around what is chosen", "a+b", 0, 3, "sqrt(|)", "sqrt(a+b)", 8],
  ["a name instead of what is chosen", "a+b", 2, 3, "g", "a+g", 3],
])) test(`a key writes ${name}`, () => assert.deepEqual(written(text, start, end, plain), { value, caret }));

const names = (/** @type {Partial<typeof task>} */ change, /** @type {string} */ row, guides = /** @type {any[]} */ ([])) =>
  keyboardOf(/** @type {any} */ ({ symbols, scene: { ...scene, guides }, task: { ...task, ...change } }), (text) => text).find(({ id }) => id === row)?.keys.map(({ name }) => name);

test("the keyboard offers what a task is made of", () => {
  assert.deepEqual(names({}, "motion")?.slice(3, 6), ["phi", "dot(phi)", "ddot(phi)"]);
  assert.deepEqual(names({ kind: "virtual-work", form: "expression" }, "motion")?.slice(0, 4), ["y", "delta(y)", "phi", "delta(phi)"]);
  assert.equal(names({ kind: "eigenfrequencies", form: "set" }, "motion")?.[0], "omega");
  assert.deepEqual(names({}, "motion", [{ coordinate: "y", value: "0" }])?.slice(0, 2), ["phi", "dot(phi)"]);
  assert.deepEqual(names({}, "parameters"), ["m"]);
  assert.deepEqual(names({ kind: "stability", form: "stability" }, "operations")?.slice(0, 5), ["homework.word-stable", "homework.word-unstable", "homework.word-for", "<", ">"]);
  const words = keyboardOf(/** @type {any} */ ({ symbols, scene, task: { ...task, form: "stability" } }), (text) => text).flatMap(({ keys }) => keys).filter(isWord);
  assert.deepEqual(words.map(({ latex }) => latex), ["stable", "unstable", "for"].map((word) => `\\operatorname{homework.word-${word}}`));
  assert.deepEqual(names({ kind: "equilibria", form: "positions" }, "operations")?.slice(0, 3), [" = ", ";", "±"]);
  assert.equal(names({ kind: "position", form: "vector" }, "operations")?.includes(" = "), false);
  assert.equal(shortcutsOf(symbols)["phi''"], "\\ddot{q}_2");
});

test("a draft out of anything", () => {
  assert.deepEqual(draftOf(null), BLANK);
  assert.deepEqual(draftOf({ syntax: "plain", texts: { plain: ["a", 3] }, hints: 9, tries: -1, checked: { verdict: 3 } }), { ...BLANK, syntax: "plain", texts: { plain: ["a"], latex: [] }, hints: 3 });
});

test("a draft that is whole is kept as it is; of one that is not, what is", () => {
  const verdict = { outcome: "wrong" };
  const whole = { syntax: "plain", texts: { plain: ["a"], latex: ["b", "c"] }, converted: { from: "plain", texts: ["a"] }, checked: { verdict, syntax: "plain", value: "a", lang: "de" }, tries: 2, hints: 1, solved: true, shown: true };
  assert.deepEqual(draftOf(whole), whole);
  for (const [given, kept] of /** @type {[any, any][]} */ ([
    [{ converted: { from: "html", texts: ["a", 1] } }, { converted: { from: "latex", texts: ["a"] } }],
    [{ converted: "plain", texts: "a" }, {}],
    [{ checked: { verdict: { outcome: 3 } } }, {}],
    [{ tries: 1.5, hints: "2", solved: 1, shown: "yes" }, {}],
    [{ hints: 3, tries: 12 }, { hints: 3, tries: 12 }],
  ])) assert.deepEqual(draftOf(given), { ...BLANK, ...kept });
});

test("records lie in the browser under their names; a file has them in order, and nothing of others", () => {
  const keeper = storage({ unrelated: "1", "deltaq.homework.1/b": "2", "deltaq.homework.1/a": "{", "deltaq.homework.10/c": "3" });
  const progress = createProgress(keeper);
  assert.equal(progress.write("c", { name: "Ada", id: 7 }), true);
  assert.equal(keeper.getItem("deltaq.homework.1/c"), '{"name":"Ada","id":7}');
  assert.equal(progress.exported(), JSON.stringify({ format: "deltaq-homework-1", records: { a: null, b: 2, c: { name: "Ada", id: 7 } } }, null, 1));
  assert.deepEqual(["a", "b", "c", "d"].map((key) => progress.who(key)), [{ name: "", id: "" }, { name: "", id: "" }, { name: "Ada", id: "" }, { name: "", id: "" }]);
  progress.write("d", { name: 7, id: "4711" });
  assert.deepEqual(progress.who("d"), { name: "", id: "4711" });
  const line = { task: "lagrangian", syntax: "plain", value: "T - V" };
  progress.write("e", [line, 3]);
  assert.deepEqual([progress.lines("e"), progress.lines("d")], [[line], []]);
  const broken = { ...keeper, get length() { throw new Error("closed"); } };
  assert.equal(createProgress(/** @type {any} */ (broken)).exported(), JSON.stringify({ format: "deltaq-homework-1", records: {} }, null, 1));
});

test("exercises without end lie in the window, all else where it lasts and is saved", () => {
  const [lasting, window] = [storage({ kept: "1" }), storage()];
  const progress = createProgress(apart(lasting, window));
  progress.write("practice~pendulum", 1);
  progress.write("pendulum", 2);
  assert.deepEqual([[...lasting.kept.keys()], [...window.kept.keys()]], [["kept", "deltaq.homework.1/pendulum"], ["deltaq.homework.1/practice~pendulum"]]);
  assert.deepEqual(JSON.parse(progress.exported()).records, { pendulum: 2 });
  assert.equal(apart(lasting, window).getItem("deltaq.homework.1/practice~pendulum"), "1");
});

test("a file of two million letters is taken, one of more is not", () => {
  const file = (/** @type {number} */ length) => {
    const text = JSON.stringify({ format: "deltaq-homework-1", records: { a: "" } });
    return text.replace('""', `"${"x".repeat(length - text.length)}"`);
  };
  assert.deepEqual([2_000_000, 2_000_001].map((length) => createProgress(storage()).imported(file(length))), [1, null]);
});

test("lines out of anything: what is none is passed over", () => {
  const line = { task: "lagrangian", syntax: "plain", value: "T - V" };
  const kept = [line, { ...line, syntax: "html" }, { ...line, task: 3 }, { ...line, value: null }, null, "T", [line]];
  assert.deepEqual(linesOf(kept), [line, { ...line, syntax: "latex" }]);
  for (const other of [null, line, "T", { 0: line, length: 1 }]) assert.deepEqual(linesOf(other), []);
});

test("work is exported and imported, and what is no work is refused", () => {
  const own = createProgress(storage());
  own.write("swing/equation:phi", { ...BLANK, solved: true });
  const other = createProgress(storage({ unrelated: "1" }));
  assert.equal(other.imported(own.exported()), 1);
  assert.equal(other.draft("swing/equation:phi").solved, true);
  assert.equal(other.imported("{}"), null);
  assert.equal(other.imported("not JSON"), null);
});

for (const [name, file] of /** @type {[string, unknown][]} */ ([
  ["without a format", { records: { "swing/lagrangian": BLANK } }],
  ["of another program", { format: "notes-1", records: { "swing/lagrangian": BLANK } }],
  ["of a later format", { format: "deltaq-homework-2", records: { "swing/lagrangian": BLANK } }],
  ["that is an assignment", { format: "deltaq-assignment-1", tasks: [], records: { "swing/lagrangian": BLANK } }],
  ["whose records are a list", { format: "deltaq-homework-1", records: [BLANK] }],
  ["without records", { format: "deltaq-homework-1" }],
  ["that is a list", [{ format: "deltaq-homework-1", records: { "swing/lagrangian": BLANK } }]],
  ["of more than two million letters", { format: "deltaq-homework-1", records: { "swing/lagrangian": "x".repeat(2_000_000) } }],
])) {
  test(`a file ${name} is not taken for one's own work`, () => {
    const kept = storage();
    assert.equal(createProgress(kept).imported(JSON.stringify(file)), null);
    assert.equal(kept.length, 0);
  });
}

test("how many records of a file were kept is told", () => {
  const records = { "swing/lagrangian": BLANK, "swing/equation:phi": BLANK };
  const file = JSON.stringify({ format: "deltaq-homework-1", records });
  assert.equal(createProgress(storage()).imported(file), 2);
  const full = { ...storage(), setItem: () => { throw new Error("full"); } };
  assert.equal(createProgress(full).imported(file), 0);
});

test("where the browser keeps nothing, that is told", () => {
  const full = { ...storage(), setItem: () => { throw new Error("full"); } };
  assert.equal(createProgress(full).write("a", {}), false);
});

test("points: a task whose solution was seen before earns none", () => {
  const sheet = sheetOf({}, { id: "lagrangian", points: 1 }, { id: "kinetic-energy", points: 2 });
  const drafts = { [sheet.entries[0].key]: { ...BLANK, solved: true }, [sheet.entries[1].key]: { ...BLANK, solved: true, shown: true } };
  assert.deepEqual(pointsOf(sheet, (key) => drafts[key] ?? BLANK), { earned: 3, of: 6, solved: 2, count: 3 });
});

test("what requests say of an assignment's scene, with each student's own values", () => {
  const assignment = { format: 1, individual: true, tasks: [{ scene: "pendulum", task: "lagrangian", points: 2, guides: [{ coordinate: "y", value: "0" }] }] };
  assert.deepEqual(referenceIn(assignment, 0, "ada"), { scene: "pendulum", guides: [{ coordinate: "y", value: "0" }], seed: "ada" });
  assert.deepEqual(referenceIn({ ...assignment, individual: false }, 0, "ada").seed, undefined);
  assert.notEqual(groupOf({ scene: "pendulum", guides: [] }), groupOf({ scene: "pendulum" }));
  assert.equal(groupOf({ scene: "pendulum", seed: "ada" }), "pendulum@ada");
});

test("an assignment's sheet: its tasks by number, each with its scene, and the share of a right consequence", () => {
  const assignment = { format: 1, individual: true, tasks: [{ scene: "swing", task: task.id }, { scene: "swing", task: task.id, freeze: ["y"] }] };
  const tasks = [{ scene, symbols, task }, { scene: { ...scene, id: "frozen" }, symbols: [], task: { ...task, points: 1 } }];
  const { title, followThrough, entries } = sheetOfAssignment(/** @type {any} */ (assignment), "ada", /** @type {any} */ ({ title: { en: "Sheet 3" }, follow_through: 0.25, tasks }));
  assert.deepEqual([title, followThrough], [{ en: "Sheet 3" }, 0.25]);
  assert.deepEqual(entries.map(({ id, scene: of, task: { points } }) => [id, of.id, points]), [["1", "swing", 3], ["2", "frozen", 1]]);
  assert.deepEqual(entries.map(({ reference }) => reference), [{ scene: "swing", seed: "ada" }, { scene: "swing", freeze: ["y"], seed: "ada" }]);
  assert.equal(new Set(entries.map(({ key }) => key)).size, 2);
});

test("an assignment travels in an address, and comes from files", async () => {
  const assignment = { format: 1, title: { de: "Blatt 3" }, tasks: [{ scene: "pendulum", task: "lagrangian" }] };
  const api = { readToml: async () => ({ scene: assignment }) };
  assert.deepEqual(await assignmentIn(await fragmentOfAssignment(assignment), "", api, "de"), assignment);
  assert.deepEqual(await assignmentIn(JSON.stringify(assignment), "sheet.json", api, "de"), assignment);
  assert.deepEqual(await assignmentIn("format = 1", "sheet.toml", api, "de"), assignment);
  assert.equal(await assignmentIn('{"format": 1}', "work.json", api, "de"), null);
  assert.equal(await assignmentIn("#a=broken", "", api, "de"), null);
});

test("both motions stand in one frame, and part at a time", () => {
  const wide = { ...trajectory, positions: { ...trajectory.positions, bob: trajectory.t.map(() => [9, 0]) } };
  const [x0, x1] = framed(/** @type {any} */ (scene), [trajectory, wide]).drawing?.view ?? [];
  assert.ok(x0 <= -2 && x1 >= 9);
  const other = { ...trajectory, coordinates: { ...trajectory.coordinates, phi: trajectory.t.map((t) => (t < 2 ? t / 4 : 2)) } };
  assert.equal(parting(trajectory, other), 2);
  assert.equal(parting(trajectory, trajectory), null);
});

/** A page with one task, and a server that answers from a table. @param {Record<string, any>} answers */
function pageWith(answers) {
  const [entry] = sheetOf({}).entries;
  const store = createStore({ ...begin(readAsked("?lang=en")), sheet: sheetOf({}), entry });
  /** @type {[string, any][]} */
  const sent = [];
  const post = async (/** @type {string} */ path, /** @type {any} */ body) => {
    sent.push([path, body]);
    if (answers[path] instanceof Error) throw answers[path];
    return answers[path];
  };
  const keeper = storage();
  const progress = createProgress(keeper);
  const api = /** @type {any} */ ({ post });
  const answering = createAnswering(store, api, progress);
  return { store, entry, sent, keeper, progress, answering, switchTo: createConversion(store, api, answering), again: () => createProgress(keeper).draft(entry.key) };
}

const WRONG = { outcome: "wrong", understood_as: "x", feedback: "Not right yet.", misconception: null, misconceptions: [], slip: null, parts: [], problems: [], counterexample: null };

test("every keystroke is kept, and a verdict belongs to what was checked", async () => {
  const { store, entry, answering, again } = pageWith({ "/checks": WRONG, "/checks/reading": { latex: "x", plain: "x", problems: [] } });
  answering.type(0, "phi = 0");
  assert.deepEqual(again().texts.latex, ["phi = 0"]);
  await answering.check();
  assert.equal(again().checked?.verdict.outcome, "wrong");
  assert.equal(again().tries, 1);
  assert.equal(isCurrent(entry, store.get().draft), true);
  answering.type(0, "phi = 1");
  assert.equal(isCurrent(entry, store.get().draft), false);
});

test("a server that does not answer takes nothing away", async () => {
  const { store, answering, again } = pageWith({ "/checks": new ApiError({ title: "", detail: "", problems: [], status: 0 }), "/checks/reading": new ApiError({ title: "", detail: "", problems: [], status: 0 }) });
  answering.type(0, "phi = 0");
  await answering.check();
  assert.equal(store.get().trouble?.status, 0);
  assert.equal(store.get().busy, "");
  assert.deepEqual(again().texts.latex, ["phi = 0"]);
});

test("an empty answer is not sent", async () => {
  const { store, sent, answering } = pageWith({});
  await answering.check();
  assert.equal(store.get().notice, "homework.empty");
  assert.deepEqual(sent, []);
});

test("a reading taken by hand is written out, and read again", async () => {
  const { store, entry, answering, again, sent } = pageWith({ "/checks/reading": { latex: "x", plain: "x", problems: [], readings: [] } });
  answering.type(0, "m g/2l");
  answering.reread({ latex: "\\frac{mg}{2\\ell}", plain: "m*g/(2*l)", taken: false });
  assert.deepEqual(partsIn(entry, store.get().draft), ["\\frac{mg}{2\\ell}"]);
  assert.deepEqual(again().texts.latex, ["\\frac{mg}{2\\ell}"]);
  await new Promise((done) => setTimeout(done, 400));
  assert.equal(sent.at(-1)?.[1].answer.value, "\\frac{mg}{2\\ell}");
});

test("from formula to text and back: what was typed comes back to the letter", async () => {
  const { store, entry, answering, switchTo, sent } = pageWith({ "/checks/reading": { latex: "\\ddot{q}_2 = 0", plain: "ddot(phi) = 0", problems: [] } });
  answering.type(0, "\\ddot{q}_2=0 ");
  await switchTo("plain");
  assert.deepEqual(partsIn(entry, store.get().draft), ["ddot(phi) = 0"]);
  const before = sent.length;
  await switchTo("latex");
  assert.deepEqual(partsIn(entry, store.get().draft), ["\\ddot{q}_2=0 "]);
  assert.equal(sent.length, before);
});

test("what cannot be read stays on its side", async () => {
  const { store, entry, answering, switchTo } = pageWith({ "/checks/reading": { latex: "", plain: "", problems: [{ code: "syntax", offset: 0, length: 1, message: "" }] } });
  answering.type(0, "\\frac{");
  await switchTo("plain");
  assert.equal(store.get().notice, "homework.kept-latex");
  assert.deepEqual(partsIn(entry, store.get().draft), [""]);
  await switchTo("latex");
  assert.deepEqual(partsIn(entry, store.get().draft), ["\\frac{"]);
});

const SHEET = { format: 1, individual: true, tasks: [{ scene: "pendulum", task: "lagrangian", points: 4 }, { scene: "atwood", task: "momentum:y" }] };

test("a file in base64, whatever its bytes are and however many", () => {
  for (const length of [0, 1, 2, 3, 100_000]) {
    const bytes = Uint8Array.from({ length }, (_, n) => (n * 7) % 256);
    assert.equal(base64(bytes).join(""), Buffer.from(bytes).toString("base64"));
    assert.ok(base64(bytes).every((piece) => piece.length <= 10_000));
  }
});

/** A server that says this of a table, in pieces of this many bytes. @param {string} said @param {any[]} asked @param {number} [size] @returns {typeof fetch} */
const saying = (said, asked, size = 7) => async (path, options) => {
  asked.push([path, JSON.parse(String(options?.body)), options?.signal]);
  const bytes = new TextEncoder().encode(said);
  const pieces = Array.from({ length: Math.ceil(bytes.length / size) }, (_, n) => bytes.slice(n * size, (n + 1) * size));
  return new Response(new ReadableStream({ pull: (stream) => (pieces.length ? stream.enqueue(pieces.shift()) : stream.close()) }));
};
const event = (/** @type {string} */ kind, /** @type {object} */ data) => `event: ${kind}\ndata: ${JSON.stringify(data)}\n\n`;
const TOTALS = { points: 2, of: 2, tasks: [], students: [{ student: "Zoë", points: 2, of: 2, answers: [] }], mistakes: [] };
const ROWS = [event("begun", { rows: 2 }), event("row", { index: 1, student: "Zoë" }), event("waiting", { seconds: 3 }), event("row", { index: 0 })].join("");

/** @param {typeof fetch} send @param {object} [more] */
const classOf = (send, more) => createClassroom({ send, state: () => /** @type {any} */ ({ asked: { place: { lang: "en" } }, assignment: null, entry: null, ...more }), questions: async () => null });
const sentOf = (/** @type {any[]} */ [[path, body]]) => [path, body];

test("a class: the file goes to the server as it is, and its rows, totals and table of results are kept", async () => {
  const asked = /** @type {any[]} */ ([]);
  const session = classOf(saying(ROWS + event("result", { ...TOTALS, csv: "\ufeffstudent\n" }), asked), { entry: { reference: { scene: "swing", seed: "ada" } } });
  await session.grade("class.csv", Uint8Array.from([0xff, 0xfe, 0x00]));
  assert.deepEqual(sentOf(asked), ["/api/v1/checks/table", { table: ["//4A"], encoding: "base64", scene: "swing", lang: "en" }]);
  const { rows, totals, csv, running, waiting, failure, total } = session.get();
  assert.deepEqual([rows.map(({ index }) => index), totals, csv, running, waiting, failure, total], [[1, 0], TOTALS, "\ufeffstudent\n", false, 0, null, 2]);
});

test("a class is marked by the assignment that is open", async () => {
  const asked = /** @type {any[]} */ ([]);
  await classOf(saying(ROWS, asked), { assignment: SHEET, entry: { reference: { scene: "swing" } } }).grade("class.csv", new Uint8Array());
  assert.deepEqual(sentOf(asked)[1], { table: [""], encoding: "base64", assignment: SHEET, lang: "en" });
});

for (const [name, said, status, count] of /** @type {const} */ ([
  ["that breaks off", ROWS, 0, 2], ["with a problem", ROWS + event("problem", { status: 504, title: "too large" }), 504, 2], ["with a problem at once", event("problem", { status: 500 }), 500, 0],
])) test(`a class: of a stream ${name} the rows stay, and the failure is told`, async () => {
  const session = classOf(saying(said, []));
  await session.grade("class.csv", new Uint8Array());
  const { rows, failure, running, csv } = session.get();
  assert.deepEqual([rows.length, failure?.status, running, csv], [count, status, false, null]);
});

test("a class: whoever stops, or opens another file, gives up the first", async () => {
  const signals = /** @type {AbortSignal[]} */ ([]);
  /** @type {typeof fetch} */
  const hanging = (_, options) => {
    const signal = /** @type {AbortSignal} */ (options?.signal);
    signals.push(signal);
    return new Promise((_, fail) => signal.addEventListener("abort", () => fail(signal.reason)));
  };
  const session = classOf(hanging);
  const first = session.grade("first.csv", new Uint8Array());
  const second = session.grade("second.csv", new Uint8Array());
  await first;
  assert.deepEqual([signals.map(({ aborted }) => aborted), session.get().name, session.get().running], [[true, false], "second.csv", true]);
  session.stop();
  await second;
  assert.deepEqual([signals[1].aborted, session.get().running, session.get().failure], [true, false, null]);
});

test("a busy server is asked again, any other failure is not", async () => {
  const failing = (/** @type {number[]} */ ...statuses) => patient(async () => {
    const status = statuses.shift();
    if (status) throw new ApiError({ title: "", detail: "", problems: [], status });
    return "answer";
  }, async () => {});
  assert.equal(await failing(503, 429)(), "answer");
  await assert.rejects(failing(422)(), ApiError);
  await assert.rejects(failing(503, 503, 503, 503, 503)(), ApiError);
});

test("a task chosen while others' values are fetched stays chosen", async () => {
  const answer = (/** @type {string} */ seed) => ({ scene: { ...scene, id: "swing" }, symbols, tasks: ["lagrangian", "equation:phi"].map((id) => ({ ...task, id, title: seed })) });
  let respond = /** @type {(answer: any) => void} */ (() => {});
  const post = async (/** @type {string} */ path, /** @type {any} */ body) => (path === "/tasks" && body.seed ? new Promise((done) => { respond = done; }) : path === "/tasks" ? answer("") : null);
  const api = /** @type {any} */ ({ post, scenes: async () => ({ scenes: [] }), simulate: async () => trajectory });
  const store = createStore(begin(readAsked("?scene=swing&lang=en")));
  const progress = createProgress(storage());
  const exercise = createExercise(store, api, progress, createAnswering(store, api, progress));
  await exercise.start(store.get().asked, null, null);
  const loading = exercise.individual("ada");
  exercise.show(/** @type {any} */ (store.get().sheet?.entries[1]));
  respond(answer("ada"));
  await loading;
  assert.deepEqual([store.get().entry?.key, store.get().asked.task], ["swing@ada/equation:phi", "equation:phi"]);
});

test("of two files that are opened one after the other the last one is on the page, however late the first one's tasks come, or its failure", async () => {
  /** @type {Record<string, {done: (answer: any) => void, fail: (error: any) => void}>} */
  const asked = {};
  const post = (/** @type {string} */ path, /** @type {any} */ body) => (path === "/assignments" ? new Promise((done, fail) => { asked[body.assignment.title.en] = { done, fail }; }) : Promise.resolve(null));
  const api = /** @type {any} */ ({ post, simulate: async () => trajectory });
  const store = createStore(begin(readAsked("?lang=en")));
  const progress = createProgress(storage());
  const exercise = createExercise(store, api, progress, createAnswering(store, api, progress));
  const named = (/** @type {string} */ en) => ({ format: 1, title: { en }, tasks: [{ scene: "swing", task: "lagrangian" }] });
  const answer = (/** @type {string} */ en) => ({ title: { en }, follow_through: 0.5, tasks: [{ scene, symbols, task: { ...task, id: "lagrangian" } }] });
  const loading = ["broken", "first", "second"].map((name) => exercise.assign(named(name)));
  asked.second.done(answer("second"));
  asked.first.done(answer("first"));
  asked.broken.fail(new ApiError({ title: "refused", detail: "", problems: [], status: 422 }));
  await Promise.all(loading);
  assert.deepEqual([store.get().sheet?.title, store.get().failure], [{ en: "second" }, null]);
});

test("a check that fails late says nothing of another task, and does not end the check of that one", async () => {
  /** @type {((error: any) => void)[]} */
  const checks = [];
  const tasks = ["lagrangian", "equation:phi"].map((id) => ({ ...task, id }));
  const post = (/** @type {string} */ path) => (path === "/checks" ? new Promise((_, fail) => checks.push(fail)) : Promise.resolve(path === "/tasks" ? { scene, symbols, tasks } : null));
  const api = /** @type {any} */ ({ post, scenes: async () => ({ scenes: [] }), simulate: async () => trajectory });
  const store = createStore(begin(readAsked("?scene=swing&lang=en")));
  const progress = createProgress(storage());
  const answering = createAnswering(store, api, progress);
  const exercise = createExercise(store, api, progress, answering);
  await exercise.start(store.get().asked, null, null);
  const checked = [0, 1].map((index) => {
    exercise.show(/** @type {any} */ (store.get().sheet?.entries[index]));
    answering.type(0, "1");
    return answering.check();
  });
  const failure = { title: "broken", detail: "", problems: [], status: 500 };
  checks[0](new ApiError(failure));
  await checked[0];
  assert.deepEqual([store.get().trouble, store.get().busy], [null, "checking"]);
  checks[1](new ApiError(failure));
  await checked[1];
  assert.deepEqual([store.get().trouble, store.get().busy], [failure, ""]);
});

test("no key stands alone in its row", () => {
  const counts = Array.from({ length: 50 }, (_, i) => i + 2);
  assert.deepEqual(counts.filter((count) => count % columnsFor(count) === 1), []);
  assert.deepEqual(counts.filter((count) => inRows(Array(count).fill(0), 8).some((row) => row.length < 2 || row.length > 8)), []);
  assert.deepEqual(inRows([1, 2, 3, 4, 5], 3), [[1, 2, 3], [4, 5]]);
});

test("a solution is shown by the first of its steps that the derivation has, else by the last one of its chapter", () => {
  const chapters = /** @type {any} */ ([{ id: "a", steps: [{ id: "a1" }, { id: "a2" }] }, { id: "b", steps: [{ id: "b1" }] }, { id: "c", steps: [] }]);
  const shown = (/** @type {string} */ chapter, /** @type {string[]} */ ...steps) => stepOf(chapters, { chapter, steps })?.id;
  assert.equal(shown("a", "x", "b1", "a1"), "b1");
  assert.equal(shown("a", "x"), "a2");
  assert.equal(shown("c"), undefined);
});

for (const [name, latex, backward, wanted] of /** @type {[string, string, boolean, {latex: string, shift: number} | null][]} */ ([
  ["nothing is broken", String.raw`\sin\left(q_2\right)`, true, null],
  ["from the right the caret steps in", String.raw`\sin\left(q_2\right.+1`, true, { latex: String.raw`\sin\left(q_2\right)+1`, shift: 0 }],
  ["from within the pair goes", String.raw`\sin\left.x\right)\delta x`, true, { latex: String.raw`\sin x\delta x`, shift: -1 }],
  ["the inner pair of two", String.raw`\left(a+\left.b\right]\right)`, true, { latex: String.raw`\left(a+b\right)`, shift: -1 }],
  ["forwards from the left the caret steps in", String.raw`\left.x\right]`, false, { latex: String.raw`\left[x\right]`, shift: 0 }],
  ["forwards from within the pair goes", String.raw`\left(x\right.y`, false, { latex: "xy", shift: -1 }],
]))
  test(`a bracket is deleted: ${name}`, () => assert.deepEqual(paired(latex, backward), wanted));

test("each task is a place of its own in the browser's history, and a sheet on its way is none", () => {
  /** @type {string[]} */
  const calls = [];
  const place = { pathname: "/homework", search: "", hash: "" };
  const go = (/** @type {string} */ kind) => (/** @type {unknown} */ _, /** @type {string} */ __, /** @type {string | URL | null | undefined} */ to) => {
    calls.push(`${kind} ${to}`);
    place.search = String(to).replace("/homework", "");
  };
  const trail = createTrail({ pushState: go("push"), replaceState: go("replace") }, place);
  trail("/homework?lang=en", "");
  trail("/homework?task=a", "a");
  trail("/homework?task=a", "a");
  trail("/homework?task=a&theme=dark", "a");
  trail("/homework?task=", "");
  trail("/homework?task=b", "b");
  place.search = "?task=a";
  trail("/homework?task=a", "a");
  trail("/homework?task=c", "c");
  assert.deepEqual(calls, ["replace /homework?lang=en", "replace /homework?task=a", "replace /homework?task=a&theme=dark", "push /homework?task=b", "push /homework?task=c"]);
});
