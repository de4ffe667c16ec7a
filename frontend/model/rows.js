/** A long formula as rows that are typeset one by one: what stands in each, how high it will be, and at which size all of them fit. */

import { brokenRows, rowsOf, sidesOf } from "./linebreak.js";
import { joinedRows } from "./joining.js";
import { sizeOf } from "./measure.js";
import { partOf } from "./parts.js";
import { abbreviated } from "./shorthand.js";

/** @typedef {{left: string, right: string, above: number, below: number}} Row  above and below the baseline, in em */
/** @typedef {{rows: Row[], part: number}} Plan  part: of their size, at which the rows fit */
/**
 * @typedef {{bearable: number, smallest: number, close?: boolean, brief?: boolean}} Form  parts of their size: rows are
 *   rather broken than smaller than is bearable, and again where they are still smaller than the smallest; close: rows
 *   that have room in one are one; brief: in shorthand, too
 */

/** Plans whose letters differ by less are as large. */
const ALIKE = 1.01;
/** Broken rows are to fit at this size. */
const COMFORTABLE = 0.85;
/** What cannot be broken stays wider: then all is broken into shorter rows. */
const SHARES = [1, 0.7, 0.45];
/** What is estimated is rarely wider in the end by more than this. */
const MARGIN = 1.04;
/** A row is never less high than a bracket. */
const STRUT = { height: 0.84, depth: 0.36 };

/** Rows are broken at widths that are powers of this one: sizes that are nearly the same have the same rows. */
const GRID = 0.98;

/** @param {import("./joining.js").Row} row as LaTeX has it, with the gap below it @param {typeof sizeOf} measure */
function rowOf({ text, gap }, measure) {
  const [left, right] = sidesOf(text).map((side) => side.replace(/&$/, "").trim());
  const [before, after] = [measure(left), measure(right)];
  const [, below] = gap.match(/\[([\d.]+)em\]/) ?? [];
  return {
    left,
    right,
    widths: [before.width, after.width],
    above: Math.max(STRUT.height, before.height, after.height),
    below: Math.max(STRUT.depth + Number(below ?? 0), before.depth, after.depth),
  };
}

/** What a function has answered to a text is not asked again. @template T @param {(text: string) => T} asked @returns {(text: string) => T} */
function remembering(asked) {
  /** @type {Map<string, T>} */
  const known = new Map();
  return (text) => {
    const found = known.get(text) ?? asked(text);
    known.set(text, found);
    return found;
  };
}

/** @param {number} width */
const onGrid = (width) => GRID ** Math.ceil(Math.log(width) / Math.log(GRID));

/** A formula that is to be laid out, at one size after the other: what it is measured by is worked out once. @param {string} latex */
export function layoutOf(latex) {
  const given = rowsOf(latex);
  const measure = remembering(sizeOf);
  const wide = (/** @type {string} */ text) => measure(text).width;
  /** @type {Map<string, {rows: ReturnType<typeof rowOf>[], wide: number}>} */
  const measured = new Map();
  const parts = given.map(partOf);
  /** @type {import("./parts.js").Part[][] | null} */
  let short = null;
  const inShorthand = () => (short ??= abbreviated(parts));

  /** @param {import("./joining.js").Row[]} rows @param {number} most  em that each may be wide at most @param {boolean} close */
  function broken(rows, most, close) {
    const key = `${close} ${most.toFixed(4)}\n${rows.map(({ text }) => text).join("\n")}`;
    const known = measured.get(key);
    if (known) return known;
    const set = (most < Infinity ? brokenRows(rows, most, wide, close) : rows).map((row) => rowOf(row, measure));
    const [left, right] = [0, 1].map((side) => Math.max(...set.map(({ widths }) => widths[side])));
    const made = { rows: set, wide: left + right };
    measured.set(key, made);
    return made;
  }

  /**
   * Rows in a place `room` em wide, broken where they would become too small.
   * @param {import("./joining.js").Row[]} start @param {number} room @param {Form} form @returns {Plan}
   */
  function fittedRows(start, room, { bearable, smallest, close = false }) {
    const fitted = (/** @type {number} */ most) => {
      const { rows, wide: needed } = broken(start, most, close);
      return { rows, part: Math.min(1, room / (needed * MARGIN)) };
    };
    let best = fitted(Infinity);
    if (best.part >= bearable) return best;
    const most = room / (MARGIN * Math.max(bearable, COMFORTABLE));
    for (const one of SHARES) {
      const next = fitted(onGrid(one * most));
      if (next.part > best.part) best = next;
      if (best.part >= smallest) break;
    }
    return best;
  }

  return {
    /** Its rows in a place `room` em wide. @param {number} room @param {Form} form @returns {Plan} */
    planned(room, form) {
      const starts = form.brief ? inShorthand() : [parts];
      const plans = (form.close ? starts.map((start) => joinedRows(start, room / MARGIN, measure)) : [given]).map(
        (start) => fittedRows(start, room, form),
      );
      return plans.reduce((best, next) => (roomier(next, best) ? next : best));
    },
  };
}

/** Whether one plan makes larger letters than another, or is less high. @param {Plan} one @param {Plan} other */
function roomier(one, other) {
  const height = (/** @type {Plan} */ { rows }) => rows.reduce((sum, { above, below }) => sum + above + below, 0);
  return one.part > other.part * ALIKE || (one.part >= other.part / ALIKE && height(one) < height(other));
}

/** The rows of a formula in one place. @param {string} latex @param {number} room @param {Form} form */
export const planned = (latex, room, form) => layoutOf(latex).planned(room, form);
