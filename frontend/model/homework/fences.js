/** Brackets in a field for formulas go in pairs: MathLive would delete one of them and leave the caret caught in the other. */

const COMMAND = /\\(left|right)(\\[A-Za-z]+|\\.|.)/g;
/** @type {Readonly<Record<string, string>>} */
const MIRROR = {
  "(": ")",
  ")": "(",
  "[": "]",
  "]": "[",
  "\\lbrace": "\\rbrace",
  "\\rbrace": "\\lbrace",
  "\\{": "\\}",
  "\\}": "\\{",
};

/** @typedef {{start: number, end: number, fence: string}} Half  where a half stands in the text, and its bracket: "." once it is gone */

/** @param {string} latex @returns {[Half, Half] | null}  the first pair of which a half is gone */
function broken(latex) {
  /** @type {Half[]} */
  const open = [];
  for (const { index, 0: whole, 1: side, 2: fence } of latex.matchAll(COMMAND)) {
    const half = { start: index, end: index + whole.length, fence };
    const first = side === "left" ? void open.push(half) : open.pop();
    if (first && (first.fence === ".") !== (fence === ".")) return [first, half];
  }
  return null;
}

/**
 * What deleting one bracket of a pair comes to: from outside the caret only steps in, from inside the pair goes and
 * what stands in it stays.
 * @param {string} latex  after the deletion @param {boolean} backward
 * @returns {{latex: string, shift: number} | null}  the text wanted and how far the caret moves, or null if nothing is broken
 */
export function paired(latex, backward) {
  const pair = broken(latex);
  if (!pair) return null;
  const [left, right] = pair;
  const inside = latex.slice(left.end, right.start);
  const [before, after] = [latex.slice(0, left.start), latex.slice(right.end)];
  if ((left.fence === ".") === backward) return { latex: apart(before, inside) + after, shift: -1 };
  const [opening, closing] =
    left.fence === "." ? [mirrored(right.fence), right.fence] : [left.fence, mirrored(left.fence)];
  return { latex: `${before}\\left${opening}${inside}\\right${closing}${after}`, shift: 0 };
}

/** @param {string} fence */
const mirrored = (fence) => MIRROR[fence] ?? fence;

/** A command ends where no letter follows it. @param {string} before @param {string} after */
const apart = (before, after) =>
  /\\[A-Za-z]+$/.test(before) && /^[A-Za-z]/.test(after) ? `${before} ${after}` : before + after;
