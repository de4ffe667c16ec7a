import { strict as assert } from "node:assert";
import { createRequire } from "node:module";
import { test } from "node:test";
import { airy } from "../../frontend/model/latex.js";
import { sizeOf } from "../../frontend/model/measure.js";
import { planned } from "../../frontend/model/rows.js";

const katex = createRequire(new URL("../../frontend/package.json", import.meta.url))("katex");

/** By the metrics of KaTeX's fonts and the gaps of TeX. @type {[string, string, number][]} */
const WIDTHS = [
  ["a sum has gaps at its sign", "a + b", 2.18],
  ["a sign before it has none", "-b", 1.21],
  ["an equation has larger ones", "a = b", 2.29],
  ["a function stands off", "m \\sin\\varphi", 2.93],
  ["a fraction is as wide as its wider part", "\\frac{a b c}{2}", 1.64],
  ["an index is small", "m_1", 1.33],
  ["classes take no room", "\\htmlClass{q-0}{\\varphi}", 0.65],
  ["columns stand apart", "\\begin{bmatrix} a & b \\\\ c & d \\end{bmatrix}", 3.08],
  ["an integral stands off", "\\int_{0}^{\\ell} x \\, \\mathrm{d} x", 3.4],
  ["spaces are as wide as they say", "\\qquad\\,", 2.17],
];
for (const [name, latex, wanted] of WIDTHS) {
  test(`the width of a formula: ${name}`, () => assert.ok(Math.abs(sizeOf(latex).width / wanted - 1) < 0.08, `${sizeOf(latex).width} for ${wanted}`));
}

const HEIGHTS = [
  "\\frac{\\mathrm{d}}{\\mathrm{d} t}\\left(\\frac{\\partial L}{\\partial \\dot{\\varphi}_1}\\right)", "\\frac{1}{2} m v^2", "m^{2}", "\\ddot{\\varphi}_1",
  "\\begin{bmatrix} a & b \\\\ c & d \\end{bmatrix}", "\\begin{bmatrix} a \\\\ \\frac{a}{b} \\\\ d \\end{bmatrix}", "\\begin{bmatrix} \\frac{1}{2} a \\cos\\varphi \\\\ \\frac{1}{2} a \\sin\\varphi \\\\ \\frac{a}{b} \\end{bmatrix}", "\\left(\\frac{\\frac{a}{b}}{c}\\right)^{2}", "\\sqrt{\\frac{g}{\\ell}}",
  "\\int_{0}^{\\ell} x", "\\int_{0}^{\\frac{\\pi}{2}} x \\, \\mathrm{d} x", "\\frac{\\int_{0}^{1} x}{2}", "\\sum\\nolimits_{j} x",
];
/** What KaTeX makes of it on the page. @param {string} latex */
function setHeights(latex) {
  const [, total, below] = katex.renderToString(`{\\displaystyle ${airy(latex)}}`, { output: "html" }).match(/strut" style="height:([\d.]+)em;(?:vertical-align:-([\d.]+)em)?/);
  return { height: Number(total) - Number(below ?? 0), depth: Number(below ?? 0) };
}
for (const latex of HEIGHTS) {
  test(`how high and deep a row is: ${latex}`, () => {
    const [wanted, found] = [setHeights(latex), sizeOf(latex)];
    for (const side of /** @type {const} */ (["height", "depth"])) assert.ok(Math.abs(found[side] - wanted[side]) < 0.2, `${side} ${found[side]} for ${wanted[side]}`);
  });
}

test("fractions in neighbouring rows of a matrix do not touch, and rows without them stay where they are", () => {
  const total = (/** @type {string[]} */ ...rows) => {
    const { height, depth } = setHeights(`\\begin{bmatrix} ${rows.join(" \\\\ ")} \\end{bmatrix}`);
    return height + depth;
  };
  const one = setHeights("\\textstyle\\frac{1}{2}");
  const apart = (total(...Array(6).fill("\\frac{1}{2}")) - total(...Array(3).fill("\\frac{1}{2}"))) / 3;
  assert.ok(apart >= one.height + one.depth + 0.15, `${apart} for ${one.height + one.depth}`);
  assert.ok(Math.abs((total(...Array(6).fill("a")) - total(...Array(3).fill("a"))) / 3 - 1.2) < 0.01);
  assert.equal(airy("\\begin{bmatrix*}[l] \\frac{a}{b} \\\\[0.6em] c \\end{bmatrix*}"), "\\begin{bmatrix*}[l] \\frac{a}{b} \\\\[0.6em] c \\end{bmatrix*}");
});

const LEAST = { bearable: 0.78, smallest: 0.56 };
const SUM = "\\begin{aligned}E &= aaaa + bbbb - cccc + dddd \\\\[0.85em] F &= e\\end{aligned}";

test("rows that fit are as the formula has them, each with the gap below it", () => {
  const { rows, part } = planned(SUM, 40, LEAST);
  assert.equal(part, 1);
  assert.deepEqual(rows.map(({ left, right }) => [left, right]), [["E", "= aaaa + bbbb - cccc + dddd"], ["F", "= e"]]);
  assert.ok(rows[0].below > 1.2 && rows[1].below < 0.4);
});

test("rows that would become too small go on below, and all fit at one size", () => {
  const { rows, part } = planned(SUM, 9, LEAST);
  assert.deepEqual(rows.map(({ left }) => left), ["E", "", "F"]);
  assert.match(rows[1].right, /^\\qquad \{\}[+-]/);
  assert.ok(part >= LEAST.smallest && part <= 1);
});

