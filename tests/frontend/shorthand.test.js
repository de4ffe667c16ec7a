import { strict as assert } from "node:assert";
import { createRequire } from "node:module";
import { test } from "node:test";
import {
  filling,
  fillingBriefly,
  formulaOf,
  worthwhile,
} from "../../frontend/model/lecture/filling.js";
import { planned } from "../../frontend/model/rows.js";

const katex = createRequire(
  new URL("../../frontend/package.json", import.meta.url),
)("katex");
const BRIEF = { bearable: 0.92, smallest: 0.56, close: true, brief: true };

/** @param {number} i @param {string} symbol */
const q = (i, symbol) => `\\htmlClass{q-${i}}{${symbol}}`;
/** A formula in shorthand in one wide row, without classes, braces that only group, and gaps. @param {string} latex @param {number} [room] */
function brief(latex, room = 400) {
  const { rows } = planned(latex, room, BRIEF);
  for (const { left, right } of rows)
    katex.renderToString(`{\\displaystyle ${left}{}${right}}`, {
      trust: true,
      strict: "ignore",
      throwOnError: true,
    });
  return rows
    .map(({ left, right }) => `${left}${right}`)
    .join(" ")
    .replace(/\\htmlClass\{[^}]*\}/g, "")
    .replace(/\\mathrm|\\[,;!]|\\q?quad|[\s{}]/g, "");
}

const SLOPES = [
  ["x", 0],
  ["\\psi", 1],
  ["\\varphi_1", 2],
];
const [x, psi, phi] = SLOPES.map(([symbol, i]) => q(Number(i), String(symbol)));
const dots = [
  q(0, "\\dot{x}"),
  q(1, "\\dot{\\psi}"),
  q(2, "\\dot{\\varphi}_1"),
];
const law = (/** @type {string} */ position, /** @type {string} */ rate) =>
  `\\frac{\\partial E}{\\partial ${rate}} &= Q_{${position}}\\,\\delta ${position}`;

/** @type {[string, string, string][]} */
const CASES = [
  [
    "a matrix with nothing but its diagonal is one line, behind what it is equal to, and called by its name below",
    "\\mathbf{K} &\\approx \\left.\\frac{\\partial f}{\\partial q}\\right|_{0} \\\\ &\\approx \\begin{bmatrix} \\frac{a}{b} & 0 \\\\ 0 & \\htmlClass{t-1-2-3}{\\frac{c}{b}} \\end{bmatrix} \\\\ & \\mathbf{K}\\,x = 0 \\\\ \\;\\Longleftrightarrow\\; & \\begin{bmatrix} \\frac{a}{b} & 0 \\\\ 0 & \\frac{c}{b} \\end{bmatrix}\\,x = 0",
    "\\mathbfK\\approx\\left.\\frac\\partialf\\partialq\\right|_0\\approxdiag(\\fracab,\\fraccb)\\mathbfKx=0",
  ],
  [
    "a small matrix of two rows stays one",
    "\\mathbf{M} &= \\left.\\mathbf{B}\\right|_{0} \\\\ &= \\begin{bmatrix} a & 0 \\\\ 0 & c \\end{bmatrix}",
    "\\mathbfM=\\left.\\mathbfB\\right|_0=\\beginbmatrixa&0\\\\0&c\\endbmatrix",
  ],
  [
    "functions are letters, and what these stand for is told",
    `E &= a \\sin${psi} \\cos^{2}${psi} \\sin(2 ${psi})`,
    "E=as_\\psic_\\psi^2s_2\\psis_\\alpha=\\sin\\alpha,c_\\alpha=\\cos\\alpha",
  ],
  [
    "brackets that grow and indices are part of an argument",
    `E &= \\cos\\left(${psi} - ${x}\\right) + \\cos\\varphi_1 + \\cos${phi}`,
    "E=c_\\psi-x+c_\\varphi_1+c_\\varphi_1c_\\alpha=\\cos\\alpha",
  ],
  [
    "two functions are no reason for letters",
    `E &= a \\sin${psi} + b \\cos${psi}`,
    "E=a\\sin\\psi+b\\cos\\psi",
  ],
  [
    "a function of a function stays",
    `E &= \\sin(\\cos ${psi}) + \\cos${x} + \\cos${phi}`,
    "E=\\sin(c_\\psi)+c_x+c_\\varphi_1c_\\alpha=\\cos\\alpha",
  ],
  [
    "one law for all coordinates",
    SLOPES.map((_, i) => law([x, psi, phi][i], dots[i])).join(" \\\\[0.4em] "),
    "\\frac\\partialE\\partial\\dotq_i=Q_q_i\\deltaq_i(q_i=x,\\psi,\\varphi_1)",
  ],
  [
    "laws that differ in more stay",
    `${law(x, dots[0])} \\\\ \\frac{\\partial V}{\\partial ${dots[1]}} &= Q_{${psi}}`,
    "\\frac\\partialE\\partial\\dotx=Q_x\\deltax\\frac\\partialV\\partial\\dot\\psi=Q_\\psi",
  ],
  [
    "terms that are alike are a sum over the coordinates",
    `h &= ${[x, psi, phi].map((one, i) => `${dots[i]}\\,p_{${one}}`).join(" + ")} - L`,
    "h=\\sum\\nolimits_i\\dotq_ip_q_i-L(q_i=x,\\psi,\\varphi_1)",
  ],
  [
    "a term of another sign ends it",
    `h &= ${dots[0]} p_{${x}} + ${dots[1]} p_{${psi}} - ${dots[2]} p_{${phi}}`,
    "h=\\dotxp_x+\\dot\\psip_\\psi-\\dot\\varphi_1p_\\varphi_1",
  ],
  [
    "all pairs of coordinates",
    `A_{${x}, ${psi}} &= 0 \\\\ A_{${x}, ${phi}} &= 0 \\\\ A_{${psi}, ${phi}} &= 0`,
    "A_q_i,q_k=0(q_i,q_k=x,\\psi,\\varphi_1)",
  ],
  [
    "some pairs are written out",
    `A_{${x}, ${psi}} &= 0 \\\\ A_{${psi}, ${phi}} &= 0`,
    "A_x,\\psi=0A_\\psi,\\varphi_1=0",
  ],
  [
    "a left side is said without what it depends on",
    `r(${x}, ${psi}) &= a`,
    "r=a",
  ],
];
for (const [name, latex, wanted] of CASES)
  test(`shorthand: ${name}`, () =>
    assert.equal(
      brief(
        `\\begin{aligned}${latex}\\end{aligned}`,
        /\\sin/.test(latex) ? 5 : 400,
      ),
      wanted,
    ));

