/** Display formulas at the sizes at which they fit their columns; the long ones in rows, which are fetched when there is one. */

import { rowsOf } from "../model/linebreak.js";
import { bearableIn, resize, rowsIn, typeset } from "./typesetting.js";

/** LaTeX of more letters is typeset row by row. */
const LONG = 350;
/** What marks terms and symbols takes no room. */
const MARKS = /\\htmlClass\{[^}]*\}/g;

/** What a long step has out of sight has a size, but its content has none yet. @param {HTMLElement} element */
const laidOut = ({ firstElementChild: content }) =>
  !content || content.checkVisibility({ contentVisibilityAuto: true });

/**
 * What is too wide, and how small it would have to be. All is measured before anything is written, so that the page is
 * laid out once and not for each.
 * @param {HTMLElement[]} elements
 */
function measured(elements) {
  for (const element of elements) element.style.removeProperty("--fit");
  return elements.map((element) => {
    const [width, needed] = [element.clientWidth, element.scrollWidth];
    const part = needed > width ? Math.floor((width / needed) * 98) / 100 : 1;
    return { element, width, part, bearable: part < 1 ? bearableIn(getComputedStyle(element)) : 0 };
  });
}

export class Fitting {
  #observer = new ResizeObserver((entries) =>
    this.#fit(entries.map(({ target }) => /** @type {HTMLElement} */ (target))),
  );
  /** For which width each formula has its size. @type {WeakMap<HTMLElement, number>} */
  #widths = new WeakMap();
  /** What each formula says. @type {WeakMap<HTMLElement, string>} */
  #sources = new WeakMap();
  /** Those that are typeset row by row. @type {WeakSet<HTMLElement>} */
  #inRows = new WeakSet();
  /** @type {import("./rows.js").Rows | null} */
  #rows = null;

  /** There will be long formulas: how they are typeset is fetched before. */
  async expectLong() {
    const fetched = await import("./rows.js").catch(() => null);
    if (fetched) this.#rows ??= new fetched.Rows();
  }

  /** @param {HTMLElement} element @param {string} latex @param {boolean} atOnce  it is seen now */
  show(element, latex, atOnce) {
    this.#sources.set(element, latex);
    const inTurn = latex.replace(MARKS, "").length > LONG || this.#inRows.has(element);
    if (!inTurn || (atOnce && !this.#rows)) typeset(element, latex, true);
    if (inTurn) void this.#giveRows(element);
    else this.fitSoon(element);
  }

  /** Typesets a formula row by row, as it is seen. @param {HTMLElement} element */
  async #giveRows(element) {
    this.#inRows.add(element);
    const late = !this.#rows;
    if (late) element.dataset.late = "";
    if (late) await this.expectLong();
    delete element.dataset.late;
    const latex = this.#sources.get(element) ?? "";
    if (this.#rows) this.#rows.tell(element, latex);
    else typeset(element, latex, true); // too wide rather than empty, where the rest of the page has come and this has not
    this.fitSoon(element);
    if (late) element.dispatchEvent(new CustomEvent("grown", { bubbles: true }));
  }

  /** When it is laid out; what is observed anew is told of once, even if it has not changed. @param {HTMLElement} element */
  fitSoon(element) {
    this.#widths.delete(element);
    this.#observer.unobserve(element);
    this.#observer.observe(element);
  }

  /** Sets the sizes of formulas; those that would become too small go on below. @param {HTMLElement[]} elements */
  #fit(elements) {
    const seen = elements.filter((element) => element.clientWidth > 0 && laidOut(element));
    this.#rows?.arrange(seen.filter((element) => this.#inRows.has(element)));
    const due = seen.filter(
      (element) => !this.#inRows.has(element) && this.#widths.get(element) !== element.clientWidth,
    );
    for (const { element, width, part, bearable } of measured(due)) {
      this.#widths.set(element, width);
      if (part < 1) resize(element, part);
      else element.classList.remove("wide");
      // A lecture would rather have more lines than smaller ones, and lines beside each other where that is larger.
      if (part < bearable || this.#sharesRows(element)) void this.#giveRows(element);
    }
  }

  /** @param {HTMLElement} element */
  #sharesRows(element) {
    const { close, brief } = rowsIn(getComputedStyle(element));
    return brief || (close && rowsOf(this.#sources.get(element) ?? "").length > 1);
  }

  /** A formula of a long step has been scrolled to. @param {HTMLElement} target */
  seen(target) {
    if (this.#sources.has(target)) this.fitSoon(target);
    this.wake();
  }

  /** A formula, or a whole step, has gone out of sight. @param {HTMLElement} target */
  gone(target) {
    this.#rows?.rest(this.#sources.has(target) ? [target] : target.querySelectorAll(".formula"));
    this.wake();
  }

  /** What was far may be near now. */
  wake() {
    this.#rows?.wake();
  }

  /** All on the page, at once: for paper. */
  finish() {
    this.#fit([.../** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll(".formula"))]);
    this.#rows?.finish();
  }
}
