/**
 * A formula term by term: Enter begins, the arrows lead from one to the next, Escape leaves. Each is said and framed, and
 * told by the event "term", so that what it speaks of is lit.
 */

import { led, termsOf } from "../model/spoken.js";
import { termsIn } from "./terms.js";

/** @typedef {{formula: HTMLElement, terms: string[], at: number, frame: HTMLElement, watch: MutationObserver}} Walk */

/** The region of the page that is read when it changes. @param {string} words */
function say(words) {
  const announcer = document.getElementById("announcer");
  if (announcer) announcer.textContent = words;
}

/** What is drawn: above and below the line of a fraction, too. @param {Element} symbol */
const drawn = (symbol) =>
  [symbol, ...symbol.querySelectorAll("*")].filter((one) => !one.childElementCount && (one.textContent ?? "").trim());

/** @param {Element[]} symbols */
function boxOf(symbols) {
  const boxes = symbols
    .flatMap(drawn)
    .map((one) => one.getBoundingClientRect())
    .filter(({ width }) => width > 0);
  const [left, top] = [Math.min(...boxes.map((box) => box.left)), Math.min(...boxes.map((box) => box.top))];
  const [right, bottom] = [Math.max(...boxes.map((box) => box.right)), Math.max(...boxes.map((box) => box.bottom))];
  return boxes.length ? { left, top, width: right - left, height: bottom - top } : null;
}

/** The symbols of the term; where the page cannot tell the terms apart, of the whole. @param {Walk} walk */
function symbolsOf({ formula, terms, at }) {
  const seen = termsIn(formula);
  return seen.length === terms.length ? seen[at] : seen.flat();
}

/** @param {HTMLElement} formula @param {Element[]} symbols */
const tell = (formula, symbols) => formula.dispatchEvent(new CustomEvent("term", { bubbles: true, detail: symbols }));

/** Puts the frame around the term. @param {Walk} walk */
function place(walk) {
  const { formula, frame } = walk;
  const box = boxOf(symbolsOf(walk));
  const { left, top } = formula.getBoundingClientRect();
  if (!frame.isConnected) formula.append(frame);
  frame.hidden = !box;
  if (!box) return;
  const [x, y] = [box.left - left + formula.scrollLeft, box.top - top + formula.scrollTop];
  frame.style.cssText = `left:${x}px;top:${y}px;width:${box.width}px;height:${box.height}px`;
}

export class Exploring {
  /** @type {Walk | null} */
  #walk = null;

  /** @param {KeyboardEvent} event @param {import("../model/spoken.js").Said} said */
  press(event, said) {
    const formula = /** @type {HTMLElement} */ (event.currentTarget);
    const { key, ctrlKey, metaKey, altKey } = event;
    if (ctrlKey || metaKey || altKey) return;
    if (this.#walk?.formula !== formula) {
      if (key !== "Enter" || !this.#begin(formula, termsOf(said))) return;
    } else if (!this.#step(this.#walk, key)) return;
    // The arrows are those of the formula now, not those of the lecture.
    event.preventDefault();
    event.stopPropagation();
  }

  /** @param {HTMLElement} formula @param {string[]} terms */
  #begin(formula, terms) {
    if (!terms.length) return false;
    this.leave();
    const frame = Object.assign(document.createElement("span"), { className: "term-frame" });
    /** @type {Walk} */
    const walk = { formula, terms, at: 0, frame, watch: new MutationObserver(() => place(walk)) };
    this.#walk = walk;
    // Readers of screens hand the arrows on to what says that it knows them.
    formula.setAttribute("role", "application");
    // It may be typeset anew meanwhile: in rows, or with other marks.
    walk.watch.observe(formula, { childList: true, subtree: true });
    this.#show(walk);
    return true;
  }

  /** @param {Walk} walk @param {string} key */
  #step(walk, key) {
    const at = led(key, walk.at, walk.terms.length);
    if (at === undefined) return false;
    if (at === null) this.leave();
    else this.#show(Object.assign(walk, { at }));
    return true;
  }

  /** @param {Walk} walk */
  #show(walk) {
    say(walk.terms[walk.at]);
    place(walk);
    tell(walk.formula, symbolsOf(walk));
    walk.frame.scrollIntoView({ block: "nearest", inline: "nearest" });
  }

  /** No formula is walked through. */
  leave() {
    if (!this.#walk) return;
    this.#walk.watch.disconnect();
    this.#walk.frame.remove();
    this.#walk.formula.setAttribute("role", "img");
    tell(this.#walk.formula, []);
    this.#walk = null;
    say("");
  }
}