const MATRIX = (/** @type {string[][]} */ ...rows) =>
  `\\begin{bmatrix} ${rows.map((row) => row.join(" & ")).join(" \\\\ ")} \\end{bmatrix}`;
const NAMED = `\\mathbf{M} &= ${MATRIX(["m", "b"], ["b", "m"])} \\\\ \\mathbf{A} &= ${MATRIX(["1", "a"])} \\\\ \\mathbf{f} &= ${MATRIX(["F"], ["0"])}`;
const whole = (/** @type {string} */ corner) =>
  MATRIX(["m", "b", "1"], ["b", "m", "a"], ["1", "a", corner]);
const system = (/** @type {string} */ corner) =>
  `\\begin{aligned}& ${whole(corner)}\\,${MATRIX(["\\ddot{x}"], ["\\ddot{y}"], ["-\\lambda"])} = ${MATRIX(["F"], ["0"], ["c"])} \\\\ ${NAMED}\\end{aligned}`;

test("shorthand: a matrix of blocks that have names", () =>
  assert.ok(
    brief(system("0")).startsWith(
      "\\beginbmatrix\\mathbfM&\\mathbfA^T\\\\\\mathbfA&\\mathbf0\\endbmatrix\\beginbmatrix\\left(\\ddotx,\\ddoty\\right)^T\\\\-\\lambda\\endbmatrix=\\beginbmatrix\\mathbff\\\\c\\endbmatrix",
    ),
    brief(system("0")),
  ));
test("shorthand: a matrix with a block that has none is written out", () =>
  assert.ok(brief(system("d")).startsWith(whole("d").replace(/[\s{}]/g, ""))));

/** Two constraints of three coordinates, of which the last is in one of them only; classes as on the page. */
const constraint = (/** @type {string} */ name) =>
  `\\htmlClass{p-1 constraint-${name} q-3}{\\Phi_{\\text{${name}}}}`;
const reaction = (/** @type {string} */ name, /** @type {string} */ by) =>
  `\\htmlClass{constraint-${name}}{\\lambda_${name}\\,\\frac{\\partial ${constraint(name)}}{\\partial ${by}}}`;
