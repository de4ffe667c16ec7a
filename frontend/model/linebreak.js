/**
 * Long formulas in lines: a row too wide for its place goes on below, before a plus or minus of its outermost sum, as
 * textbooks set it. Classes that colour a sum as a whole are kept on each of its lines.
 */

import { cut, endsRow, parted, tokensOf, weight } from "./latex.js";
import { named, narrowed } from "./matrices.js";

const RELATION = /^(=|\\(approx|equiv|neq|le|ge|Longleftrightarrow|Rightarrow|to))$/;
const ROWS = /^\\begin\{aligned\}([\s\S]*)\\end\{aligned\}$/;
/** In a term too long by itself a row may go on within so many brackets within each other. */
const DEEPEST = 3;
/** What goes on below stands in from where its row began. */
const INDENT = "\\qquad {}";
/** Left sides that take more of a row than this, and more letters, have one of their own, and the relations hang below them. */
const HEAVY = 0.3;
const SHORT = 6;
const HANGING = "\\quad {}";

/** The rows of a formula, aligned or not, each with the gap that follows it. @param {string} latex */
export function rowsOf(latex) {
  const aligned = latex.trim().match(ROWS);
  return parted(aligned ? aligned[1] : `& ${latex}`, endsRow).map((row) => {
    const [, text, gap] = /** @type {RegExpMatchArray} */ (row.match(/^([\s\S]*?)(\\\\(?:\[[^\]]*\])?)?$/));
    return { text, gap: gap ?? "" };
  });
}

/** A sign that joins two terms, not one that leads a term or follows a relation. @param {string} token @param {string} before */
function joins(token, before) {
  const last = before.trim().split(/\s+/).at(-1) ?? "";
  return /^[+-]$/.test(token) && last !== "" && !RELATION.test(last) && !/[+([-]$/.test(last);
}

/** The terms of the outermost sum, each with its sign; a coloured sum counts by its own terms. @param {string} sum @param {number} most @returns {string[]} */
function termsOf(sum, most) {
  return cut(sum, joins).flatMap((term) => coloured(term, most) ?? (weight(term) > most ? opened(term, most) : [term]));
}

/**
 * The pieces of a term that is too long by itself: it goes on within its outermost brackets, and within those inside
 * only where that is not enough.
 * @param {string} term @param {number} most @param {number} [levels] @returns {string[]}
 */
function opened(term, most, levels = 1) {
  const free = term.replace(/\\left([([])/g, "\\Bigl$1").replace(/\\right([)\]])/g, "\\Bigr$1");
  const pieces = cut(free, joins, levels);
  if (pieces.length === 1) return levels < DEEPEST ? opened(term, most, levels + 1) : [term];
  return pieces.flatMap((piece) => (weight(piece) > most ? opened(piece, most) : [piece]));
}

/** The terms of a sum within one colour, each in that colour; null if the term is not such a sum. @param {string} term @param {number} most */
function coloured(term, most) {
  const found = term.match(/^\s*([=+]?)\s*\\htmlClass\{([^}]*)\}\{([\s\S]*)\}\s*$/);
  if (!found || closesEarly(found[3])) return null;
  const [, sign, names, content] = found;
  const inner = termsOf(content, most);
  return inner.length < 2
    ? null
    : inner.map((part, i) => (i ? `\\htmlClass{${names}}{{}${part}}` : `${sign}\\htmlClass{${names}}{${part}}`));
}

/** Whether what looks like the inside of one group is the end of one and the beginning of another. @param {string} content */
function closesEarly(content) {
  let depth = 0;
  for (const token of tokensOf(content)) {
    if (token === "{") depth += 1;
    if (token === "}" && --depth < 0) return true;
  }
  return false;
}

/** The two sides of a row: up to its mark of alignment, and after it. @param {string} row */
export function sidesOf(row) {
  const [head, ...rest] = cut(row, (_, before) => before.endsWith("&"));
  return rest.length ? [head, rest.join("")] : ["", head];
}

/** @param {{text: string, gap: string}[]} rows @param {number} most */
function hung(rows, most) {
  const heaviest = Math.max(...rows.map(({ text }) => weight(sidesOf(text)[0])));
  if (heaviest <= Math.max(SHORT, HEAVY * most)) return rows;
  return rows.flatMap(({ text, gap }) => {
    const [left, right] = sidesOf(text);
    const row = { text: `& ${HANGING}${right}`, gap };
    return weight(left) ? [{ text: `& ${left.replace(/&$/, "")}`, gap: " \\\\[0.2em] " }, row] : [row];
  });
}

/** @param {string} row @param {number} most @returns {string[]} */
function broken(row, most) {
  if (weight(row) <= most) return [row];
  const [begin, whole] = sidesOf(row);
  const hangs = whole.trimStart().startsWith(HANGING);
  const [left, right] = hangs ? [`${begin} ${HANGING}`, whole.trimStart().slice(HANGING.length)] : [begin, whole];
  const terms = termsOf(right, most).map((term, i) => narrowed(term, most - (i ? 0 : weight(left)), linesOf));
  return lined(terms, most, left).map((line, i) => (i ? `& ${INDENT}${line}` : line));
}

/** Brackets that a piece opens, less those that it closes. @param {string} piece */
const balance = (piece) =>
  tokensOf(piece).reduce((sum, token) => sum + (/^[([]$/.test(token) ? 1 : /^[)\]]$/.test(token) ? -1 : 0), 0);

/** Terms in lines of at most `most` letters; what ends a bracket of a line above ends its line. @param {string[]} terms @param {number} most @param {string} [lead]  what the first of them follows */
function lined(terms, most, lead = "") {
  const lines = [lead];
  let [open, within] = [0, false];
  for (const term of terms) {
    const last = lines[lines.length - 1];
    const ends = within && open === 0;
    if (last !== lead && (ends || weight(last) + weight(term) > most)) {
      lines.push(term);
      within = open > 0;
    } else lines[lines.length - 1] += term;
    open += balance(term);
  }
  return lines;
}

/** @param {string} sum @param {number} most */
const linesOf = (sum, most) => lined(termsOf(sum, most), most);

/**
 * The rows of a formula, each at most `part` of its widest one, as far as they can be broken.
 * @param {{text: string, gap: string}[]} given @param {number} part between 0 and 1
 */
export function brokenRows(given, part) {
  const most = part * Math.max(...given.map(({ text }) => weight(text)));
  return hung(named(given, most, sidesOf), most).flatMap(({ text, gap }) => {
    const lines = broken(text, most);
    return lines.map((line, i) => ({ text: line, gap: i < lines.length - 1 ? " \\\\[0.2em] " : gap }));
  });
}
