/**
 * How much room a formula takes, estimated from its LaTeX by TeX's rules (Knuth, The TeXbook, appendix G) with rounded
 * sizes of letters: in em of the formula, and without a browser. What is typeset in the end is a few percent from it.
 */

import { airy, endsRow, tokensOf } from "./latex.js";
import { beside, letter, NOTHING } from "./letters.js";

/** @typedef {import("./letters.js").Box} Box */
/** @typedef {import("./letters.js").Atom} Atom */
/** @typedef {import("./letters.js").Style} Style */
/** @typedef {{tokens: string[], at: number}} Reader */

const GAPS = /** @type {Record<string, number>} */ ({
  "\\,": 1 / 6,
  "\\:": 2 / 9,
  "\\;": 5 / 18,
  "\\!": -1 / 6,
  "\\quad": 1,
  "\\qquad": 2,
});
const ALPHABETS = /** @type {Record<string, number>} */ ({
  "\\text": 1,
  "\\mathrm": 1.05,
  "\\mathbf": 1.17,
  "\\mathcal": 1,
});
const FIXED = /** @type {Record<string, number>} */ ({ "\\big": 1.2, "\\Big": 1.8, "\\bigg": 2.4, "\\Bigg": 3 });
/** Brackets grow with what they enclose: their heights, and how wide they are then. */
const BRACKETS = [
  [1, 0.39],
  [1.2, 0.46],
  [1.8, 0.6],
  [2.4, 0.74],
  [Infinity, 0.79],
];
/** Where fractions have their bar, room beside it, and room after scripts. */
const [AXIS, BESIDE, AFTER] = [0.25, 0.12, 0.05];

/** Of a script. @param {Style} style @returns {Style} */
const smaller = ({ scale }) => ({ scale: scale === 1 ? 0.7 : 0.5, display: false });

/** The atoms up to a token that ends them. @param {Reader} reader @param {Style} style @param {(token: string) => boolean} ends @returns {Atom[]} */
function list(reader, style, ends) {
  /** @type {Atom[]} */
  const atoms = [];
  while (reader.at < reader.tokens.length && !ends(reader.tokens[reader.at])) atoms.push(...scripted(reader, style));
  return atoms;
}

/** What is in braces, or one token. @param {Reader} reader @param {Style} style @returns {Atom[]} */
function group(reader, style) {
  if (reader.tokens[reader.at] !== "{") return nucleus(reader, style);
  reader.at += 1;
  const atoms = list(reader, style, (token) => token === "}");
  reader.at += 1;
  return atoms;
}

/** @param {Reader} reader @param {Style} style */
const boxed = (reader, style) => beside(group(reader, style), style);

/** @param {Reader} reader @param {Style} style @returns {Atom[]} */
function scripted(reader, style) {
  const atoms = nucleus(reader, style);
  const base = atoms.pop() ?? { ...NOTHING, kind: "ord" };
  const script = { above: NOTHING, below: NOTHING };
  for (let mark = reader.tokens[reader.at]; mark === "^" || mark === "_"; mark = reader.tokens[reader.at]) {
    reader.at += 1;
    script[mark === "^" ? "above" : "below"] = boxed(reader, smaller(style));
  }
  const { above, below } = script;
  const width = Math.max(above.width, below.width);
  if (!width) return [...atoms, base];
  const up = Math.max(0.41 * style.scale, base.height - 0.3 * style.scale) + above.height;
  const down = Math.max((above.width ? 0.25 : 0.15) * style.scale, base.depth + 0.03) + below.depth;
  return [
    ...atoms,
    {
      width: base.width + width + AFTER * style.scale,
      kind: base.kind,
      height: above.width ? Math.max(base.height, up) : base.height,
      depth: below.width ? Math.max(base.depth, down) : base.depth,
    },
  ];
}

/** @param {Reader} reader @param {Style} style */
function fraction(reader, style) {
  const { scale, display } = style;
  const inner = display ? { scale, display: false } : smaller(style);
  const [above, below] = [boxed(reader, inner), boxed(reader, inner)];
  const up = Math.max((display ? 0.68 : 0.39) * scale, above.depth + AXIS + (display ? 0.14 : 0.06));
  const down = Math.max((display ? 0.69 : 0.35) * scale, below.height - (display ? 0.11 : 0.19));
  return {
    width: Math.max(above.width, below.width) + 2 * BESIDE,
    height: up + above.height,
    depth: down + below.depth,
    kind: "ord",
  };
}

/** A bracket at least as high as asked for, around the axis. @param {string} bracket @param {number} size */
function bracketed(bracket, size) {
  const [high, wide] = BRACKETS.find(([most]) => size <= most) ?? [];
  if (bracket === ".") return { width: BESIDE, height: 0, depth: 0 };
  const total = Math.max(size, Number.isFinite(high) ? Number(high) : 0);
  return {
    width: bracket === "|" ? 0.33 : bracket === "[" ? 0.75 * Number(wide) : Number(wide),
    height: total / 2 + AXIS,
    depth: total / 2 - AXIS,
  };
}

