/** Long formulas: their rows have their places at once and are typeset a few to a frame, where they are seen. */

import { BEARABLE, SMALLEST, typeset } from "./formula.js";
import { planned } from "../model/rows.js";

/** @typedef {{cell: HTMLElement, latex: string}} Due  a cell, and what is to stand in it */
/** @typedef {{latex: string, width: number, grid: HTMLElement, said: HTMLElement, due: Due[]}} Held  a formula, the width for which it was planned, and what is missing yet */

/** Milliseconds of a frame for typesetting; to lay out and draw what was typeset takes three times as long. */
const SLICE = 8;
/** Formulas are larger than text of their size. */
const LARGER = 1.08;

/** @type {WeakMap<HTMLElement, Held>} */
const held = new WeakMap();
/** Formulas of which rows are missing. @type {Set<HTMLElement>} */
const unfinished = new Set();
/** Those that cannot be heard yet. @type {Set<HTMLElement>} */
const unsaid = new Set();
/** Those that are complete, but may be wider than was estimated. @type {HTMLElement[]} */
const complete = [];
/** Those that have been told and not yet been given a place. @type {HTMLElement[]} */
const fresh = [];
let asked = false;

/** @param {string} tag @param {string} className */
const made = (tag, className) => Object.assign(document.createElement(tag), { className });

/** What a formula says: to screen readers before it is seen, in rows when it is. @param {HTMLElement} element @param {string} latex */
export function tell(element, latex) {
  const known = held.get(element);
  if (known?.latex === latex) return;
  const { grid, said } = known ?? { grid: made("div", "rows"), said: made("span", "katex") };
  held.set(element, { latex, width: 0, grid, said, due: [] });
  // What stands there already stays until the rows have their places.
  if (!element.firstChild) element.append(grid, said);
  if (!fresh.length) queueMicrotask(receive);
  fresh.push(element);
  unsaid.add(element);
}

/** Before anything is drawn or scrolled to, those that are seen have their places. */
const receive = () => arrange(fresh.splice(0).filter(isSeen));

/** @param {HTMLElement} element */
const isSeen = (element) => element.firstElementChild?.checkVisibility({ contentVisibilityAuto: true }) ?? false;

/** @param {Held | undefined} formula */
function say(formula) {
  const words = made("span", "katex-mathml");
  if (formula) typeset(words, formula.latex, true, "mathml");
  formula?.said.replaceChildren(words);
}

/** Gives the rows of formulas their places. @param {HTMLElement[]} elements */
export function arrange(elements) {
  for (const element of elements) plan(element);
  wake();
}

/** @param {HTMLElement} element */
function plan(element) {
  const formula = held.get(element);
  const width = element.clientWidth;
  if (!formula || !width || formula.width === width) return;
  const style = getComputedStyle(element);
  const bearable = Number(style.getPropertyValue("--bearable")) || BEARABLE;
  const { rows, part } = planned(formula.latex, roomOf(element, style), { bearable, smallest: SMALLEST });
  formula.width = width;
  resize(element, part);
  place(formula, rows);
  if (!element.contains(formula.grid)) element.replaceChildren(formula.grid, formula.said);
  unfinished.add(element);
}

/** Em that a row has. @param {HTMLElement} element @param {CSSStyleDeclaration} style */
function roomOf(element, style) {
  const size = parseFloat(style.fontSize) / (Number(style.getPropertyValue("--fit")) || 1);
  return (element.clientWidth - parseFloat(style.paddingLeft) - parseFloat(style.paddingRight)) / (size * LARGER);
}

/** @param {HTMLElement} element @param {number} part */
function resize(element, part) {
  element.style.setProperty("--fit", String(Math.max(SMALLEST, Math.floor(part * 100) / 100)));
  element.classList.toggle("wide", part < SMALLEST);
}

/** Cells as the rows need them; what stands in them already stays until its turn comes. @param {Held} formula @param {import("../model/rows.js").Row[]} rows */
function place(formula, rows) {
  const { grid } = formula;
  while (grid.childElementCount > 2 * rows.length) grid.lastChild?.remove();
  while (grid.childElementCount < 2 * rows.length) grid.append(made("div", "cell"));
  const cells = /** @type {HTMLElement[]} */ ([...grid.children]);
  rows.forEach(({ above, below }, i) => (cells[2 * i + 1].style.cssText = `--above:${above.toFixed(3)}em;--below:${below.toFixed(3)}em`));
  // Left sides first: the right ones stand beside the widest of them.
  const due = [...rows.map(({ left }, i) => ({ cell: cells[2 * i], latex: left })), ...rows.map(({ right }, i) => ({ cell: cells[2 * i + 1], latex: `{}${right}` }))];
  formula.due = due.filter(({ cell, latex }) => (cell.dataset.latex ?? "") !== latex);
}

/** @param {Due} due */
function fill({ cell, latex }) {
  cell.dataset.latex = latex;
  if (latex) typeset(cell, `{\\displaystyle ${latex}}`, false, "html");
  else cell.replaceChildren();
}

/** Formulas that have gone out of sight: when they are seen again, they are drawn one after the other. @param {Iterable<HTMLElement>} elements */
export function rest(elements) {
  for (const element of elements) {
    const formula = held.get(element);
    if (!formula?.width) continue;
    formula.grid.classList.add("resting");
    unfinished.add(element);
  }
  wake();
}

/** A few rows of those formulas that are seen, and then what can be heard of all; rows of others wait until they are seen. */
function slice() {
  asked = false;
  const end = performance.now() + SLICE;
  const inTime = () => performance.now() < end;
  complete.splice(0).forEach(correct);
  for (const element of unfinished) if (!element.isConnected) unfinished.delete(element);
  const seen = [...unfinished].filter(isSeen);
  const resting = seen.find((element) => held.get(element)?.grid.classList.contains("resting"));
  for (const element of resting ? [resting] : seen) if (inTime()) fillOf(element, inTime);
  for (const element of unsaid) {
    if (!inTime()) break;
    unsaid.delete(element);
    if (element.isConnected) say(held.get(element));
  }
  if (seen.length || complete.length || unsaid.size) wake();
}

/** @param {HTMLElement} element @param {() => boolean} inTime */
function fillOf(element, inTime) {
  const { due, grid } = /** @type {Held} */ (held.get(element));
  grid.classList.remove("resting");
  while (due.length && inTime()) fill(/** @type {Due} */ (due.shift()));
  if (due.length) return;
  unfinished.delete(element);
  complete.push(element);
}

/** Goes on in the next frame. */
export function wake() {
  if (!asked) requestAnimationFrame(slice);
  asked = true;
}

/** Rows that are wider than was estimated become smaller, by a little more: letters have whole pixels in some browsers. @param {HTMLElement} element */
function correct(element) {
  const { clientWidth: width, scrollWidth: needed } = element;
  if (needed > width) resize(element, (Number(element.style.getPropertyValue("--fit")) || 1) * ((0.98 * width) / needed));
}

/** All there is, at once: for paper. */
export function finish() {
  document.querySelectorAll(".formula").forEach((element) => plan(/** @type {HTMLElement} */ (element)));
  unfinished.forEach((element) => fillOf(element, () => true));
  complete.splice(0).forEach(correct);
}
