/**
 * Long formulas in lines: a row too wide for its place goes on below, before a plus or minus of its outermost sum, as
 * textbooks set it. Classes that colour a sum as a whole are kept on each of its lines.
 */

import { cut, endsRow, groupAt, parted, tokensOf } from "./latex.js";
import { named, narrowed } from "./matrices.js";
import { sizeOf } from "./measure.js";

/** @typedef {(latex: string) => number} Wide  how wide a formula is, in em */

const RELATION = /^(=|\\(approx|equiv|neq|le|ge|Longleftrightarrow|Rightarrow|to))$/;
const ROWS = /^\\begin\{aligned\}([\s\S]*)\\end\{aligned\}$/;
/** In a term too long by itself a row may go on within so many brackets within each other. */
const DEEPEST = 3;
/** What goes on below stands in from where its row began, by so many em. */
const INDENT = "\\qquad {}";
const INDENTED = 2;
/** Left sides that take more of a row than this, and more em, have one of their own, and the relations hang below them. */
const HEAVY = 0.3;
const SHORT = 4;
const HANGING = "\\quad {}";
/** Gaps about a sign that joins, in em: a term by itself is measured without them. */
const JOINED = 4 / 9;

/** The rows of a formula, aligned or not, each with the gap that follows it. @param {string} latex */
export function rowsOf(latex) {
  const aligned = latex.trim().match(ROWS);
  return parted(aligned ? aligned[1] : `& ${latex}`, endsRow).map((row) => {
    const [, text, gap] = /** @type {RegExpMatchArray} */ (row.match(/^([\s\S]*?)(\\\\(?:\[[^\]]*\])?)?$/));
    return { text, gap: gap ?? "" };
  });
}

