/** Where the browser keeps what is typed. */

/** Nothing is ever there, and nothing can be written. @type {import("../model/homework/progress.js").Keeper} */
const REFUSING = {
  length: 0, key: () => null, getItem: () => null,
  setItem() {
    throw new Error("The browser keeps nothing for this page.");
  },
};

/** The browser's own, unless it refuses even to be asked: for a page in a closed frame, or where its owner wants nothing kept. */
export function keeper() {
  try {
    return window.localStorage ?? REFUSING;
  } catch {
    return REFUSING;
  }
}
