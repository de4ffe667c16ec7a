import { strict as assert } from "node:assert";
import { test } from "node:test";
import { ApiError } from "../../frontend/model/api.js";
import { curvesChart, errorChart, frameOf, pathOf, roundingLevel, sizeAt, ticksBetween } from "../../frontend/model/variations/charts.js";
import { EXAMPLES, example, exampleOf } from "../../frontend/model/variations/examples.js";
import { createLab } from "../../frontend/model/variations/lab.js";
import { bothEnds, EMPTY, endsOf, numberOf, quotientRequestOf, readQuestion, requestOf, writeQuestion } from "../../frontend/model/variations/question.js";

for (const id of EXAMPLES) {
  test(`the example ${id} returns from its address`, () => {
    const question = example(id);
    assert.deepEqual(readQuestion(`?lang=de&${writeQuestion(question)}`), question);
    assert.equal(exampleOf(question), id);
  });
}

const STRANGE = [
  ["nothing", "", null],
  ["an unknown kind", "?expression=x&kind=sum", { ...EMPTY, expression: "x" }],
  ["unknown ends", "?expression=x&ends=loose", { ...EMPTY, expression: "x" }],
  ["samples without a name", "?expression=x&samples=sin(t);:3", { ...EMPTY, expression: "x" }],
  ["a plus sign", "?expression=1%2Bx&samples=x:1%2Bt", { ...EMPTY, expression: "1+x", samples: { x: "1+t" } }],
];

for (const [name, query, question] of STRANGE) {
  test(`an address with ${name}`, () => assert.deepEqual(readQuestion(String(query)), question));
}

test("a question becomes a request", () => {
  const question = { ...example("free-end"), parameters: "m, k", direction: "v" };
  assert.deepEqual(requestOf(question, "de"), {
    expression: "dot(x)^2 + x^2", syntax: "plain", functions: ["x"], direction: ["v"], parameters: ["m", "k"],
    functional: { kind: "integral", from: "0", to: "1", ends: "fixed-free" }, lang: "de",
  });
  const { numeric, include } = quotientRequestOf({ ...question, values: { m: "1,5" } }, "de");
  assert.deepEqual(include, ["quotient"]);
  assert.deepEqual(numeric, { functions: { x: "1 - t/2" }, direction: { x: "sin(t)" }, parameters: { m: 1.5, k: 1 }, t: 1 });
});

for (const [lower, upper, word] of [["fixed", "fixed", "fixed"], ["free", "free", "free"], ["free", "fixed", "free-fixed"]]) {
  test(`ends ${lower} and ${upper}`, () => {
    assert.equal(endsOf(lower, upper), word);
    assert.deepEqual(bothEnds(word), [lower, upper]);
  });
}

test("what is no number goes as it was typed", () => {
  assert.deepEqual(["0.5", "1,5", "", "abc", " 2 "].map(numberOf), [0.5, 1.5, "", "abc", 2]);
});

const H = Array.from({ length: 65 }, (_, k) => 10 ** (-k / 4));
/** @param {number} order */
const errors = (order) => ({
  quotient: H.map((h) => 2 + h ** order), truncation: H.map((h) => h ** order), rounding: H.map((h) => 1e-16 / h),
  error: H.map((h) => h ** order + 1e-16 / h), best: null, predicted: order === 1 ? 1e-8 : null,
});
const quotient = {
  value: 1, derivative: 2, h: H, one_sided: errors(1), central: errors(2),
  curves: { t: [0, 0.5, 1], at: 0.5, functions: { x: [0, null, 1] }, direction: { x: [1, 1, 2] } },
};
const SIZE = { width: 500, height: 300, em: 10 };

test("round numbers between two", () => {
  assert.deepEqual(ticksBetween(0, 1, 5), [0, 0.2, 0.4, 0.6, 0.8, 1]);
  assert.deepEqual(ticksBetween(-0.3, 1.1, 3), [0, 0.5, 1]);
});

test("a path is broken where there is no value", () => assert.equal(pathOf([[0, 1], null, [2, 3], [4, 5]]), "M0.0 1.0M2.0 3.0L4.0 5.0"));

