/**
 * Wide matrices in a narrow place, as textbooks set them: a matrix keeps its form with names for its long entries, which
 * follow one by one; a column goes on below within its brackets.
 */

import { entriesOf, weight, withMatrices } from "./latex.js";

/** @typedef {{text: string, gap: string}} Row */
/** Entries up to this many letters stay where they are. */
const SHORT = 6;
const NAME = /\\mathbf\{([A-Z])\}\}*(?:_\{?(\w)\}?)?/;
const ALONE = /^\s*=\s*\\begin\{bmatrix\}((?:(?!\\begin\{bmatrix\})[\s\S])*)\\end\{bmatrix\}\s*$/;

/** @param {string[][]} entries */
const bracketed = (entries) =>
  `\\begin{bmatrix} ${entries.map((row) => row.join(" & ")).join(" \\\\ ")} \\end{bmatrix}`;

/**
 * The names of a matrix's long entries; those that are equal share one.
 * @param {string} left  what the matrix is called @param {string[][]} entries
 */
function namesOf(left, entries) {
  const [, letter, index] = /** @type {RegExpMatchArray} */ (left.match(NAME));
  /** @type {Map<string, string>} */
  const names = new Map();
  entries.forEach((row, i) =>
    row.forEach((entry, j) => {
      if (weight(entry) > SHORT && !names.has(entry))
        names.set(entry, `${letter}_{${index ? `${index},` : ""}${i + 1}${j + 1}}`);
    }),
  );
  return names;
}

/**
 * Rows in which matrices of more than one column that are too wide have names for their entries, explained where the
 * matrix is first written.
 * @param {Row[]} rows @param {number} most em @param {import("./linebreak.js").Wide} wide @param {(text: string) => string[]} sidesOf
 */
export function named(rows, most, wide, sidesOf) {
  /** @type {Map<string, string>} */
  const known = new Map();
  let name = "";
  return rows.flatMap((row) => {
    const [left, right] = sidesOf(row.text);
    if (weight(left)) name = left;
    if (wide(row.text.replace(/&/, "")) <= most) return [row];
    const [, body] = right.match(ALONE) ?? [];
    const entries = body ? entriesOf(body) : [];
    if (!body || entries[0].length < 2 || !NAME.test(name))
      return [{ ...row, text: withMatrices(row.text, (matrix) => known.get(matrix) ?? matrix) }];
    const names = namesOf(name, entries);
    const compact = bracketed(entries.map((line) => line.map((entry) => names.get(entry) ?? entry)));
    known.set(right.trim().slice(1).trim(), compact);
    const below = [...names].map(([entry, of]) => ({ text: `${of} &= ${entry}`, gap: " \\\\[0.2em] " }));
    if (below.length) below[below.length - 1].gap = row.gap;
    return [{ text: `${left}= ${compact}`, gap: below.length ? " \\\\[0.4em] " : row.gap }, ...below];
  });
}

/**
 * A term whose columns fit: their entries go on below, those of the widest column first, and of others only where that
 * is not enough.
 * @param {string} term @param {number} most em @param {import("./linebreak.js").Wide} wide @param {(entry: string, most: number) => string[]} linesOf
 */
export function narrowed(term, most, wide, linesOf) {
  /** @type {{matrix: string, entries: string[][], size: number}[]} */
  const columns = [];
  withMatrices(term, (matrix, entries) => {
    if (entries.every((row) => row.length === 1)) columns.push({ matrix, entries, size: wide(matrix) });
    return matrix;
  });
  let found = term;
  for (const { matrix, entries, size } of columns.sort((one, other) => other.size - one.size)) {
    const all = wide(found);
    if (all <= most) return found;
    const rows = entries.map(([entry]) => linesOf(entry, most - all + size));
    if (rows.some((lines) => lines.length > 1)) found = found.replace(matrix, () => column(rows));
  }
  return found;
}

/** A column whose entries have lines. @param {string[][]} rows */
const column = (rows) =>
  `\\begin{bmatrix*}[l] ${rows.map((lines) => lines.join(" \\\\ \\quad {}")).join(" \\\\[0.6em] ")} \\end{bmatrix*}`;
