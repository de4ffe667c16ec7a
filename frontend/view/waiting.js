/** Work on parts of the page that nobody sees yet: done when there is nothing else to do, or as soon as one of them is looked at. */

import { whenIdle } from "./frames.js";

/** Milliseconds for which work goes on in one go, and after which what nobody sees has waited long enough. */
const SLICE = 8,
  IMPATIENCE = 300;

/**
 * Does the first of some things, if there is one, and more as long as there is time; takes away and returns what was done.
 * @template T
 * @param {number} time in milliseconds @param {T[]} things @param {(thing: T) => void} act
 */
function during(time, things, act) {
  const end = performance.now() + time;
  let done = 0;
  while (done < things.length && (done === 0 || performance.now() < end)) act(things[done++]);
  return things.splice(0, done);
}

export class Waiting {
  /** What is to be done with each element, in the order in which they came. @type {Map<HTMLElement, () => void>} */
  #work = new Map();
  /** Those that somebody sees now. @type {HTMLElement[]} */
  #sought = [];

  /** @param {HTMLElement} element */
  has(element) {
    return this.#work.has(element);
  }

  /** @param {HTMLElement} element @param {() => void} act */
  put(element, act) {
    if (!this.#work.size) whenIdle(this.#idle, IMPATIENCE);
    this.#work.set(element, act);
  }

  /** @param {HTMLElement} element */
  drop(element) {
    this.#work.delete(element);
  }

  /** @param {Node} place */
  #within(place) {
    return [...this.#work.keys()].filter((element) => place.contains(element));
  }

  #catchUp = (/** @type {HTMLElement} */ element) => {
    if (element.isConnected) this.#work.get(element)?.();
    this.drop(element);
  };

  #idle = () => {
    during(SLICE, [...this.#work.keys()], this.#catchUp);
    if (this.#work.size) whenIdle(this.#idle, IMPATIENCE);
  };

  #seek = () => {
    during(SLICE, this.#sought, this.#catchUp);
    if (this.#sought.length) requestAnimationFrame(this.#seek);
  };

  /** What has come into view goes before all others, so much at once that scrolling goes on; what closed details hide goes on waiting. @param {Node} place */
  hurry(place) {
    if (!this.#sought.length) requestAnimationFrame(this.#seek);
    this.#sought.push(...this.#within(place).filter((element) => !element.closest("details:not([open])")));
  }

  /** All that still waits on the page, at once. */
  finish() {
    this.#within(document).forEach(this.#catchUp);
  }
}
