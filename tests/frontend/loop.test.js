/** From the sheet to the table of a class: what a teacher picks, what is handed in, what is dropped, and long tables. */

import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import assert from "node:assert/strict";
import { ApiError } from "../../frontend/model/api.js";
import { assignmentIn } from "../../frontend/model/homework/assignment.js";
import { createClassroom, heard } from "../../frontend/model/homework/classroom.js";
import { answersOf, createWho, fileName, gathered, handIn } from "../../frontend/model/homework/handin.js";
import { bounded, createPicker, instantOf, localOf, written } from "../../frontend/model/homework/picker.js";
import { readAsked } from "../../frontend/model/homework/place.js";
import { BLANK, createProgress } from "../../frontend/model/homework/progress.js";
import { ALL, arranged, chosen, paged, USUAL } from "../../frontend/model/homework/roster.js";
import { checksum, unzipped, zipped } from "../../frontend/model/homework/zip.js";

const bytesOf = (/** @type {string} */ text) => new TextEncoder().encode(text);
const textOf = (/** @type {Uint8Array | null} */ bytes) => bytes && new TextDecoder().decode(bytes);

function storage() {
  const kept = new Map();
  return {
    getItem: (/** @type {string} */ key) => kept.get(key) ?? null,
    setItem: (/** @type {string} */ key, /** @type {string} */ value) => void kept.set(key, value),
    key: (/** @type {number} */ index) => [...kept.keys()][index] ?? null,
    get length() {
      return kept.size;
    },
  };
}

test("the checksum of an archive is the one that all programs know", () => {
  assert.equal(checksum(bytesOf("123456789")), 0xcbf43926); // the check value of CRC-32/ISO-HDLC
});

test("what is packed is unpacked, by another program too", async () => {
  const files = [["a.json", '{"a": 1}'], ["Größe/ü 李.json", "x".repeat(100_000)], ["empty", ""]];
  const packed = await zipped(files.map(([name, text]) => ({ name, bytes: bytesOf(text) })));
  const found = await unzipped(packed, 1_000_000);
  assert.deepEqual(found.map(({ name, bytes }) => [name, textOf(bytes)]), files);
  const file = join(mkdtempSync(join(tmpdir(), "zip-")), "class.zip");
  writeFileSync(file, packed);
  const script = "import sys, zipfile, json; z = zipfile.ZipFile(sys.argv[1]); print(z.testzip(), json.dumps([[n, len(z.read(n))] for n in z.namelist()]))";
  assert.equal(execFileSync("python3", ["-c", script, file], { encoding: "utf8" }).trim(), `None ${'[["a.json", 8], ["Gr\\u00f6\\u00dfe/\\u00fc \\u674e.json", 100000], ["empty", 0]]'}`);
});

test("files that another program stored as they are", async () => {
  const file = join(mkdtempSync(join(tmpdir(), "zip-")), "class.zip");
  const script = "import sys, zipfile; z = zipfile.ZipFile(sys.argv[1], 'w'); z.writestr('a', 'x'); z.writestr('d/', ''); z.writestr('b', 'x' * 2000); z.close()";
  execFileSync("python3", ["-c", script, file]);
  const found = await unzipped(new Uint8Array(readFileSync(file)), 1000);
  assert.deepEqual(found.map(({ name, bytes }) => [name, textOf(bytes)]), [["a", "x"], ["b", null]]);
});

test("an archive that is cut, flipped or a bomb throws no more than itself away", async () => {
  const packed = await zipped([{ name: "bomb", bytes: new Uint8Array(5_000_000) }, { name: "b", bytes: bytesOf("b") }]);
  assert.deepEqual((await unzipped(packed, 1000)).map(({ name, bytes }) => [name, textOf(bytes)]), [["bomb", null], ["b", "b"]]);
  await assert.rejects(unzipped(packed.slice(0, -30), 1000), RangeError);
  for (let at = 0; at < packed.length; at += 97) {
    const broken = packed.map((byte, i) => (i === at ? byte ^ 255 : byte));
    await unzipped(broken, 1000).catch((error) => assert.ok(error instanceof RangeError, String(error)));
  }
});

test("all that is dropped is one archive; what is too long, or broken, comes as such by its name", async () => {
  const inner = new File([/** @type {BlobPart} */ (await zipped([{ name: "folder/a.json", bytes: bytesOf("{}") }]))], "moodle.zip");
  const files = [new File(["{}"], "b.json"), inner, new File([Uint8Array.from({ length: 1_000_000 }, (_, n) => (n * n * 7919) >> 5)], "big.json"), new File(["PK\x03\x04 no"], "broken.zip")];
  const { bytes, count, broken } = await gathered(files);
  const found = await unzipped(bytes, 100_000);
  assert.deepEqual([count, broken], [3, ["broken.zip"]]);
  assert.deepEqual(found.map(({ name }) => name), ["b.json", "folder/a.json", "big.json"]);
  assert.deepEqual([textOf(found[1].bytes), (found[2].bytes?.length ?? 0) > 65_536], ["{}", true]);
  assert.ok(bytes.length < 1000);
});