test("every row is a formula by itself, even where a bracket goes on below", () => {
  const { rows } = planned("\\begin{aligned}V &= g (aaaa + bbbb + cccc) - \\left(dddd + eeee\\right)\\end{aligned}", 5, LEAST);
  assert.ok(rows.length > 3);
  for (const { left, right } of rows) for (const latex of [left, `{}${right}`]) katex.renderToString(`{\\displaystyle ${latex}}`);
});

test("a lecture would rather have more rows than smaller ones", () => {
  const room = sizeOf("E").width + sizeOf("= aaaa + bbbb - cccc + dddd").width - 1;
  assert.equal(planned(SUM, room, LEAST).rows.length, 2);
  assert.equal(planned(SUM, room, { ...LEAST, bearable: 0.98 }).rows.length, 3);
});

test("what cannot be broken is one row, smaller than any", () => {
  const { rows, part } = planned("x_{aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa}", 3, LEAST);
  assert.equal(rows.length, 1);
  assert.ok(part < LEAST.smallest);
});

const EQUATIONS = "\\begin{aligned}M &= a \\\\[0.4em] &= \\begin{bmatrix} b & 0 \\\\ 0 & c \\end{bmatrix} \\\\[0.85em] x &= 1 \\\\ y &= 2 \\\\[0.4em] & u = v \\\\ \\;\\Longleftrightarrow\\; & v - u = 0\\end{aligned}";
const CLOSE = { ...LEAST, close: true };
/** Its letters and signs, without commands and layout. @param {string} latex */
const said = (latex) => latex.replace(/\\\\\[[^\]]*\]|\\(?:begin|end)\{\w+\}|\\[a-zA-Z]+/g, "").replace(/[^\w=-]/g, "");

/** @type {[string, number, string[]][]} */
const JOINED = [
  ["all in one where there is room", 40, ["M = a = [] x = 1 y = 2", "u = v <=> v - u = 0"]],
  ["what an equation is equal to stays with it", 12, ["M = a = []", "x = 1 y = 2", "u = v <=> v - u = 0"]],
  ["an equation that needs two rows stands alone", 7.2, ["M = a", "= []", "x = 1", "y = 2", "u = v", "<=> v - u = 0"]],
];
for (const [name, room, wanted] of JOINED)
  test(`equations share rows as far as they have room: ${name}`, () => {
    const { rows, part } = planned(EQUATIONS, room, CLOSE);
    const short = rows.map(({ left, right }) => `${left} ${right}`.replace(/\\begin.*?\\end\{bmatrix\}/g, "[]").replace(/\\;|\\qquad/g, "").replace("\\Longleftrightarrow", "<=>").replace(/\s+/g, " ").trim());
    assert.deepEqual(short, wanted);
    assert.equal(part, 1);
    for (const { left, right } of rows) katex.renderToString(`{\\displaystyle ${left}{}${right}}`);
  });

test("a fraction of numbers is small where rows share rows, and no other", () => {
  const [{ right }] = planned("\\begin{aligned}E &= \\frac{1}{2} m v^2 + \\frac{a}{b}\\end{aligned}", 40, CLOSE).rows;
  assert.equal(right.replace(/\s/g, ""), "=\\tfrac{1}{2}mv^2+\\frac{a}{b}");
});

const [MASSES, STIFF] = ["\\begin{bmatrix} m & 0 \\\\ 0 & m \\end{bmatrix}", "\\begin{bmatrix} k & 0 \\\\ 0 & c \\end{bmatrix}"];
const LINEAR = `\\begin{aligned}\\htmlClass{of-body_a}{\\mathbf{M}}_0 &= \\mathbf{M} \\\\ &= ${MASSES} \\\\ \\mathbf{K}_0 &= ${STIFF} \\\\ & \\mathbf{M}_0 x + {\\mathbf{K}_0 x} = 0 \\\\ \\;\\Longleftrightarrow\\; & ${MASSES} x + {${STIFF} x} = b \\end{aligned}`;

test("a matrix is written out once where rows share rows, and what that repeats is left out", () => {
  const said = (/** @type {string} */ latex) => planned(latex, 60, CLOSE).rows.map(({ left, right }) => `${left} ${right}`).join(" ").replace(/\\htmlClass\{[^}]*\}|\s|\\[;q]\w*|[{}]/g, "");
  const named = said(LINEAR);
  assert.equal(named.split("bmatrix").length - 1, 4);
  assert.ok(named.endsWith("\\Longleftrightarrow\\mathbfM_0x+\\mathbfK_0x=b"), named);
  const repeated = said(LINEAR.replace("= b", "= 0"));
  assert.ok(repeated.endsWith("\\mathbfM_0x+\\mathbfK_0x=0") && !repeated.includes("Longleftrightarrow"), repeated);
});

test("rows that share rows say the same in the same order, and none is wider than its place", () => {
  for (let room = 6; room < 40; room += 1.5) {
    const { rows, part } = planned(EQUATIONS, room, CLOSE);
    assert.equal(said(rows.map(({ left, right }) => left + right).join("")), said(EQUATIONS));
    const widest = [0, 1].map((side) => Math.max(...rows.map((row) => sizeOf(side ? row.right : row.left).width)));
    assert.ok((widest[0] + widest[1]) * part <= room);
  }
});
