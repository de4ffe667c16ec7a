import { strict as assert } from "node:assert";
import { createRequire } from "node:module";
import { test } from "node:test";
import { airy, weight } from "../../frontend/model/latex.js";
import { brokenRows, rowsOf } from "../../frontend/model/linebreak.js";
import { sizeOf } from "../../frontend/model/measure.js";

const katex = createRequire(new URL("../../frontend/package.json", import.meta.url))("katex");

/** As LaTeX, in rows of at most this part of the widest. @param {string} latex @param {number} part */
function broken(latex, part) {
  const rows = rowsOf(latex);
  const most = part * Math.max(...rows.map(({ text }) => sizeOf(text.replace("&", "")).width));
  return `\\begin{aligned}${brokenRows(rows, most).map(({ text, gap }) => text + gap).join("")}\\end{aligned}`;
}

/** Spaces mean nothing in it. @param {string} latex */
const squeezed = (latex) => latex.replace(/\s/g, "");

const BLOCKS = "\\begin{bmatrix} aaaa & 0 & \\htmlClass{q-0}{cccc} \\\\ 0 & bbbb & dddd \\\\ cccc & dddd & 0 \\end{bmatrix}";
const CASES = [
  ["what is short enough stays", "\\begin{aligned}a &= b\\end{aligned}", 1, "\\begin{aligned}a &= b\\end{aligned}"],
  ["a sum goes on below before a sign", "\\begin{aligned}a &= bcd + efg - hij\\end{aligned}", 0.5,
    "\\begin{aligned}a &= bcd  \\\\[0.2em] & \\qquad {}+ efg  \\\\[0.2em] & \\qquad {}- hij\\end{aligned}"],
  ["brackets stay whole where their term fits", "\\begin{aligned}a &= f(b + c) + g(d + e)\\end{aligned}", 0.7,
    "\\begin{aligned}a &= f(b + c)  \\\\[0.2em] & \\qquad {}+ g(d + e)\\end{aligned}"],
  ["and open where it is too long by itself", "\\begin{aligned}a &= f(bbbb + cccc)\\end{aligned}", 0.7,
    "\\begin{aligned}a &= f(bbbb  \\\\[0.2em] & \\qquad {}+ cccc)\\end{aligned}"],
  ["a sign before the first term joins nothing", "\\begin{aligned}a &= -bcdefgh\\end{aligned}", 0.3, "\\begin{aligned}a &= -bcdefgh\\end{aligned}"],
  ["the gap to the next row stays", "\\begin{aligned}a &= bbbb + cccc \\\\[0.4em] d &= e\\end{aligned}", 0.7,
    "\\begin{aligned}a &= bbbb  \\\\[0.2em] & \\qquad {}+ cccc \\\\[0.4em] d &= e\\end{aligned}"],
  ["a coloured sum keeps its colour on each line", "\\begin{aligned}E &= \\htmlClass{k}{aaaa + bbbb}\\end{aligned}", 0.7,
    "\\begin{aligned}E &=\\htmlClass{k}{aaaa } \\\\[0.2em] & \\qquad {}\\htmlClass{k}{{}+ bbbb}\\end{aligned}"],
  ["a long left side has a row of its own", "\\begin{aligned}aaaa + bbbb &= c + d \\\\[0.4em] &= e\\end{aligned}", 0.52,
    "\\begin{aligned}& aaaa  \\\\[0.2em] & \\qquad {}+ bbbb  \\\\[0.2em] & \\quad {}= c + d \\\\[0.4em]& \\quad {}= e\\end{aligned}"],
  ["a short one beside it has none", "\\begin{aligned}aaaa + bbbb &= c + d \\\\[0.4em] e &\\approx f\\end{aligned}", 0.52,
    "\\begin{aligned}& aaaa  \\\\[0.2em] & \\qquad {}+ bbbb  \\\\[0.2em] & \\quad {}= c + d \\\\[0.4em]& e \\approx f\\end{aligned}"],
  ["large brackets become fixed ones where a term goes on within them", "\\begin{aligned}a &= f\\,\\left(bbbb + cccc\\right)\\end{aligned}", 0.7,
    "\\begin{aligned}a &= f\\,\\Bigl(bbbb  \\\\[0.2em] & \\qquad {}+ cccc\\Bigr)\\end{aligned}"],
  ["brackets inside stay whole where that is enough", "\\begin{aligned}a &= f(bbbb (c + d) + eeee (g + h))\\end{aligned}", 0.7,
    "\\begin{aligned}a &= f(bbbb (c + d)  \\\\[0.2em] & \\qquad {}+ eeee (g + h))\\end{aligned}"],
  ["the names of classes stay whole behind a bracket that goes on", "\\begin{aligned}a &= (bbbb + cccc dddd eeee) \\htmlClass{q-0}{ffff}\\end{aligned}", 0.3,
    "\\begin{aligned}a &= (bbbb  \\\\[0.2em] & \\qquad {}+ cccc dddd eeee) \\htmlClass{q-0}{ffff}\\end{aligned}"],
  ["a column goes on within its brackets", "\\begin{aligned}r &= \\begin{bmatrix} bbbb + cccc \\\\ d \\end{bmatrix}\\,x\\end{aligned}", 0.7,
    "\\begin{aligned}r &= \\begin{bmatrix*}[l] bbbb  \\\\ \\quad {}+ cccc \\\\[0.6em] d \\end{bmatrix*}\\,x\\end{aligned}"],
  ["the long entries of a matrix have names, equal ones the same",
    "\\begin{aligned}\\mathbf{M} &= \\begin{bmatrix} aaaa + bbbb & cccc + dddd \\\\ cccc + dddd & e \\end{bmatrix} \\\\[0.85em] f &= g\\end{aligned}", 0.7,
    "\\begin{aligned}\\mathbf{M} &= \\begin{bmatrix} M_{11} & M_{12} \\\\ M_{12} & e \\end{bmatrix} \\\\[0.4em] M_{11} &= aaaa + bbbb \\\\[0.2em] M_{12} &= cccc + dddd\\\\[0.85em] f &= g\\end{aligned}"],
  ["a matrix whose name stands above keeps it further down",
    "\\begin{aligned}\\mathbf{K}_0 &= \\mathbf{K} \\\\ &= \\begin{bmatrix} aaaabbbb & 0 \\\\ 0 & ccccdddd \\end{bmatrix} \\\\ & \\begin{bmatrix} aaaabbbb & 0 \\\\ 0 & ccccdddd \\end{bmatrix}\\,x = 0\\end{aligned}", 0.7,
    "\\begin{aligned}\\mathbf{K}_0 &= \\mathbf{K} \\\\ &= \\begin{bmatrix} K_{0,11} & 0 \\\\ 0 & K_{0,22} \\end{bmatrix} \\\\[0.4em] K_{0,11} &= aaaabbbb \\\\[0.2em] K_{0,22} &= ccccdddd\\\\ & \\begin{bmatrix} K_{0,11} & 0 \\\\ 0 & K_{0,22} \\end{bmatrix}\\,x = 0\\end{aligned}"],
  ["a sum too long for the bar below it is times one over what is below", "\\begin{aligned}a &= -\\frac{bbbb + cccc - dddd}{s_1}\\end{aligned}", 0.8,
    "\\begin{aligned}a &= -\\frac{1}{s_1}\\Bigl(bbbb \\\\[0.2em] & \\qquad {} + cccc \\\\[0.2em] & \\qquad {} - dddd\\Bigr)\\end{aligned}"],
  ["a long product above a bar stays", "\\begin{aligned}a &= \\frac{(b + c)(d + e)}{s}\\end{aligned}", 0.5, "\\begin{aligned}a &= \\frac{(b + c)(d + e)}{s}\\end{aligned}"],
  ["a matrix of blocks that have names is written of these", `\\begin{aligned}& ${BLOCKS}\\,x = y \\\\ \\mathbf{M} &= \\begin{bmatrix} aaaa & 0 \\\\ 0 & bbbb \\end{bmatrix} \\\\ \\mathbf{A} &= \\begin{bmatrix} cccc & \\htmlClass{q-0}{dddd} \\end{bmatrix}\\end{aligned}`, 0.9,
    "\\begin{aligned}& \\begin{bmatrix} \\mathbf{M} & \\mathbf{A}^T \\\\ \\mathbf{A} & \\mathbf{0} \\end{bmatrix}\\,x = y \\\\ \\mathbf{M} &= \\begin{bmatrix} aaaa & 0 \\\\ 0 & bbbb \\end{bmatrix} \\\\ \\mathbf{A} &= \\begin{bmatrix} cccc & \\htmlClass{q-0}{dddd} \\end{bmatrix}\\end{aligned}"],
  ["and one of other entries is not", `\\begin{aligned}& ${BLOCKS}\\,x = y \\\\ \\mathbf{M} &= \\begin{bmatrix} aaaa & 0 \\\\ 0 & bbbb \\end{bmatrix} \\\\ \\mathbf{A} &= \\begin{bmatrix} cccc & eeee \\end{bmatrix}\\end{aligned}`, 0.9,
    `\\begin{aligned}& ${BLOCKS}\\,x = y \\\\ \\mathbf{M} &= \\begin{bmatrix} aaaa & 0 \\\\ 0 & bbbb \\end{bmatrix} \\\\ \\mathbf{A} &= \\begin{bmatrix} cccc & eeee \\end{bmatrix}\\end{aligned}`],
  ["a formula without rows", "aaaa + bbbb", 0.6, "\\begin{aligned}& aaaa  \\\\[0.2em] & \\qquad {}+ bbbb\\end{aligned}"],
];

