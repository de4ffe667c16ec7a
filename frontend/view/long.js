/** A long formula: its rows, and what is said of it. */

import { layoutOf } from "../model/rows.js";
import { SMALLEST, bearableIn, isNamed, resize, rowsIn, typeset } from "./typesetting.js";

/** @typedef {{cell: HTMLElement, latex: string}} Due  a cell, and what is to stand in it */

/** Formulas are larger than text of their size. */
const LARGER = 1.08;

/** @param {string} tag @param {string} className */
const made = (tag, className) => Object.assign(document.createElement(tag), { className });

/** Em that a row has. @param {HTMLElement} element @param {CSSStyleDeclaration} style */
function roomOf(element, style) {
  const size = parseFloat(style.fontSize) / (Number(style.getPropertyValue("--fit")) || 1);
  return (element.clientWidth - parseFloat(style.paddingLeft) - parseFloat(style.paddingRight)) / (size * LARGER);
}

/** @param {Due} due */
function fill({ cell, latex }) {
  cell.dataset.latex = latex;
  if (latex) typeset(cell, `{\\displaystyle ${latex}}`, false, "html");
  else cell.replaceChildren();
}

/** Hundredths are enough. @param {HTMLElement} element @param {number} part */
const shrink = (element, part) => resize(element, Math.floor(part * 100) / 100);

export class Long {
  latex = "";
  #layout = layoutOf("");
  /** For which it was planned: pixels, em, and whether rows share rows, in shorthand or not. */
  width = 0;
  #room = 0;
  #form = { close: false, brief: false };
  #grid = made("div", "rows");
  #said = made("span", "katex");
  /** What is missing yet. @type {Due[]} */
  #due = [];

  /** @param {HTMLElement} element */
  constructor(element) {
    this.element = element;
  }

  /** Whether it has something else to say. @param {string} latex */
  tell(latex) {
    if (this.latex === latex) return false;
    Object.assign(this, { latex, width: 0 });
    this.#layout = layoutOf(latex);
    this.#due = [];
    // What stands there already stays until the rows have their places.
    if (!this.element.firstChild) this.element.append(this.#grid, this.#said);
    return true;
  }

  /** Gives the rows their places; whether they have others now. */
  plan() {
    const { element } = this;
    const width = element.clientWidth;
    if (!width) return false;
    const style = getComputedStyle(element);
    const room = roomOf(element, style);
    const form = rowsIn(style);
    const same = this.#form.close === form.close && this.#form.brief === form.brief;
    if (this.width === width && Math.abs(this.#room - room) < 0.01 && same) return false;
    [this.#room, this.#form] = [room, form];
    const { rows, part } = this.#layout.planned(room, { bearable: bearableIn(style), smallest: SMALLEST, ...form });
    this.width = width;
    shrink(element, part);
    this.#place(rows);
    if (!element.contains(this.#grid)) element.replaceChildren(this.#grid, this.#said);
    return true;
  }

  /** Cells as the rows need them; what stands in them already stays until its turn comes. @param {import("../model/rows.js").Row[]} rows */
  #place(rows) {
    const grid = this.#grid;
    while (grid.childElementCount > 2 * rows.length) grid.lastChild?.remove();
    while (grid.childElementCount < 2 * rows.length) grid.append(made("div", "cell"));
    const cells = /** @type {HTMLElement[]} */ ([...grid.children]);
    rows.forEach(
      ({ above, below }, i) =>
        (cells[2 * i + 1].style.cssText = `--above:${above.toFixed(3)}em;--below:${below.toFixed(3)}em`),
    );
    // Left sides first: the right ones stand beside the widest of them.
    const due = [
      ...rows.map(({ left }, i) => ({ cell: cells[2 * i], latex: left })),
      ...rows.map(({ right }, i) => ({ cell: cells[2 * i + 1], latex: `{}${right}` })),
    ];
    this.#due = due.filter(({ cell, latex }) => (cell.dataset.latex ?? "") !== latex);
  }

  /** Typesets cells as long as there is time; whether all of them are. @param {() => boolean} inTime */
  fill(inTime) {
    this.#grid.classList.remove("resting");
    while (this.#due.length && inTime()) fill(/** @type {Due} */ (this.#due.shift()));
    return !this.#due.length;
  }

  /** Rows that are wider than was estimated become smaller, by a little more: letters have whole pixels in some browsers. */
  correct() {
    const { clientWidth: width, scrollWidth: needed, style } = this.element;
    if (needed > width)
      shrink(this.element, (Number(style.getPropertyValue("--fit")) || 1) * ((0.98 * width) / needed));
  }

  /** Out of sight it is not drawn. */
  rest() {
    this.#grid.classList.add("resting");
  }

  get resting() {
    return this.#grid.classList.contains("resting");
  }

  say() {
    if (isNamed(this.element)) return;
    const words = made("span", "katex-mathml");
    typeset(words, this.latex, true, "mathml");
    this.#said.replaceChildren(words);
  }
}