const second = (/** @type {string} */ name) =>
  `\\frac{\\mathrm{d}^2 ${constraint(name)}}{\\mathrm{d} t^2}`;
const BOUND = `\\begin{aligned}& ${MATRIX(...[x, psi, phi].map((by) => [`E_{${by}}`]), [second("u")], [second("v")])} = ${MATRIX([`${reaction("u", x)} + ${reaction("v", x)}`], [`${reaction("u", psi)} + ${reaction("v", psi)}`], [reaction("v", phi)], ["0"], ["0"])}
  \\\\ \\;\\Longleftrightarrow\\; & ${MATRIX(["m", "0", "0", "1", "0"], ["0", "n", "0", "a", "b"], ["0", "0", "k", "0", "c"], ["1", "a", "0", "0", "0"], ["0", "b", "c", "0", "0"])}\\,${MATRIX(["\\ddot{x}"], ["\\ddot{y}"], ["\\ddot{z}"], ["-\\lambda_u"], ["-\\lambda_v"])} = ${MATRIX(["F"], ["0"], ["0"], ["h".repeat(40)], ["0"])}
  \\\\ \\mathbf{M} &= ${MATRIX(["m", "0", "0"], ["0", "n", "0"], ["0", "0", "k"])} \\\\ \\mathbf{A} &= ${MATRIX(["1", "a", "0"], ["0", "b", "c"])} \\\\ \\mathbf{f} &= ${MATRIX(["F"], ["0"], ["0"])}\\end{aligned}`;

test("shorthand: reactions are one sum, constraints have one law, and what is one line comes first", () => {
  const found = brief(BOUND).replaceAll("\\", "");
  const rest = "-gamma=beginbmatrix" + "h".repeat(40) + "0endbmatrix";
  const order = [
    "E_q_i=sumnolimits_jlambda_jfracpartialPhi_jpartialq_i(q_i=x,psi,varphi_1)",
    "fracd^2Phi_jdt^2=0",
    "(lambda_j=lambda_u,lambda_v)",
    ";Longleftrightarrow;beginbmatrixbf".slice(1, 19),
    "M=diag(m,n,k)",
    "f=left(F,0,0right)^T",
    "A=beginbmatrix",
    rest,
  ];
  const places = order.map((one) =>
    found.replaceAll("mathbf", "").indexOf(one),
  );
  assert.ok(!places.includes(-1), `${found}\n${places}`);
  assert.deepEqual(
    places,
    [...places].sort((a, b) => a - b),
  );
});
test("shorthand: reactions of one constraint stay", () => {
  const one = `\\begin{aligned}E_{${x}} &= ${reaction("u", x)} \\\\ E_{${psi}} &= ${reaction("u", psi)}\\end{aligned}`;
  assert.ok(!brief(one).includes("sum"));
});

test("shorthand: equal columns are equations beside each other where that is less high, and what follows is said of all", () => {
  const columns = [
    ["a", "b", "c", "d"],
    ["1", "2", "3", "4"],
  ].map((entries) =>
    MATRIX(...entries.map((entry) => [`\\frac{${entry}}{2}`])),
  );
  const { rows } = planned(
    `\\begin{aligned}& ${columns[0]} = ${columns[1]} \\\\ \\;\\Longleftrightarrow\\; & x = 1\\end{aligned}`,
    40,
    BRIEF,
  );
  assert.equal(rows.length, 2);
  assert.equal(
    rows[0].right.replace(/\s|\\qquad/g, ""),
    "abcd".replace(/./g, (one, i) => `\\frac{${one}}{2}=\\tfrac{${i + 1}}{2}`),
  );
  assert.match(rows[1].left, /Longleftrightarrow/);
});

test("a slide is in shorthand only where that makes its letters much larger", () => {
  const [short, long] = [
    `x = ${psi}`,
    Array.from(
      { length: 9 },
      (_, i) => `m_${i} \\cos${psi} \\sin${phi} \\cos${x}`,
    ).join(" + "),
  ].map((latex) => [formulaOf({ latex, share: 1 })]);
  const pane = { width: 500, height: 300 };
  const chosen = (/** @type {typeof short} */ formulas) =>
    worthwhile(
      filling(formulas, pane, 768),
      fillingBriefly(formulas, pane, 768),
    );
  assert.equal(chosen(short).brief, false);
  assert.ok(
    chosen(long).brief &&
      chosen(long).reached >= 1.05 * filling(long, pane, 768).reached,
  );
});
