/**
 * Equations of one formula beside each other, where height is dearer than width: what an equation is equal to goes on in
 * its row, and equations that are one row each share rows, as far as they have room. An equation that needs more rows, or
 * is equivalent to another, stands alone, so that it is always clear what follows from what.
 */

import { withMatrices } from "./latex.js";
import { isHeavy } from "./linebreak.js";
import { CALLED, MATRIX, equationsOf, isEquivalent, plain } from "./parts.js";

/** @typedef {import("./parts.js").Row} Row */
/** @typedef {import("./parts.js").Part} Part */
/** @typedef {(latex: string) => number} Wide  in em */

/** Between two equations, as LaTeX and in em. */
const [BETWEEN, APART] = [" \\qquad ", 2];
/** A row beside another has gaps at its relation. */
const RELATED = 0.3;

/** Below a row, whatever gap it has where there is room. */
const SMALL_GAP = " \\\\[0.1em] ";
/** A fraction of numbers, which is as easily read when it is small. */
const NUMERIC = /\\frac(?=\{\d+\}\{\d+\})/g;
/**
 * A matrix that has been written out under its name is called by it from there on; where that leaves a row that says what
 * the one above it says, it is left out.
 * @param {Part[]} parts
 */
export function calledByName(parts) {
  /** By what is seen of them: terms may have come from elsewhere. @type {Map<string, string>} */
  const names = new Map();
  let name = "";
  return parts.flatMap((part, i) => {
    if (part.left && !isEquivalent(part)) name = part.left;
    const right = withMatrices(part.right, (matrix) => names.get(plain(matrix)) ?? matrix);
    const [, matrix] = part.right.match(MATRIX) ?? [];
    if (matrix && CALLED.test(plain(name)) && !names.has(plain(matrix))) {
      names.set(plain(matrix), name);
      return [part];
    }
    return isEquivalent(part) && right !== part.right && plain(right) === plain(parts[i - 1]?.right ?? "")
      ? []
      : [{ ...part, right }];
  });
}

/** Two rows as one. @param {Part} one @param {Part} next @param {string} between @returns {Part} */
const beside = (one, next, between) => ({
  left: one.left,
  right: `${one.right}${between}${next.left} ${next.right}`,
  gap: next.gap,
});

/** Each part goes on in the row before it where that has room. @param {Part[]} parts @param {number} room @param {string} between @param {number} apart @param {Wide} wide */
function inRows(parts, room, between, apart, wide) {
  /** @type {Part[]} */
  const rows = [];
  let taken = Infinity;
  for (const part of parts) {
    const needed = apart + wide(part.left) + wide(part.right);
    const last = rows.at(-1);
    if (last && taken + needed <= room) {
      rows[rows.length - 1] = beside(last, part, between);
      taken += needed;
    } else {
      rows.push(part);
      taken = wide(part.right);
    }
  }
  return rows;
}

/**
 * The rows of a formula, joined as far as they fit in `room` em.
 * @param {readonly Part[]} given @param {number} room @param {(latex: string) => {width: number}} measure @returns {Row[]}
 */
export function joinedRows(given, room, measure) {
  const wide = (/** @type {string} */ latex) => measure(latex).width;
  const small = (/** @type {string} */ side) => side.replace(NUMERIC, "\\tfrac");
  const parts = calledByName(given.map((part) => ({ ...part, left: small(part.left), right: small(part.right) })));
  // Heavy left sides will have rows of their own.
  const lefts = parts.map(({ left }) => wide(left)).filter((left) => !isHeavy(left, room));
  const right = room - Math.max(0, ...lefts);
  /** @type {Part[]} */
  const rows = [];
  /** @type {Part[]} */
  const short = [];
  const settle = () => rows.push(...inRows(short.splice(0), right, BETWEEN, APART, wide));
  for (const equation of equationsOf(parts)) {
    const own = inRows(equation, right, " ", RELATED, wide);
    if (own.length === 1 && !equation.some(isEquivalent)) short.push(...own);
    else {
      settle();
      rows.push(...own);
    }
  }
  settle();
  return rows.map(({ left, right: text, gap }) => ({ text: `${left}& ${text}`, gap: gap && SMALL_GAP }));
}
