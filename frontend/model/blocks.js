/** Matrices in blocks: [M Aᵀ; A 0] where M and A are written out beside it, and the columns that belong to it. */

import { entriesOf, withMatrices } from "./latex.js";
import { sizeOf } from "./measure.js";
import { MATRIX, plain } from "./parts.js";

/** @typedef {import("./parts.js").Part} Part */
/** @typedef {{name: string, entries: string[][]}} NamedMatrix  entries: what is seen of them */

/** A matrix or column by itself. */
const CALLED = /^\\mathbf [a-zA-Z](?: _ \w)?$/;
const BODY = /^\\begin\{bmatrix\}([\s\S]*)\\end\{bmatrix\}$/;
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

/** Matrices whose blocks have names, and the columns that belong to them. @param {readonly Part[]} parts */
export function inBlocks(parts) {
  const named = namedIn(parts);
  return parts.map((part) => {
    /** @type {{at: number, size: number} | null} */
    let cutAt = null;
    const right = withMatrices(part.right, (matrix, entries) => {
      const seen = entries.map((row) => row.map(plain));
      const found = blocksOf(seen, named);
      if (found) cutAt = { at: found.at, size: seen.length };
      if (found) return bracketed(found.names);
      if (!cutAt || entries[0].length > 1 || entries.length !== cutAt.size) return matrix;
      const halves = [entries.slice(0, cutAt.at), entries.slice(cutAt.at)];
      const block = (/** @type {string[][]} */ half) => columnName(half, named) ?? lying(half.map(([entry]) => entry));
      return bracketed(halves.flatMap(block).map((entry) => [entry]));
    });
    return { ...part, right };
  });
}

/** @param {string[][]} column @param {readonly NamedMatrix[]} named */
function columnName(column, named) {
  const seen = column.map((row) => row.map(plain));
  return named.find(({ entries }) => same(entries, seen))?.name ?? null;
}