test("the neighbour approaches the function, on axes that stay", () => {
  const [wide, narrow] = [1, 1e-9].map((h) => curvesChart(quotient, h, SIZE));
  assert.deepEqual(wide.up, narrow.up);
  assert.equal(narrow.lines[0].d, narrow.lines[1].d);
  assert.notEqual(wide.lines[0].d, wide.lines[1].d);
  assert.equal(wide.at, (wide.frame.left + wide.frame.right) / 2);
});

test("errors lie on their laws: slope 1, slope 2, slope −1", () => {
  const { dots, optima, notes, x } = errorChart(quotient, SIZE);
  const decade = (frameOf(SIZE).right - frameOf(SIZE).left) / 16;
  const rise = (frameOf(SIZE).bottom - frameOf(SIZE).top) / 20;
  const slope = (/** @type {number} */ kind, /** @type {number} */ from, /** @type {number} */ to) => {
    const [a, b] = [dots[kind].points[4 * from], dots[kind].points[4 * to]];
    return a && b ? ((b[1] - a[1]) / rise) / ((a[0] - b[0]) / decade) : NaN;
  };
  for (const [kind, from, to, expected] of [[0, 0, 4, 1], [1, 0, 3, 2], [0, 11, 15, -1]]) assert.ok(Math.abs(slope(kind, from, to) - expected) < 0.01);
  assert.deepEqual(optima.map(({ className, x: at }) => [className, at]), [["one_sided", x(1e-8)]]);
  assert.deepEqual(notes.map(({ text }) => text), ["∝ h", "∝ h²", "∝ 1/h"]);
});

test("an error of exactly zero stands at the foot", () => {
  const exact = { ...quotient, one_sided: { ...errors(1), error: H.map(() => 0), rounding: H.map(() => 0) } };
  const { dots, rounding } = errorChart(exact, SIZE);
  assert.equal(dots[0].points[0]?.[1], frameOf(SIZE).bottom);
  assert.equal(rounding, "");
  assert.equal(roundingLevel(exact), null);
});

test("a pixel of the chart chooses h, and holds at its ends", () => {
  const { left, right } = frameOf(SIZE);
  assert.deepEqual([right, left, (left + right) / 2, right + 99, -5].map((pixel) => sizeAt(H, pixel, SIZE)), [0, 64, 32, 0, 64]);
});

const resting = (/** @type {number} */ ms) => new Promise((done) => setTimeout(done, ms));

test("the quotient is asked for after the steps, and not for a vector", async () => {
  /** @type {any[]} */
  const asked = [];
  const vary = async (/** @type {any} */ body) => (asked.push(body.include ? "quotient" : body.expression), { chapters: [], result: { first_variation: { plain: body.expression === "[x, x]" ? ["", ""] : "" } }, quotient });
  const lab = createLab({ vary, lang: () => "en" }, example("square"), 2);
  lab.again();
  await resting(20);
  assert.equal(lab.get().quotient, quotient);
  lab.begin({ ...EMPTY, expression: "[x, x]" });
  await resting(20);
  assert.deepEqual(asked, ["x^2", "quotient", "[x, x]"]);
  assert.equal(lab.get().quotient, null);
});

test("what is refused keeps the last answer and says why; a name can be declared", async () => {
  const problem = { pointer: "/expression", offset: 0, length: 1, code: "unknown-name", message: "unknown" };
  const vary = async (/** @type {any} */ body) => {
    if (!body.parameters.includes("k")) throw new ApiError({ title: "", detail: "", problems: [problem], status: 422 });
    return { chapters: [], result: { first_variation: { plain: "", latex: "" } }, quotient };
  };
  const lab = createLab({ vary, lang: () => "en" }, { ...EMPTY, expression: "k*x" }, 2);
  lab.again();
  await resting(20);
  assert.equal(lab.get().verdict, "refused");
  assert.deepEqual(lab.get().problems, [problem]);
  lab.declare("parameters", "k");
  await resting(20);
  assert.equal(lab.get().question.parameters, "k");
  assert.deepEqual([lab.get().verdict, lab.get().problems], ["answered", []]);
});
