/**
 * What a step changes against the steps before it, term by term: carried over, turned in sign (as when a term goes to
 * the other side), new, or cancelled. The server writes the same term the same way everywhere, so that equal texts are
 * equal terms.
 */

import { sidesOf, withTerms } from "./terms.js";

/** @typedef {import("../types.js").Step} Step */
/** @typedef {import("../reveal.js").Line} Line */
/** @typedef {"kept" | "turned" | "new" | "gone"} Change */
/** @typedef {{formulas: Map<Step, string>, from: Record<Change, string[]>}} Origins  LaTeX with marked terms, and the numbers of the steps they come from */

/** How many steps are looked back: further ones are forgotten by the reader too. */
const BACK = 16;
/** Symbols alone, such as L or Q₁, and what is only announced, such as ∂L/∂q, are no terms to follow. */
const NAME = /^(?:\\[a-z]+)?[A-Za-z]?(?:[_^].{1,12})?$|\\partial|\\mathrmd|\\mathbf|\\int|\\text/;

const textOf = (/** @type {Step} */ { marked, latex }) => marked || latex;
/** @param {Step} step @returns {Step[]} */
const within = (step) => step.substeps.flatMap((part) => [...within(part), part]);

/**
 * @param {readonly Line[]} lines @param {number} index of the step
 * @returns {Origins}
 */
export function originsOf(lines, index) {
  const { step, number } = lines[index];
  /** @type {Map<string, {sign: number, number: string}>} */
  const known = new Map();
  const learn = (/** @type {Step} */ from, /** @type {string} */ at) => {
    for (const side of sidesOf(textOf(from))) {
      // A whole side may come again as one term, as E does in L = E − V.
      for (const { bare, sign } of [...side, { bare: joined(side), sign: 1 }])
        if (!NAME.test(bare)) known.set(bare, { sign, number: at });
    }
  };
  for (const line of lines.slice(Math.max(0, index - BACK), index))
    [...within(line.step), line.step].forEach((part) => learn(part, line.number));
  const parts = within(step);
  parts.forEach((part) => learn(part, number));

  /** @type {Record<Change, Set<string>>} */
  const from = { kept: new Set(), turned: new Set(), new: new Set(), gone: new Set() };
  const mark = (/** @type {Change} */ change, /** @type {string} */ text, /** @type {string} */ at) => {
    from[change].add(at);
    return `\\htmlClass{term-${change}}{${text}}`;
  };
  const formulas = new Map([
    [
      step,
      withTerms(textOf(step), (side) => {
        const found = side.map(({ bare }) => known.get(bare));
        if (side.length < 2 || !found.some(Boolean)) return side.map(() => null);
        return side.map(({ text, sign, bare }, i) => {
          const origin = found[i];
          if (!origin) return NAME.test(bare) || bare === "0" ? null : mark("new", text, number);
          return mark(origin.sign === sign ? "kept" : "turned", text, origin.number);
        });
      }),
    ],
  ]);
  const lost = cancelled(step, parts);
  for (const part of lost.size ? parts : []) {
    formulas.set(
      part,
      withTerms(textOf(part), (side) =>
        side.map(({ text, bare }) => (lost.has(bare) ? mark("gone", text, number) : null)),
      ),
    );
  }
  return {
    formulas,
    from: /** @type {Record<Change, string[]>} */ (
      Object.fromEntries(Object.entries(from).map(([change, numbers]) => [change, [...numbers]]))
    ),
  };
}

/** A sum as it stands within another. @param {import("./terms.js").Term[]} side */
const joined = (side) => side.map(({ bare, sign }, i) => (sign < 0 ? "-" : i ? "+" : "") + bare).join("");

/** Terms that two of the intermediate steps have and the result has not: they cancel. @param {Step} step @param {readonly Step[]} parts */
function cancelled(step, parts) {
  const result = new Set(
    sidesOf(textOf(step))
      .flat()
      .map(({ bare }) => bare),
  );
  const counts = new Map();
  for (const part of parts) {
    const last = sidesOf(textOf(part)).at(-1) ?? [];
    for (const bare of new Set(last.map((term) => term.bare))) counts.set(bare, (counts.get(bare) ?? 0) + 1);
  }
  return new Set(
    [...counts]
      .filter(([bare, count]) => count > 1 && !result.has(bare) && !NAME.test(bare) && bare !== "0")
      .map(([bare]) => bare),
  );
}