/** What stands between brackets that grow. @param {Box} inner @param {string} left @param {string} right */
function enclosed(inner, left, right) {
  const needed = 2 * Math.max(inner.height - AXIS, inner.depth + AXIS);
  const [begin, end] = [left, right].map((bracket) => bracketed(bracket, Math.max(0.9 * needed, needed - 0.5)));
  return {
    width: begin.width + inner.width + end.width,
    kind: "inner",
    height: Math.max(begin.height, inner.height, end.height),
    depth: Math.max(begin.depth, inner.depth, end.depth),
  };
}

/** @param {Reader} reader @param {Style} style */
function grown(reader, style) {
  const left = reader.tokens[reader.at++].slice(5);
  const inner = beside(
    list(reader, style, (token) => token.startsWith("\\right")),
    style,
  );
  return enclosed(inner, left, (reader.tokens[reader.at++] ?? "").slice(6));
}

/** @param {Reader} reader @param {Style} style */
function matrix(reader, style) {
  if (/\*/.test(reader.tokens[reader.at++])) reader.at += 3;
  /** @type {number[]} */
  const columns = [];
  let [column, total, row] = [0, 0, { height: 0.84, depth: 0.36 }];
  for (let token = reader.tokens[reader.at]; token && !token.startsWith("\\end"); token = reader.tokens[reader.at]) {
    const entry = beside(
      list(reader, { ...style, display: false }, (next) => next === "&" || endsRow(next) || next.startsWith("\\end")),
      style,
    );
    columns[column] = Math.max(columns[column] ?? 0, entry.width);
    row = { height: Math.max(row.height, entry.height), depth: Math.max(row.depth, entry.depth) };
    const end = reader.tokens[reader.at] ?? "";
    const [, gap = "0"] = end.match(/\[([\d.]+)em\]/) ?? [];
    row.depth = Math.max(row.depth, Number(gap) && 0.36 + Number(gap));
    column = end === "&" ? column + 1 : 0;
    if (end !== "&") [total, row] = [total + row.height + row.depth, { height: 0.84, depth: 0.36 }];
    if (end === "&" || endsRow(end)) reader.at += 1;
  }
  reader.at += 1;
  const width = columns.reduce((sum, wide) => sum + wide, columns.length - 1);
  return enclosed({ width, height: total / 2 + AXIS, depth: total / 2 - AXIS }, "[", "[");
}

/** Skips what takes no room: the names of classes. @param {Reader} reader */
function skipGroup(reader) {
  while (reader.at < reader.tokens.length && reader.tokens[reader.at++] !== "}");
}

/** @param {Reader} reader @param {Style} style @returns {Atom[]} */
function nucleus(reader, style) {
  const token = reader.tokens[reader.at];
  if (token === "{") return [{ ...boxed(reader, style), kind: "ord" }];
  if (token?.startsWith("\\left")) return [grown(reader, style)];
  if (token?.startsWith("\\begin")) return [matrix(reader, style)];
  reader.at += 1;
  if (token in GAPS) return [{ ...NOTHING, width: GAPS[token] * style.scale, kind: "gap" }];
  if (token === "\\frac") return [fraction(reader, style)];
  if (token === "\\dfrac") return [fraction(reader, { ...style, display: true })];
  if (token === "\\tfrac") return [fraction(reader, { ...style, display: false })];
  if (token === "\\htmlClass") {
    skipGroup(reader);
    return group(reader, style);
  }
  if (token in ALPHABETS) {
    const box = boxed(reader, style);
    return [{ ...box, width: box.width * ALPHABETS[token], kind: "ord" }];
  }
  if (/^\\d?dot$/.test(token)) {
    const box = boxed(reader, style);
    return [{ ...box, height: box.height + 0.24 * style.scale, kind: "ord" }];
  }
  if (token === "\\sqrt") {
    const box = boxed(reader, style);
    return [{ width: box.width + 0.85 * style.scale, height: box.height + 0.4, depth: box.depth + 0.1, kind: "ord" }];
  }
  const fixed = token?.match(/^(\\[bB]igg?)([lr]?)$/);
  if (fixed)
    return [
      {
        ...bracketed(reader.tokens[reader.at++], FIXED[fixed[1]]),
        kind: fixed[2] === "l" ? "open" : fixed[2] === "r" ? "close" : "ord",
      },
    ];
  return [letter(token, style)];
}

/** @param {string} latex @returns {Box} */
export function sizeOf(latex) {
  const reader = { tokens: tokensOf(airy(latex)).filter((token) => token.trim()), at: 0 };
  return beside(
    list(reader, { scale: 1, display: true }, () => false),
    { scale: 1, display: true },
  );
}
