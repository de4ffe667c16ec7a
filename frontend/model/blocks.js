/** Matrices in blocks: [M Aᵀ; A 0] where M and A are written out beside it, and the columns that belong to it. */

import { calledByName } from "./joining.js";
import { entriesOf, withMatrices } from "./latex.js";
import { sizeOf } from "./measure.js";
import { MATRIX, plain } from "./parts.js";

/** @typedef {import("./parts.js").Part} Part */
/** @typedef {{name: string, entries: string[][]}} NamedMatrix  entries: what is seen of them */

/** A matrix or column by itself. */
const CALLED = /^\\mathbf [a-zA-Z](?: _ \w)?$/;
const BODY = /^\\begin\{bmatrix\}([\s\S]*)\\end\{bmatrix\}$/;
/** What such a one is equal to where it is one line. */
const LINE = /^(?:=|\\approx) (?:\\mathrm\{diag\}|\\left)\(/;
/** Em: entries that are higher make a matrix of two rows high. */
const HIGH = 1.5;
/** Em: a column lies in a line up to this width. */
const LYING = 16;

/** The entries of a matrix with its brackets. @param {string} matrix */
export const entriesWithin = (matrix) => entriesOf((matrix.match(BODY) ?? ["", ""])[1]);

/** Matrices written out under their names. @param {readonly Part[]} parts @returns {NamedMatrix[]} */
function namedIn(parts) {
  return parts.flatMap(({ left, right }) => {
    const [, matrix] = right.match(MATRIX) ?? [];
    return matrix && CALLED.test(plain(left)) ? [{ name: left, entries: seenOf(matrix) }] : [];
  });
}

/** @param {string} matrix */
const seenOf = (matrix) => entriesWithin(matrix).map((row) => row.map(plain));

const transposed = (/** @type {string[][]} */ entries) => entries[0].map((_, j) => entries.map((row) => row[j]));
const same = (/** @type {string[][]} */ one, /** @type {string[][]} */ other) =>
  JSON.stringify(one) === JSON.stringify(other);

/** The name of a block, or 0. @param {string[][]} block @param {readonly NamedMatrix[]} named @returns {string | null} */
function nameOf(block, named) {
  if (block.every((row) => row.every((entry) => entry === "0"))) return "\\mathbf{0}";
  const found = named.find(({ entries }) => same(entries, block));
  if (found) return found.name;
  const turned = named.find(({ entries }) => same(transposed(entries), block));
  return turned ? `${turned.name}^{T}` : null;
}

/** A square matrix in four blocks that have names, and how large the first is. @param {string[][]} entries @param {readonly NamedMatrix[]} named */
function blocksOf(entries, named) {
  if (entries.length !== entries[0].length) return null;
  for (const { entries: corner } of named) {
    const at = corner.length;
    if (at >= entries.length || at !== corner[0].length) continue;
    const halves = [entries.slice(0, at), entries.slice(at)];
    const names = halves.map((rows) =>
      [rows.map((row) => row.slice(0, at)), rows.map((row) => row.slice(at))].map((block) => nameOf(block, named)),
    );
    if (names.every((row) => row.every(Boolean))) return { at, names };
  }
  return null;
}

/** @param {readonly (readonly (string | null)[])[]} entries */
const bracketed = (entries) =>
  `\\begin{bmatrix} ${entries.map((row) => row.join(" & ")).join(" \\\\ ")} \\end{bmatrix}`;

/** A column as a row in the same line, or as it is where that would be long. @param {readonly string[]} entries */
function lying(entries) {
  const row = `\\left(${entries.join(",\\, ")}\\right)^{T}`;
  return entries.length > 1 && sizeOf(row).width <= LYING ? [row] : entries;
}

/** What the second derivatives of constraints leave on the right side, as in A q̈ = −γ. */
const REST = "-\\gamma";

/** Matrices whose blocks have names, and the columns that belong to them. @param {readonly Part[]} parts @returns {Part[]} */
export function inBlocks(parts) {
  const named = namedIn(parts);
  /** @type {Part[]} */
  const below = [];
  const blocks = parts.map((part) => {
    /** @type {{at: number, size: number} | null} */
    let cutAt = null;
    const right = withMatrices(part.right, (matrix, entries) => {
      const seen = entries.map((row) => row.map(plain));
      const found = blocksOf(seen, named);
      if (found) cutAt = { at: found.at, size: seen.length };
      if (found) return bracketed(found.names);
      if (!cutAt || entries[0].length > 1 || entries.length !== cutAt.size) return matrix;
      const halves = [entries.slice(0, cutAt.at), entries.slice(cutAt.at)];
      const block = (/** @type {string[][]} */ half) => {
        const name = columnName(half, named);
        if (name || isShort(half)) return name ?? lying(half.map(([entry]) => entry));
        below.push({ left: REST, right: `= ${bracketed(half)}`, gap: part.gap });
        return [REST];
      };
      return bracketed(halves.flatMap(block).map((entry) => [entry]));
    });
    return { ...part, right };
  });
  const names = named.map(({ name }) => name);
  const last = parts.reduce((found, { left }, i) => (names.includes(left) ? i + 1 : found), 0);
  return linesFirst(calledByName([...blocks.slice(0, last), ...below, ...blocks.slice(last)]).map(inLine));
}

/** Of what is written out one after the other, what is one line first: these share rows. @param {readonly Part[]} parts */
function linesFirst(parts) {
  const isNamed = (/** @type {Part} */ { left, right }) =>
    CALLED.test(plain(left)) && (MATRIX.test(right) || LINE.test(right));
  const first = parts.findIndex(isNamed);
  const behind = parts.findIndex((part, i) => i > first && !isNamed(part));
  if (first < 0) return [...parts];
  const end = behind < 0 ? parts.length : behind;
  const named = parts.slice(first, end);
  const [lines, matrices] = [LINE, MATRIX].map((form) => named.filter(({ right }) => form.test(right)));
  return [...parts.slice(0, first), ...lines, ...matrices, ...parts.slice(end)];
}

/** Whether a column has room in a line, or nothing to gain by a name. @param {string[][]} column */
const isShort = (column) =>
  sizeOf(lying(column.map(([entry]) => entry))[0]).width <= LYING && lying(column.map(([entry]) => entry)).length === 1;

/** A matrix by itself in one line, where it has one column or nothing but its diagonal, and is not written out again. @param {Part} part @param {number} at @param {readonly Part[]} parts */
function inLine(part, at, parts) {
  const [, matrix] = part.right.match(MATRIX) ?? [];
  const called = parts.slice(0, at + 1).reduce((last, { left }) => left || last, "");
  const again = (/** @type {Part} */ other) => other !== part && plain(other.right).includes(plain(matrix));
  if (!matrix || !CALLED.test(plain(called)) || (part.left ? parts : parts.slice(0, at)).some(again)) return part;
  const right = inOneLine(entriesWithin(matrix));
  return right ? { ...part, right: `${part.right.startsWith("=") ? "=" : "\\approx"} ${right}` } : part;
}

/** @param {string[][]} entries */
function inOneLine(entries) {
  const single = entries.every((row) => row.length === 1);
  const diagonal = entries.map((row, i) => row[i] ?? "");
  const square = entries.length > 1 && entries[0].length === entries.length;
  const bare = square && entries.every((row, i) => row.every((entry, j) => i === j || plain(entry) === "0"));
  const high = entries.length > 2 || diagonal.some((entry) => heightOf(entry) > HIGH);
  if (bare && high) return `\\mathrm{diag}(${diagonal.join(",\\, ")})`;
  const [row, ...more] = single ? lying(entries.map(([entry]) => entry)) : [];
  return row && !more.length && entries.length > 1 ? row : null;
}

/** @param {string} latex */
function heightOf(latex) {
  const { height, depth } = sizeOf(latex);
  return height + depth;
}

/** @param {string[][]} column @param {readonly NamedMatrix[]} named */
function columnName(column, named) {
  const seen = column.map((row) => row.map(plain));
  return named.find(({ entries }) => same(entries, seen))?.name ?? null;
}
