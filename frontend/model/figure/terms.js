/** What a formula is made of: the lines of an aligned display, the sides of a line, the terms of a sum. */

const OPEN = /^(?:\{|\(|\[|\\left|\\begin)/;
const CLOSE = /^(?:\}|\)|\]|\\right|\\end)/;
/** A command and its delimiter belong together: "\left(" opens once. */
const STEP = /^(?:\\(?:left|right)\s*(?:\\[a-zA-Z|{}]+|.)|\\(?:begin|end)\{[a-z]+\*?\}|\\[a-zA-Z]+|\\.|[^])/;
const ALIGNED = /^\\begin\{aligned\}([^]*)\\end\{aligned\}$/;
const NEWLINE = /^\\\\(?:\[[^\]]*\])?/;
const RELATION = /^(?:&|=|\\neq|\\approx|\\;\\Longleftrightarrow\\;)/;
const SIGN = /^\s*[+-]\s*/;
/** As the server compares texts: without classes, braces, spaces and sizes of brackets. */
const DRESS = /\\htmlClass\{[^}]*\}|\\(?:left|right)(?![a-z])|\\,|[{}\s]/g;

/**
 * A text cut outside of brackets, wherever `at` matches; what matched stands between the parts.
 * @param {string} latex @param {RegExp} at anchored
 * @returns {{part: string, before: string}[]} each part with the separator before it
 */
function cut(latex, at) {
  const parts = [{ part: "", before: "" }];
  let depth = 0;
  for (let rest = latex; rest;) {
    const found = depth === 0 ? at.exec(rest)?.[0] : undefined;
    const step = found ?? STEP.exec(rest)?.[0] ?? rest[0];
    if (found) parts.push({ part: "", before: found });
    else {
      depth += OPEN.test(step) ? 1 : CLOSE.test(step) ? -1 : 0;
      parts[parts.length - 1].part += step;
    }
    rest = rest.slice(step.length);
  }
  return parts;
}

/** @typedef {{text: string, sign: 1 | -1, bare: string}} Term */

/** The same whatever its classes and spaces. @param {string} latex */
export const bare = (latex) => latex.replace(DRESS, "");

/**
 * A formula with some of its terms changed. Terms are those of sums: one alone on its side is none.
 * @param {string} latex @param {(side: Term[]) => (string | null)[]} change  new texts of a side's terms, null where nothing changes
 */
export function withTerms(latex, change) {
  const inside = ALIGNED.exec(latex)?.[1];
  const lines = cut(inside ?? latex, NEWLINE).map(
    ({ part, before }) =>
      before +
      cut(part, RELATION)
        .map((side) => side.before + changed(side.part, change))
        .join(""),
  );
  return inside === undefined ? lines.join("") : `\\begin{aligned}${lines.join("")}\\end{aligned}`;
}

/** @param {string} side @param {(side: Term[]) => (string | null)[]} change */
function changed(side, change) {
  const parts = cut(side, SIGN).map(({ part, before }) => ({
    before: before + (/^\s*/.exec(part)?.[0] ?? ""),
    text: part.trim(),
    after: part.trim() ? part.slice(part.trimEnd().length) : "",
    sign: /** @type {1 | -1} */ (before.includes("-") ? -1 : 1),
  }));
  const terms = parts.filter(({ text }) => text).map(({ text, sign }) => ({ text, sign, bare: bare(text) }));
  if (!terms.length) return side;
  const texts = change(terms);
  let next = 0;
  return parts.map(({ before, text, after }) => before + (text ? (texts[next++] ?? text) : "") + after).join("");
}

/** All terms of a formula, side by side. @param {string} latex @returns {Term[][]} */
export function sidesOf(latex) {
  /** @type {Term[][]} */
  const sides = [];
  withTerms(latex, (side) => {
    sides.push(side);
    return side.map(() => null);
  });
  return sides;
}
