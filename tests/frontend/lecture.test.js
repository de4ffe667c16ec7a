import { strict as assert } from "node:assert";
import { test } from "node:test";
import { createReceiver, createSender, isId } from "../../frontend/model/lecture/link.js";
import { keepNotes, noteOf, readNotes, withNote } from "../../frontend/model/lecture/notes.js";
import { allOrNone, meant, onwards, partsOf, within } from "../../frontend/model/lecture/stops.js";
import { clockText, elapsed, STOPPED, toggled } from "../../frontend/model/lecture/timer.js";
import { linesOf } from "../../frontend/model/reveal.js";

/** @param {string} id @param {any[]} [substeps] @returns {any} */
const step = (id, substeps = []) => ({ id, title: `Title of ${id}`, substeps });
const lines = linesOf([
  { id: "one", title: "Configuration", steps: [step("a"), step("b", [step("b1", [step("b1x")]), step("b2")])] },
  { id: "two", title: "Energy", steps: [step("c", [step("c1")])] },
]);

test("substeps are read in order, the deeper ones after what they explain", () => {
  assert.deepEqual(partsOf(lines[1].step).map(({ step, depth }) => [step.id, depth]), [["b1", 0], ["b1x", 1], ["b2", 0]]);
});

/** @type {[string, import("../../frontend/model/lecture/stops.js").Stop, number, "" | "substeps", import("../../frontend/model/lecture/stops.js").Stop][]} */
const WAYS = [
  ["the next step", { step: "a", part: 0 }, 1, "", { step: "b", part: 0 }],
  ["the next step, whatever is shown of this one", { step: "b", part: 2 }, 1, "", { step: "c", part: 0 }],
  ["the step before", { step: "b", part: 2 }, -1, "", { step: "a", part: 0 }],
  ["held at the beginning", { step: "a", part: 0 }, -1, "", { step: "a", part: 0 }],
  ["held at the end", { step: "c", part: 0 }, 1, "", { step: "c", part: 0 }],
  ["to the end at once", { step: "a", part: 0 }, Infinity, "", { step: "c", part: 0 }],
  ["to the beginning at once", { step: "c", part: 0 }, -Infinity, "", { step: "a", part: 0 }],
  ["the first substep", { step: "b", part: 0 }, 1, "substeps", { step: "b", part: 1 }],
  ["after the last substep the next step", { step: "b", part: 3 }, 1, "substeps", { step: "c", part: 0 }],
  ["back to a step as it was left", { step: "c", part: 0 }, -1, "substeps", { step: "b", part: 3 }],
  ["an unknown step is the first", { step: "?", part: 0 }, 1, "", { step: "b", part: 0 }],
];

for (const [name, at, by, pace, stop] of WAYS) test(`a lecture goes on: ${name}`, () => assert.deepEqual(onwards(lines, at, by, pace), stop));

test("without steps a lecture stays where it is", () => assert.deepEqual(onwards([], { step: "x", part: 1 }, 1, ""), { step: "x", part: 1 }));

test("substeps of one step come and go, all at once if wanted", () => {
  assert.deepEqual(within(lines, { step: "b", part: 1 }, 1), { step: "b", part: 2 });
  assert.deepEqual(within(lines, { step: "b", part: 99 }, 0), { step: "b", part: 3 });
  assert.deepEqual(within(lines, { step: "a", part: 0 }, 1), { step: "a", part: 0 });
  assert.deepEqual(allOrNone(lines, { step: "b", part: 1 }), { step: "b", part: 3 });
  assert.deepEqual(allOrNone(lines, { step: "b", part: 3 }), { step: "b", part: 0 });
});

const MEANT = [["", "abc"], ["1.2", "b"], ["1,2", "b"], ["2", "c"], ["1.", "ab"], ["energy", "c"], ["TITLE OF B", "b"], ["9.9", ""], ["no such", ""]];
for (const [text, found] of MEANT) test(`“${text}” means ${found || "nothing"}`, () => assert.equal(meant(lines, text).map((line) => line.step.id).join(""), found));

/** Two ends of a channel within one process: what one end posts, the other hears. */
function channels() {
  const made = [0, 1].map(() => ({ onmessage: null, close() {}, posted: /** @type {any[]} */ ([]), postMessage(/** @type {any} */ _) {} }));
  made.forEach((channel, i) => {
    channel.postMessage = (message) => {
      channel.posted.push(message);
      /** @type {any} */ (made[1 - i]).onmessage?.({ data: structuredClone(message) });
    };
  });
  return made;
}

test("the presenter hears where the lecture stands, the derivation only when it is new, and may ask for more", () => {
  const [lecture, presenter] = channels();
  const chapters = /** @type {any[]} */ ([{ id: "one" }]);
  /** @type {any} */
  let place = { step: "a" };
  /** @type {any[]} */
  const [wishes, heard] = [[], []];
  const sender = createSender(lecture, { here: () => ({ place, overlay: "", title: {}, chapters }), wish: (wish) => wishes.push(wish) });
  const receiver = createReceiver(presenter, (here) => heard.push(here));
  assert.deepEqual(heard.pop(), { kind: "here", place, overlay: "", title: {}, chapters });
  place = { step: "b" };
  sender.tell();
  sender.tell();
  assert.deepEqual(heard, [{ kind: "here", place, overlay: "", title: {} }]);
  receiver.wish({ kind: "go", by: 1 });
  assert.deepEqual(wishes, [{ kind: "go", by: 1 }]);
});

test("the name of a line is of our own making", () => {
  assert.ok(isId("0a1b2c3d4e"));
  for (const strange of [null, "", "short", "<script>", "x".repeat(40)]) assert.ok(!isId(strange));
});

test("notes are kept by scene and step, and an emptied one goes", () => {
  /** @type {Record<string, string>} */
  const shelf = {};
  const keeper = { getItem: (/** @type {string} */ key) => shelf[key] ?? null, setItem: (/** @type {string} */ key, /** @type {string} */ value) => void (shelf[key] = value) };
  const notes = withNote(withNote(readNotes(keeper), "pendulum", "a", "say hello"), "pendulum", "b", "gone");
  assert.ok(keepNotes(keeper, withNote(notes, "pendulum", "b", "")));
  assert.deepEqual(readNotes(keeper), { pendulum: { a: "say hello" } });
  assert.equal(noteOf(readNotes(keeper), "pendulum", "a"), "say hello");
  assert.equal(noteOf(readNotes(keeper), "pendulum", "b"), "");
  assert.deepEqual(readNotes({ ...keeper, getItem: () => "not json" }), {});
  assert.equal(keepNotes({ ...keeper, setItem: () => { throw new Error("full"); } }, notes), false);
});

test("the lecture's time stops and goes on", () => {
  const begun = toggled(STOPPED, 1000);
  const stopped = toggled(begun, 5000);
  assert.equal(elapsed(begun, 3000), 2000);
  assert.equal(elapsed(stopped, 99_000), 4000);
  assert.equal(elapsed(toggled(stopped, 100_000), 101_000), 5000);
  assert.deepEqual([0, 61_000, 3_723_000].map(clockText), ["0:00", "1:01", "1:02:03"]);
});