/** A sign that joins two terms, not one that leads a term or follows a relation. @param {string} token @param {string} before */
export function joins(token, before) {
  const last = before.trim().split(/\s+/).at(-1) ?? "";
  return /^[+-]$/.test(token) && last !== "" && !RELATION.test(last) && !/[+([-]$/.test(last);
}

/**
 * The terms of the outermost sum, each with its sign; a coloured sum counts by its own terms.
 * @param {string} sum @param {number} most @param {Wide} wide @returns {string[]}
 */
function termsOf(sum, most, wide) {
  return cut(sum, joins).flatMap(
    (term) => coloured(term, most, wide) ?? (wide(term) > most ? opened(term, most, wide) : [term]),
  );
}

/**
 * A term whose fraction is too long for a sum above its bar: one over what is below it, times the sum, which may go on
 * below within its brackets.
 * @param {string} term @param {number} most @param {Wide} wide
 */
function unfolded(term, most, wide) {
  const tokens = tokensOf(term);
  let [depth, at] = [0, 0];
  for (; at < tokens.length; at += 1) {
    const token = tokens[at];
    if (token === "{" || token.startsWith("\\begin")) depth += 1;
    if (token === "}" || token.startsWith("\\end")) depth -= 1;
    if (depth || token !== "\\frac" || tokens[at + 1] !== "{") continue;
    const [above, middle] = groupAt(tokens, at + 1);
    const [below, end] = groupAt(tokens, middle);
    if (cut(above, joins).length < 2 || wide(`\\frac{${above}}{${below}}`) <= most) continue;
    const [before, behind] = [tokens.slice(0, at).join(""), tokens.slice(end).join("")];
    return `${before}\\frac{1}{${below}}\\left(${above}\\right)${behind}`;
  }
  return term;
}

/**
 * The pieces of a term that is too long by itself: it goes on within its outermost brackets, and within those inside
 * only where that is not enough.
 * @param {string} term @param {number} most @param {Wide} wide @param {number} [levels] @returns {string[]}
 */
function opened(term, most, wide, levels = 1) {
  const free = unfolded(term, most, wide)
    .replace(/\\left([([])/g, "\\Bigl$1")
    .replace(/\\right([)\]])/g, "\\Bigr$1");
  const pieces = cut(free, joins, levels);
  if (pieces.length === 1) return levels < DEEPEST ? opened(term, most, wide, levels + 1) : [term];
  return pieces.flatMap((piece) => (wide(piece) > most ? opened(piece, most, wide) : [piece]));
}

/** The terms of a sum within one colour, each in that colour; null if the term is not such a sum. @param {string} term @param {number} most @param {Wide} wide */
function coloured(term, most, wide) {
  const found = term.match(/^\s*([=+]?)\s*\\htmlClass\{([^}]*)\}\{([\s\S]*)\}\s*$/);
  if (!found || closesEarly(found[3])) return null;
  const [, sign, names, content] = found;
  const inner = termsOf(content, most, wide);
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

/** The left side of a row, without its mark. @param {string} row */
const leftOf = (row) => sidesOf(row)[0].replace(/&\s*$/, "").trim();

/** Whether a left side of some em would take too much of rows of `most` em. @param {number} left @param {number} most */
export const isHeavy = (left, most) => left > Math.max(SHORT, HEAVY * most);

/** @param {{text: string, gap: string}[]} rows @param {number} most @param {Wide} wide */
function hung(rows, most, wide) {
  if (!isHeavy(Math.max(...rows.map(({ text }) => wide(leftOf(text)))), most)) return rows;
  return rows.flatMap(({ text, gap }) => {
    const [left, right] = [leftOf(text), sidesOf(text)[1]];
    // What is short beside the heavy ones stays one row.
    const both = `${left} ${right}`;
    if (left && wide(left) <= SHORT && wide(both) <= most) return [{ text: `& ${both}`, gap }];
    const row = { text: `& ${HANGING}${right}`, gap };
    return left ? [{ text: `& ${left}`, gap: " \\\\[0.2em] " }, row] : [row];
  });
}

/**
 * A term whose columns go on below, at the outermost signs of their entries; where that is not enough each side of the
 * equation is by itself, and only then an entry is broken within its brackets.
 * @param {string} term @param {number} most @param {Wide} wide @returns {string[]}
 */
function columned(term, most, wide) {
  if (wide(term) <= most) return [term];
  const whole = narrowed(term, most, wide, (entry, width) => lined(cut(entry, joins), width, wide));
  if (wide(whole) <= most) return [whole];
  const sides = cut(term, (token, before) => token === "=" && before.trim() !== "");
  if (sides.length > 1 && sides.slice(1).every((side) => side.includes("\\begin{bmatrix}")))
    return sides.flatMap((side) => columned(side, most, wide));
  return [narrowed(term, most, wide, (entry, width) => linesOf(entry, width, wide))];
}

/** A row whose right side is to be at most `most` em wide. @param {string} row @param {number} most @param {Wide} wide @param {boolean} close @returns {string[]} */
function broken(row, most, wide, close) {
  const [begin, whole] = sidesOf(row);
  if (wide(whole) <= most) return [row];
  const hangs = whole.trimStart().startsWith(HANGING);
  const [lead, right] = hangs ? [HANGING, whole.trimStart().slice(HANGING.length)] : ["", whole];
  const least = most - Math.max(wide(lead), INDENTED);
  const terms = termsOf(right, least, wide).flatMap((term) => columned(term, least, wide));
  return lined(terms, most, wide, lead, close).map((line, i) => (i ? `& ${INDENT}${line}` : `${begin} ${line}`));
}

/** Brackets that a piece opens, less those that it closes. @param {string} piece */
const balance = (piece) =>
  tokensOf(piece).reduce((sum, token) => sum + (/^[([]$/.test(token) ? 1 : /^[)\]]$/.test(token) ? -1 : 0), 0);

/**
 * Terms in lines of at most `most` em; what ends a bracket of a line above ends its line, but where height is dear.
 * @param {string[]} terms @param {number} most @param {Wide} wide @param {string} [lead]  what the first of them follows @param {boolean} [close]
 */
function lined(terms, most, wide, lead = "", close = false) {
  const lines = [lead];
  let [open, within, taken, room] = [0, false, 0, most - (lead ? wide(lead) : 0)];
  for (const term of terms) {
    const needed = wide(term);
    const ends = within && open === 0 && !close;
    if (taken && (ends || taken + JOINED + needed > room)) {
      lines.push(term);
      [within, taken, room] = [open > 0, needed, most - INDENTED];
    } else {
      lines[lines.length - 1] += term;
      taken += (taken && JOINED) + needed;
    }
    open += balance(term);
  }
  return lines;
}

/** @param {string} sum @param {number} most @param {Wide} wide */
const linesOf = (sum, most, wide) => lined(termsOf(sum, most, wide), most, wide);

/**
 * The rows of a formula, each at most `most` em wide, as far as they can be broken.
 * @param {{text: string, gap: string}[]} given @param {number} most @param {Wide} [wide]
 * @param {boolean} [close]  height is dear
 */
export function brokenRows(given, most, wide = (latex) => sizeOf(latex).width, close = false) {
  const rows = hung(named(given, most, wide, sidesOf), most, wide);
  const right = most - Math.max(...rows.map(({ text }) => wide(leftOf(text))));
  return rows.flatMap(({ text, gap }) => {
    const lines = broken(text, right, wide, close);
    return lines.map((line, i) => ({ text: line, gap: i < lines.length - 1 ? " \\\\[0.2em] " : gap }));
  });
}