test("pictures and megabytes of noise leave room for those who handed in", async () => {
  let state = 7;
  const noise = (/** @type {number} */ length) => Uint8Array.from({ length }, () => (state = (state * 1103515245 + 12345) % 2147483648) >> 16);
  const pictures = Array.from({ length: 40 }, (_, n) => new File([noise(60_000)], `${n}.png`));
  const braces = Array.from({ length: 40 }, (_, n) => new File(["{", noise(60_000)], `${n}.json`));
  const good = new File([`{"a": "${"x".repeat(5000)}"}`], "good.json");
  const { bytes } = await gathered([...pictures, ...braces, good]);
  const found = await unzipped(bytes, 100_000);
  assert.ok(bytes.length < 700_000, String(bytes.length));
  assert.deepEqual([found.length, found.at(-1)?.bytes?.length], [81, 5009]);
});

const scene = { coordinates: [{ name: "phi" }], guides: [] };
const entries = /** @type {any[]} */ (["kinetic-energy", "lagrangian", "equation:phi"].map((id, n) => ({ id: String(n + 1), key: `g/${id}`, group: "g", scene, task: { id, form: "expression", components: null } })));

test("what is handed in: the answer to each task, else the last line of the working that answers it", () => {
  const progress = createProgress(storage());
  progress.write("g/kinetic-energy", { ...BLANK, syntax: "plain", texts: { plain: ["T"], latex: ["L"] } });
  progress.write("g/lagrangian", { ...BLANK, texts: { plain: ["not this"], latex: [" "] } });
  progress.write("g/~working", [{ task: "lagrangian", syntax: "plain", value: "first" }, { task: "lagrangian", syntax: "plain", value: "last" }, { task: "kinetic-energy", syntax: "plain", value: "no" }, { task: "lagrangian", syntax: "latex", value: " " }]);
  assert.deepEqual(answersOf(entries, progress), [{ task: 1, syntax: "plain", value: "T" }, { task: 2, syntax: "plain", value: "last" }]);
  const who = createWho(progress);
  who.set({ name: "Zoë", id: "7" });
  assert.deepEqual(JSON.parse(handIn("AB-CD", who.get(), answersOf(entries, progress), new Date(0))), {
    format: "deltaq-handin-1", sheet: "AB-CD", student: "Zoë", id: "7", time: "1970-01-01T00:00:00.000Z",
    answers: [{ task: 1, syntax: "plain", value: "T" }, { task: 2, syntax: "plain", value: "last" }],
  });
});

test("whoever was never asked has no name, and a name makes a plain file name", () => {
  assert.deepEqual(createWho(createProgress(storage())).get(), { name: "", id: "" });
  assert.equal(fileName("Blatt 3: Größe", "../O'Hara\\\n"), "blatt-3-größe-o-hara");
});

/** @param {string} name @param {number} points @param {object} [more] @returns {any} */
const student = (name, points, more) => ({ student: name, id: "", points, of: 3, late: 0, beyond: 0, answers: [{ outcome: "correct", points }, null], ...more });
const CLASS = [student("Zoe 10", 1), student("ada", 3, { late: 1, id: "77" }), student("Ärger", 2, { beyond: 1, answers: [{ outcome: "invalid", points: 2 }, { outcome: "wrong", points: 0 }] }), student("Zoe 9", 1)];
const names = (/** @type {object} */ order) => arranged(CLASS, { ...USUAL, ...order }, "de").map((one) => one.student);

test("students in the order that is wanted", () => {
  assert.deepEqual(names({}), ["ada", "Ärger", "Zoe 9", "Zoe 10"]);
  assert.deepEqual(names({ by: "points", down: true }), ["ada", "Ärger", "Zoe 10", "Zoe 9"]);
  assert.deepEqual(names({ by: 1 }), ["Zoe 10", "ada", "Zoe 9", "Ärger"]);
});

for (const [order, wanted] of /** @type {[object, string[]][]} */ ([
  [{ text: " ZOE" }, ["Zoe 9", "Zoe 10"]],
  [{ text: "77" }, ["ada"]],
  [{ only: "late" }, ["ada"]],
  [{ only: "beyond" }, ["Ärger"]],
  [{ only: "unread" }, ["Ärger"]],
  [{ only: "missing" }, ["ada", "Zoe 9", "Zoe 10"]],
  [{ only: "late", text: "zoe" }, []],
]))
  test(`students found: ${JSON.stringify(order)}`, () => assert.deepEqual(names(order), wanted));

test("answers found, and turned page by page", () => {
  const rows = /** @type {any[]} */ (Array.from({ length: 60 }, (_, index) => ({ index: 59 - index, student: `s${59 - index}`, id: "", file: "", answer: "T", outcome: index % 2 ? "wrong" : "correct", scene: "p", task: "t", mistake: index % 2 ? "Sign" : "" })));
  const indices = (/** @type {object} */ wanted) => chosen(rows, { ...ALL, ...wanted }).map(({ index }) => index);
  assert.deepEqual(indices({}), Array.from({ length: 60 }, (_, n) => n));
  assert.deepEqual([indices({ outcome: "wrong", mistake: "Sign", task: "p/t" }).length, indices({ task: "p/u" }).length, indices({ text: "s7" }).length], [30, 0, 1]);
  const { rows: shown, page, pages, first } = paged(rows, 9, 25);
  assert.deepEqual([shown.length, page, pages, first], [10, 2, 3, 50]);
  assert.deepEqual([paged([], 3, 25).pages, paged([], 3, 25).page], [1, 0]);
});

