import { strict as assert } from "node:assert";
import { test } from "node:test";
import { createReceiver, createSender, isId } from "../../frontend/model/lecture/link.js";
import { keepNotes, noteOf, readNotes, withNote } from "../../frontend/model/lecture/notes.js";
import { better, bounds, filling, formulaOf, laidOut, larger } from "../../frontend/model/lecture/filling.js";
import { numberedIn, numberingBy } from "../../frontend/model/lecture/numbering.js";
import { premisesOf, shortForm } from "../../frontend/model/lecture/premises.js";
import { allOrNone, isConcluded, meant, onwards, partsOf, within } from "../../frontend/model/lecture/stops.js";
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
  ["after the last substep the result", { step: "b", part: 3 }, 1, "substeps", { step: "b", part: 4 }],
  ["after the result the next step, from its first substep", { step: "b", part: 4 }, 1, "substeps", { step: "c", part: 1 }],
  ["back to a step as it was left", { step: "c", part: 0 }, -1, "substeps", { step: "b", part: 4 }],
  ["an unknown step is the first", { step: "?", part: 0 }, 1, "", { step: "b", part: 0 }],
];

for (const [name, at, by, pace, stop] of WAYS) test(`a lecture goes on: ${name}`, () => assert.deepEqual(onwards(lines, at, by, pace), stop));

test("without steps a lecture stays where it is", () => assert.deepEqual(onwards([], { step: "x", part: 1 }, 1, ""), { step: "x", part: 1 }));

test("substeps of one step come and go, all at once if wanted", () => {
  assert.deepEqual(within(lines, { step: "b", part: 1 }, 1), { step: "b", part: 2 });
  assert.deepEqual(within(lines, { step: "b", part: 99 }, 0), { step: "b", part: 4 });
  assert.deepEqual(within(lines, { step: "a", part: 0 }, 1), { step: "a", part: 0 });
  assert.deepEqual(allOrNone(lines, { step: "b", part: 1 }), { step: "b", part: 4 });
  assert.deepEqual(allOrNone(lines, { step: "b", part: 4 }), { step: "b", part: 0 });
});

test("the result of a step is there alone or after its substeps, and never among them", () => {
  assert.deepEqual([0, 1, 2, 3, 4].map((part) => isConcluded(lines[1].step, part)), [true, false, false, false, true]);
  assert.equal(isConcluded(lines[0].step, 0), true);
});

/** @param {string} latex @param {number} [share] */
const formula = (latex, share = 1) => formulaOf({ latex, share });
const SUM = Array.from({ length: 12 }, (_, i) => `a_{${i}} b_{${i}}`).join(" + ");

test("a short formula grows to seven percent of the screen and no further", () => {
  for (const [height, width] of [[768, 1366], [2160, 3840]]) {
    const { size, far } = filling([formula("L = E - V")], { width: 0.6 * width, height: 0.6 * height }, height);
    assert.ok(Math.abs(size - 0.07 * height) < 1);
    assert.ok(far);
  }
});

test("formulas fill their pane and do not stand over it", () => {
  for (const [width, height] of [[840, 500], [640, 300], [330, 250], [1700, 900]]) {
    const formulas = [formula(`x &= ${SUM}`), formula("y = \\frac{a}{b}", 0.7)];
    const { size } = filling(formulas, { width, height }, height * 1.5);
    const high = formulas.reduce((sum, one) => sum + laidOut(one, size, width).height, 0);
    assert.ok(high <= height && high > 0.5 * height, `${high} of ${height}`);
  }
});

test("more room hardly ever makes a formula smaller, however its rows are broken", () => {
  let last = 0;
  for (let width = 300; width < 1600; width += 50) {
    const { size, close } = filling([formula(`x = ${SUM}`)], { width, height: 0.5 * width }, 900);
    const reached = size * laidOut(formula(`x = ${SUM}`), size, width, close).part;
    assert.ok(reached >= 0.88 * last, `${reached} after ${last} at ${width}`);
    last = reached;
  }
});

test("without room formulas stay legible, on a phone, too", () => {
  const { size, far } = filling([formula(SUM)], { width: 300, height: 10 }, 360);
  assert.equal(size, bounds(360).least);
  assert.equal(size, 15);
  assert.equal(far, false);
});

test("equations stand beside each other only where they are read from the last row by that, or are larger", () => {
  const many = [formula(`\\begin{aligned}${Array.from({ length: 9 }, (_, i) => `x_{${i}} &= ${i}`).join(" \\\\ ")}\\end{aligned}`)];
  const [wide, low] = [{ width: 1200, height: 260 }, { width: 1200, height: 700 }].map((pane) => filling(many, pane, 768));
  assert.deepEqual([wide.close, wide.far, low.close, low.far], [true, true, false, true]);
  assert.equal(filling([formula(SUM)], { width: 300, height: 300 }, 768).close, false);
});

