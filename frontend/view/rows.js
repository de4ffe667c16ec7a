/** Long formulas: their rows have their places at once and are typeset a few to a frame, where they are seen. */

import { Long } from "./long.js";

/** Milliseconds of a frame for typesetting; to lay out and draw what was typeset takes three times as long. */
const SLICE = 8;

/** @param {HTMLElement} element */
const isSeen = (element) => element.firstElementChild?.checkVisibility({ contentVisibilityAuto: true }) ?? false;

/** The long formulas of a page: whose turn it is. */
export class Rows {
  /** @type {WeakMap<HTMLElement, Long>} */
  #long = new WeakMap();
  /** Those of which rows are missing. @type {Set<Long>} */
  #unfinished = new Set();
  /** Those that cannot be heard yet. @type {Set<Long>} */
  #unsaid = new Set();
  /** Those that are complete, but may be wider than was estimated. @type {Long[]} */
  #complete = [];
  /** Those that have been told and not yet been given a place. @type {HTMLElement[]} */
  #fresh = [];
  #asked = false;

  /** What a formula says: to screen readers before it is seen, in rows when it is. @param {HTMLElement} element @param {string} latex */
  tell(element, latex) {
    const long = this.#long.get(element) ?? new Long(element);
    this.#long.set(element, long);
    if (!long.tell(latex)) return;
    // Before anything is drawn or scrolled to, those that are seen have their places.
    if (!this.#fresh.length) queueMicrotask(() => this.arrange(this.#fresh.splice(0).filter(isSeen)));
    this.#fresh.push(element);
    this.#unsaid.add(long);
  }

  /** Gives the rows of formulas their places. @param {Iterable<Element>} elements */
  arrange(elements) {
    for (const long of this.#known(elements)) if (long.plan()) this.#unfinished.add(long);
    this.wake();
  }

  /** @param {Iterable<Element>} elements */
  #known(elements) {
    return [...elements].flatMap((element) => this.#long.get(/** @type {HTMLElement} */ (element)) ?? []);
  }

  /** Formulas that have gone out of sight: when they are seen again, they are drawn one after the other. @param {Iterable<Element>} elements */
  rest(elements) {
    for (const long of this.#known(elements)) {
      if (!long.width) continue;
      long.rest();
      this.#unfinished.add(long);
    }
    this.wake();
  }

  /** Goes on in the next frame. */
  wake() {
    if (!this.#asked) requestAnimationFrame(this.#slice);
    this.#asked = true;
  }

  /** A few rows of those formulas that are seen, and then what can be heard of all; rows of others wait until they are seen. */
  #slice = () => {
    this.#asked = false;
    const end = performance.now() + SLICE;
    const inTime = () => performance.now() < end;
    this.#correct();
    for (const long of this.#unfinished) if (!long.element.isConnected) this.#unfinished.delete(long);
    const seen = [...this.#unfinished].filter(({ element }) => isSeen(element));
    const resting = seen.find((long) => long.resting);
    for (const long of resting ? [resting] : seen) if (inTime()) this.#fill(long, inTime);
    for (const long of this.#unsaid) {
      if (!inTime()) break;
      this.#unsaid.delete(long);
      if (long.element.isConnected) long.say();
    }
    if (seen.length || this.#complete.length || this.#unsaid.size) this.wake();
  };

  /** @param {Long} long @param {() => boolean} inTime */
  #fill(long, inTime) {
    if (!long.fill(inTime)) return;
    this.#unfinished.delete(long);
    this.#complete.push(long);
  }

  #correct() {
    for (const long of this.#complete.splice(0)) long.correct();
  }

  /** All there is, at once: for paper. */
  finish() {
    this.arrange(document.querySelectorAll(".formula"));
    this.#unfinished.forEach((long) => this.#fill(long, () => true));
    this.#correct();
  }
}
