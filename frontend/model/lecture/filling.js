/**
 * How large the formulas of a slide may be: as large as its pane has room for, so that they are read from the last row.
 * Everything is measured by the shorter side of the screen, so that one rule holds for projectors and for phones.
 */

import { layoutOf } from "../rows.js";

/** Parts of the shorter side of the screen: no formula is larger, and none is made smaller to save room. */
const LARGEST = 0.07;
const LEAST = 0.024;
/** No letters are smaller than this many pixels. */
const LEGIBLE = 15;
/** Parts of the height that formulas may fill, and of their size below which rows are broken. */
const FULL = 0.97;
const BEARABLE = 0.92;
const SMALLEST = 0.56;
/** From one size that is tried to the next; the least that is read from the last row is tried, too, and a little more. */
const FINER = 0.97;
const JUST = [1.04, 1.015, 1.002];
/** Sizes that are as good as the same. */
const SAME = 0.99;
/** Shorthand is worth it where it makes letters larger by this. */
const WORTH = 1.05;
/** Part of the shorter side of the screen from which on letters are read from the last row. */
const FAR = 0.05;
/** KaTeX sets formulas larger than text, and there is a gap between their rows and around them, in em. */
const LARGER = 1.08;
const GAP = { open: 0.3, close: 0.15 };
const AROUND = 1.1;

/** @typedef {{latex: string, share: number, indent?: number}} Natural  share: of the size of the result that it has; indent: pixels at its side */
/** @typedef {{width: number, height: number}} Pane  what is left for formulas, in pixels */
/** @typedef {Natural & {layout: ReturnType<typeof layoutOf>}} Formula */
/** @typedef {{size: number, reached: number, far: boolean, close: boolean, brief: boolean}} Filling  pixels that are asked for, and that are reached, 0 where they do not fit; far: read from the last row; close: rows share rows; brief: in shorthand */

/** What is worked out once for all sizes. @param {Natural} natural @returns {Formula} */
export const formulaOf = (natural) => ({ ...natural, layout: layoutOf(natural.latex) });

/** @param {number} screen  pixels of the shorter side @returns {{largest: number, least: number}} pixels */
export const bounds = (screen) => ({ largest: LARGEST * screen, least: Math.max(LEGIBLE, LEAST * screen) });

/**
 * How high a formula is at a size, and at which part of it all of its rows fit.
 * @param {Formula} formula @param {number} size @param {number} width @param {boolean} [close] @param {boolean} [brief]
 */
export function laidOut({ layout, share, indent = 0 }, size, width, close = false, brief = false) {
  const own = size * share;
  const { rows, part } = layout.planned((width - indent) / (own * LARGER), {
    bearable: BEARABLE,
    smallest: SMALLEST,
    close,
    brief,
  });
  const gap = close ? GAP.close : GAP.open;
  const em = rows.reduce((sum, { above, below }) => sum + above + below + gap, -gap);
  return { part, height: own * part * (LARGER * em + AROUND) };
}

/** From large to small. @param {number} screen */
function sizesOn(screen) {
  const { largest, least } = bounds(screen);
  const count = 1 + Math.floor(Math.log(least / largest) / Math.log(FINER));
  const steps = Array.from({ length: count }, (_, i) => largest * FINER ** i);
  return [...steps, ...JUST.map((part) => (part * FAR * screen) / LARGER)].sort((a, b) => b - a);
}

/** @param {readonly Formula[]} formulas @param {Pane} pane @param {number} screen @param {boolean} close @param {boolean} [brief] @returns {Filling} */
function filled(formulas, pane, screen, close, brief = false) {
  let best = { size: bounds(screen).least, reached: 0 };
  for (const size of sizesOn(screen)) {
    if (size <= SAME * best.reached) break;
    const set = formulas.map((formula) => laidOut(formula, size, pane.width, close, brief));
    if (set.reduce((sum, { height }) => sum + height, 0) > FULL * pane.height) continue;
    const reached = size * (set[0]?.part ?? 1);
    if (reached >= SAME * best.reached) best = { size, reached: Math.max(reached, best.reached) };
  }
  return { ...best, far: LARGER * best.reached >= FAR * screen, close, brief };
}

/** @template {Filling} T @param {T} one @param {T} other @returns {T} the one that is larger, the first if they are about the same, and the second if neither fits */
export const larger = (one, other) => (one.reached > 0 && one.reached >= SAME * other.reached ? one : other);

/** @template {Filling} T @param {T} one @param {T} other @returns {T} the first that is read from the last row, else the larger */
export const better = (one, other) => (one.far ? one : other.far ? other : larger(one, other));

/**
 * The size in pixels at which the formulas of a slide fill its pane, and whether that is large enough to be read from
 * the last row. Where a larger size only breaks more rows, or makes them smaller again, the smaller one stays: a formula
 * that cannot be broken shrinks no further than it must. Rows share rows only where that makes them larger and they
 * would not be read from the last row else.
 * @param {readonly Formula[]} formulas  the first is what it is about @param {Pane} pane @param {number} screen  its shorter side
 */
export function filling(formulas, pane, screen) {
  const open = filled(formulas, pane, screen, false);
  return open.far ? open : better(open, filled(formulas, pane, screen, true));
}

/** The same in shorthand. @param {readonly Formula[]} formulas @param {Pane} pane @param {number} screen */
export const fillingBriefly = (formulas, pane, screen) => filled(formulas, pane, screen, true, true);

/** What is in shorthand only where that is worth it. @template {Filling} T @param {T} written @param {T} brief @returns {T} */
export const worthwhile = (written, brief) =>
  brief.reached >= WORTH * written.reached || (brief.far && !written.far) ? brief : written;
