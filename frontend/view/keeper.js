/** Where the browser keeps what is typed. */

/** Nothing is ever there, and nothing can be written. @type {import("../model/homework/progress.js").Keeper} */
const REFUSING = {
  length: 0,
  key: () => null,
  getItem: () => null,
  setItem() {
    throw new Error("The browser keeps nothing for this page.");
  },
};

/** @param {"localStorage" | "sessionStorage"} kind */
function kept(kind) {
  try {
    return window[kind] ?? REFUSING;
  } catch {
    return REFUSING;
  }
}

/** The browser's own, unless it refuses even to be asked: for a page in a closed frame, or where its owner wants nothing kept. */
export const keeper = () => kept("localStorage");

/** What lasts as long as the window. */
export const windowKeeper = () => kept("sessionStorage");