test("files that could not be taken are kept, and the points for the platforms", () => {
  const session = createClassroom({ send: fetch, state: () => /** @type {any} */ ({}), questions: async () => null });
  const totals = { points: 0, of: 0, tasks: [], students: [], mistakes: [] };
  const known = heard({ ...session.get(), refused: [{ file: "z.zip", why: "broken" }] }, /** @type {any} */ ([
    { kind: "begun", data: { rows: 0 } },
    { kind: "refused", data: { files: [{ file: "a", why: "no name" }] } },
    { kind: "result", data: { ...totals, csv: "x", moodle: "m", canvas: "c" } },
  ]));
  assert.deepEqual([known.refused.map(({ file }) => file), known.platforms], [["z.zip", "a"], { moodle: "m", canvas: "c" }]);
});

const TASKS = { scene: { title: { en: "Pendulum" } }, symbols: [], tasks: [{ id: "kinetic-energy", points: 2, title: "T" }, { id: "equation:phi", points: 3, title: "E" }] };

/** @param {{assignment?: any, refuse?: boolean, keeper?: ReturnType<typeof storage>}} [around] */
function picking({ assignment = null, refuse = false, keeper = storage() } = {}) {
  const sent = /** @type {[string, any][]} */ ([]);
  const post = async (/** @type {string} */ path, /** @type {any} */ body) => {
    sent.push([path, body]);
    if (refuse && path === "/assignments") throw new ApiError({ status: 422, title: "wrong", detail: "", problems: [] });
    return path === "/tasks" ? TASKS : { code: `C${body.assignment.tasks.length}` };
  };
  const state = /** @type {any} */ ({ asked: readAsked("?lang=en&scene=pendulum"), assignment, own: null });
  return { session: createPicker(/** @type {any} */ ({ post }), () => state, keeper), sent, keeper };
}
const settled = () => new Promise((done) => setTimeout(done, 900));

test("a sheet is picked, weighed, put in order, and becomes an address that holds no solution", async () => {
  const { session, sent } = picking();
  await session.arrive();
  session.add(/** @type {any} */ (TASKS.tasks));
  session.add(/** @type {any} */ ([TASKS.tasks[0]]));
  session.move(1, -1);
  session.move(0, -1);
  session.weigh(0, 4.5);
  session.remove(2);
  await session.arrive();
  session.change({ title: "Sheet 1", late: 0.5, attempts: null });
  await settled();
  const made = { format: 1, title: "Sheet 1", individual: false, follow_through: 0.5, late: 0.5, tasks: [{ scene: "pendulum", task: "equation:phi", points: 4.5 }, { scene: "pendulum", task: "kinetic-energy", points: 2 }] };
  assert.deepEqual(JSON.parse(session.file()), made);
  assert.equal(session.get().code, "C2");
  assert.deepEqual(await assignmentIn(session.get().fragment, "", /** @type {any} */ ({}), "en"), made);
  assert.deepEqual(sent.filter(([path]) => path === "/tasks").length, 1);
});

test("what the server finds wrong with a sheet is told, and it gets no address", async () => {
  const { session } = picking({ refuse: true });
  session.add(/** @type {any} */ (TASKS.tasks));
  await settled();
  assert.deepEqual([session.get().wrong?.status, session.get().fragment], [422, ""]);
  session.clear();
  assert.deepEqual([session.get().wrong, session.get().sheet.tasks], [null, []]);
});

test("a sheet in the making is there again after a reload; one that is open comes before it", async () => {
  const { session, keeper } = picking();
  session.add(/** @type {any} */ ([TASKS.tasks[1]]));
  assert.deepEqual(picking({ keeper }).session.get().sheet.tasks.map(({ task }) => task), ["equation:phi"]);
  const open = { format: 1, tasks: [{ scene: "atwood", task: "lagrangian" }] };
  assert.deepEqual(picking({ keeper, assignment: open }).session.get().sheet, open);
  keeper.setItem("deltaq.sheet.1", "{broken");
  assert.deepEqual(picking({ keeper }).session.get().sheet.tasks, []);
  await settled();
});

test("numbers and times as they are typed", () => {
  assert.deepEqual(["2,5", " 7 ", "-1", "2000", "x", ""].map((text) => bounded(text, 0, 1000)), [2.5, 7, 0, 1000, null, null]);
  assert.equal(bounded("0", 0, 10), 0);
  assert.equal(localOf(instantOf("2026-11-30T23:59")), "2026-11-30T23:59");
  assert.deepEqual([instantOf(""), instantOf("soon"), localOf(null), localOf("soon")], [null, null, "", ""]);
  assert.deepEqual(written(/** @type {any} */ ({ format: 1, title: "", deadline: null, late: 0, tasks: [] })), { format: 1, late: 0, tasks: [] });
});