for (const [name, latex, part, wanted] of /** @type {[string, string, number, string][]} */ (CASES)) {
  test(`long formulas: ${name}`, () => {
    assert.equal(squeezed(broken(latex, part)), squeezed(wanted));
    katex.renderToString(wanted, { displayMode: true, trust: true, strict: "ignore" });
  });
}

test("of two columns that are too wide together, the wider one goes on below, and the other stays whole", () => {
  const right = "\\begin{bmatrix} 0 \\\\ ffff + gggg \\end{bmatrix}";
  const found = broken(
    `\\begin{aligned}& \\begin{bmatrix} aaaa + bbbb + cccc + dddd \\\\ e \\end{bmatrix} = ${right}\\end{aligned}`,
    0.8,
  );
  assert.match(found, /bmatrix\*/);
  assert.ok(found.includes(right), found);
});

test("a column of short entries is rather below the matrix than broken within brackets", () => {
  const matrix = "\\begin{bmatrix} aaaa & bbbb & cccc \\\\ dddd & eeee & ffff \\end{bmatrix}\\,\\begin{bmatrix} x \\\\ y \\end{bmatrix}";
  const right = "\\begin{bmatrix} 0 \\\\ -(1 + e) \\dot{x} \\end{bmatrix}";
  const found = broken(`\\begin{aligned}\\Longleftrightarrow\\; & ${matrix} = ${right}\\end{aligned}`, 0.95);
  assert.equal(
    squeezed(found),
    squeezed(`\\begin{aligned}\\Longleftrightarrow\\; & ${matrix} \\\\[0.2em] & \\qquad {}= ${right}\\end{aligned}`),
  );
});

