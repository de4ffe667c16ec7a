/** A long formula as rows that are typeset one by one: what stands in each, how high it will be, and at which size all of them fit. */

import { brokenRows, rowsOf, sidesOf } from "./linebreak.js";
import { sizeOf } from "./measure.js";

/** @typedef {{left: string, right: string, above: number, below: number}} Row  above and below the baseline, in em */
/** @typedef {{rows: Row[], part: number}} Plan  part: of their size, at which the rows fit */

/** Broken rows are to fit at this size. */
const COMFORTABLE = 0.85;
/** Terms are counted by their letters when rows are broken: what is still too wide is broken into shorter ones. */
const SHARES = [1, 0.7, 0.45];
/** What is estimated is rarely wider in the end by more than this. */
const MARGIN = 1.05;
/** A row is never less high than a bracket. */
const STRUT = { height: 0.84, depth: 0.36 };

/** @param {{text: string, gap: string}} row as LaTeX has it, with the gap below it */
function rowOf({ text, gap }) {
  const [left, right] = sidesOf(text).map((side) => side.replace(/&$/, "").trim());
  const [before, after] = [sizeOf(left), sizeOf(right)];
  const [, below] = gap.match(/\[([\d.]+)em\]/) ?? [];
  return {
    left,
    right,
    widths: [before.width, after.width],
    above: Math.max(STRUT.height, before.height, after.height),
    below: Math.max(STRUT.depth + Number(below ?? 0), before.depth, after.depth),
  };
}

/** @param {ReturnType<typeof rowsOf>} given @param {number} room */
function fitted(given, room) {
  const rows = given.map(rowOf);
  const wide = [0, 1].map((side) => Math.max(...rows.map(({ widths }) => widths[side])));
  return { rows, part: Math.min(1, room / ((wide[0] + wide[1]) * MARGIN)) };
}

/**
 * The rows of a formula in a place `room` em wide; they are broken where they would become too small.
 * @param {string} latex @param {number} room
 * @param {{bearable: number, smallest: number}} least  parts of their size: rows are rather broken than smaller than is bearable, and again where they are still smaller than the smallest
 * @returns {Plan}
 */
export function planned(latex, room, { bearable, smallest }) {
  const whole = fitted(rowsOf(latex), room);
  if (whole.part >= bearable) return whole;
  const share = whole.part / Math.max(bearable, COMFORTABLE);
  let best = whole;
  for (const one of SHARES) {
    best = fitted(brokenRows(latex, one * share), room);
    if (best.part >= smallest) break;
  }
  return best;
}