test("of two arrangements the first that is read from the last row is taken, else the larger", () => {
  const of = (/** @type {number} */ reached, /** @type {boolean} */ far) => ({ size: reached, reached, far, close: false });
  const [near, far, farther] = [of(20, false), of(40, true), of(50, true)];
  assert.deepEqual([better(far, farther), better(near, far), better(near, of(30, false)).reached, larger(far, farther), larger(of(49.9, true), farther).reached], [far, far, 30, farther, 49.9]);
});

/** @type {[string, string, string][]} */
const SHORT = [
  ["the end of a chain", "\\begin{aligned}E &= \\frac{m}{2} v^2 \\\\[0.4em] &= 2 m \\end{aligned}", "E & = 2 m"],
  ["what follows from an equation", "\\begin{aligned}& a = b \\\\ \\;\\Longleftrightarrow\\; & c = 0\\end{aligned}", "c = 0"],
  ["each of several results", "\\begin{aligned}Q_1 &= a \\\\ Q_2 &= b\\end{aligned}", "Q_1 & = a,\\quad Q_2 & = b"],
  ["its beginning where its end is long", `\\begin{aligned}L &= E - V \\\\ &= ${SUM} + ${SUM}\\end{aligned}`, "L & = E - V"],
  ["nothing where all is long", `x = ${SUM} + ${SUM}`, ""],
  ["nothing of words", "", ""],
];
for (const [name, latex, short] of SHORT)
  test(`the short form of a formula: ${name}`, () => assert.equal(shortForm(latex).replaceAll("&", "").replace(/\s+/g, " ").trim(), short.replaceAll("& ", "")));

test("a step rests on the steps before it, also on those of its substeps, but not on its own", () => {
  const of = (/** @type {string} */ id, /** @type {string[]} */ premises, /** @type {any[]} */ substeps = []) => ({ id, latex: `${id[0]} = 1`, premises, substeps });
  const derived = linesOf([{ id: "x", title: "X", steps: /** @type {any[]} */ ([of("a", [], [of("a1", [])]), of("b", []), of("c", ["c1"], [of("c1", ["a1", "later"])]), of("later", [])]) }]);
  assert.deepEqual(premisesOf(derived, derived[2]).map(({ step, line, latex }) => [step.id, line.number, latex.trim()]), [["a1", "1.1", "a = 1"]]);
  assert.deepEqual(premisesOf(derived, derived[1]), []);
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
  const sender = createSender(lecture, { here: () => ({ place, overlay: "", title: {}, bodies: [], chapters }), wish: (wish) => wishes.push(wish) });
  const receiver = createReceiver(presenter, (here) => heard.push(here));
  assert.deepEqual(heard.pop(), { kind: "here", place, overlay: "", title: {}, bodies: [], chapters });
  place = { step: "b" };
  sender.tell();
  sender.tell();
  assert.deepEqual(heard, [{ kind: "here", place, overlay: "", title: {}, bodies: [] }]);
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

const PARAMETERS = [["m", "m_{2}"], ["M", "m_1"], ["g", ""]].map(([name, latex]) => ({ name, latex }));
/** @param {string[]} masses */
const bodiesOf = (...masses) => /** @type {any} */ ({ bodies: masses.map((mass, i) => ({ name: "ab"[i], mass })), parameters: PARAMETERS });
const NAMES = /** @type {Record<string, string>} */ ({ a: "upper bob", b: "lower_bob" });

test("bodies with long names are called by the numbers of their masses, else by their order, and who is who is told", () => {
  const latex = "\\mathbf{r}_{\\text{upper bob}} + \\mathbf{F}_{\\text{weight}, \\text{lower\\_bob}}";
  const by = (/** @type {string[]} */ ...masses) => numberingBy(numberedIn(bodiesOf(...masses), (body) => NAMES[body]));
  assert.equal(by("m", "M").short(latex), "\\mathbf{r}_{2} + \\mathbf{F}_{\\text{weight}, 1}");
  assert.equal(by("m", "m").short(latex), "\\mathbf{r}_{1} + \\mathbf{F}_{\\text{weight}, 2}");
  assert.deepEqual(by("m", "M").within(["x", latex.slice(0, 35)]), [{ number: "2", name: "upper bob" }]);
});

test("a single body, or bodies with short names, are called as they are", () => {
  for (const [scene, names] of /** @type {[any, Record<string, string>][]} */ ([[bodiesOf("m"), NAMES], [bodiesOf("m", "M"), { a: "cart", b: "bob" }], [undefined, {}]])) {
    const numbering = numberingBy(numberedIn(scene, (body) => names[body]));
    assert.equal(numbering.short("\\text{upper bob} \\text{cart}"), "\\text{upper bob} \\text{cart}");
    assert.deepEqual(numbering.within(["\\text{cart}"]), []);
  }
});