test("a matrix without a name, or of short entries, is one thing", () => {
  const matrix = "\\begin{aligned}M &= \\begin{bmatrix} a + b & c \\\\ c & d - e \\end{bmatrix}\\end{aligned}";
  assert.equal(squeezed(broken(matrix, 0.2)), squeezed(matrix));
  const nameless = "\\begin{aligned}m &= \\begin{bmatrix} aaaa + bbbb & c \\\\ c & d \\end{bmatrix}\\end{aligned}";
  assert.equal(squeezed(broken(nameless, 0.2)), squeezed(nameless));
});

test("a fraction of fractions is as large in a matrix as outside of it, and others as small as they were", () => {
  const column = (/** @type {string} */ entry) => `\\begin{bmatrix} ${entry} \\\\ 0 \\end{bmatrix}`;
  assert.match(airy(column("\\frac{\\frac{a}{b} - c}{d}")), /\\dfrac\{\\frac\{a\}\{b\} - c\}\{d\}/);
  assert.match(airy(column("\\frac{a}{b}")), /\\frac\{a\}\{b\}/);
  assert.ok(sizeOf(column("\\frac{\\frac{a}{b} - c}{d}")).height > sizeOf(column("\\frac{a - c}{d}")).height);
  katex.renderToString(airy(column("\\frac{\\frac{a}{b} - c}{d}")));
});

test("weight counts what is seen", () => {
  assert.equal(weight("\\htmlClass{q-0 x}{\\dot{\\varphi}_1}^{2}"), 3);
  assert.equal(weight("\\frac{1}{2} m \\ell^2"), 5);
  assert.equal(weight("\\begin{bmatrix} aa & b \\\\ c & ddd \\end{bmatrix}"), 8);
});
