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

/** An entry without its classes and what takes no room. @param {string} entry */
const bare = (entry) => entry.replace(/\\htmlClass\{[^}]*\}|[\s{}]/g, "");

/** The matrices of a formula that have rows of their own, by name. @param {Row[]} rows @param {(text: string) => string[]} sidesOf */
function namedIn(rows, sidesOf) {
  return rows.flatMap(({ text }) => {
    const [left, right] = sidesOf(text);
    const [[name] = [], [, body] = []] = [left.match(/\\math(?:bf|cal)\{[A-Z]\}/) ?? [], right.match(ALONE) ?? []];
    return name && body ? [{ name, entries: entriesOf(body).map((row) => row.map(bare)) }] : [];
  });
}

/** @param {string[][]} one @param {string[][]} other */
const same = (one, other) => JSON.stringify(one) === JSON.stringify(other);
/** @param {string[][]} entries */
const transposed = (entries) => entries[0].map((_, j) => entries.map((row) => row[j]));

/**
 * A symmetric matrix by its blocks, a square one and one with its transpose, with zeros in the corner, where both are
 * told by their names; null for any other.
 * @param {string[][]} entries @param {ReturnType<typeof namedIn>} known
 */
function byBlocks(entries, known) {
  const all = entries.map((row) => row.map(bare));
  const part = (/** @type {[number, number]} */ rows, /** @type {[number, number]} */ columns) =>
    all.slice(...rows).map((row) => row.slice(...columns));
  for (const { name: square, entries: first } of known)
    for (const { name: rows, entries: second } of known) {
      const [k, n] = [first.length, all.length];
      if (first[0].length !== k || second[0].length !== k || second.length !== n - k || all[0].length !== n) continue;
      const zeros = part([k, n], [k, n]).every((row) => row.every((entry) => entry === "0"));
      if (!zeros || !same(part([0, k], [0, k]), first) || !same(part([k, n], [0, k]), second)) continue;
      if (!same(part([0, k], [k, n]), transposed(second))) continue;
      return bracketed([
        [square, `${rows}^T`],
        [rows, "\\mathbf{0}"],
      ]);
    }
  return null;
}

/**
 * Rows in which matrices of more than one column that are too wide have names for their entries, explained where the
 * matrix is first written, or for their blocks, which rows of their own explain.
 * @param {Row[]} rows @param {number} most em @param {import("./linebreak.js").Wide} wide @param {(text: string) => string[]} sidesOf
 */
export function named(rows, most, wide, sidesOf) {
  /** @type {Map<string, string>} */
  const known = new Map();
  const told = namedIn(rows, sidesOf);
  let name = "";
  return rows.flatMap((row) => {
    const [left, right] = sidesOf(row.text);
    if (weight(left)) name = left;
    if (wide(row.text.replace(/&/, "")) <= most) return [row];
    const [, body] = right.match(ALONE) ?? [];
    const entries = body ? entriesOf(body) : [];
    if (!body || entries[0].length < 2 || !NAME.test(name))
      return [
        {
          ...row,
          text: withMatrices(row.text, (matrix, parts) => known.get(matrix) ?? byBlocks(parts, told) ?? matrix),
        },
      ];
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
