/**
 * Reactions of several constraints in shorthand: what all of them do to a coordinate as one sum, and one law for all
 * constraints. A constraint that does not depend on a coordinate adds nothing to that sum.
 */

import { cut } from "./latex.js";
import { joins } from "./linebreak.js";
import { plain } from "./parts.js";

/** @typedef {import("./parts.js").Part} Part */
/** @typedef {{constraint: string, multiplier: string, function: string, by: string}} Reaction  of λ ∂Φ/∂q: which constraint's, λ, Φ, and q */

/** The class of a constraint among others. */
const CLASS = String.raw`\\htmlClass\{(?:[^}]* )?constraint-([\w-]+)(?: [^}]*)?\}`;
const CLASSED = new RegExp(String.raw`^\s*${CLASS}\{([\s\S]*)\}\s*$`);
const FORCE = new RegExp(
  String.raw`^([\s\S]*?)\\,\\frac\{\\partial ${CLASS}\{([\s\S]*)\}\}\{\\partial (\\htmlClass\{q-\d+\}\{[\s\S]*\})\}$`,
);
const NAMED = new RegExp(String.raw`${CLASS}\{\\Phi_?(?:\\text\{[^{}]*\}|\{(?:[^{}]|\{[^{}]*\})*\}|\w)?\}`, "g");
/** How constraints are counted: coordinates are by i and k. */
const ANY = "j";

/** λ ∂Φ/∂q as it is written, else null. @param {string} term @returns {Reaction | null} */
function reactionIn(term) {
  const [, constraint, content] = term.match(CLASSED) ?? [];
  const [, multiplier, own, called, by] = (content ?? "").match(FORCE) ?? [];
  return by && own === constraint ? { constraint, multiplier, function: called, by } : null;
}

/** The terms of a sum behind their signs, and what each is. @param {string} sum */
const termsOf = (sum) =>
  cut(sum, (token, before) => joins(token, before) || (token === "=" && before.trim() !== "")).map((text) => {
    const [, sign, term] = /** @type {RegExpMatchArray} */ (text.match(/^(\s*=?\s*\+?\s*)([\s\S]*)$/));
    return { text, sign, reaction: reactionIn(term) };
  });

/** A side with its reactions as a sum over all constraints. @param {string} side */
function summedUp(side) {
  const terms = termsOf(side);
  const first = terms.findIndex(({ reaction }) => reaction);
  if (first < 0) return side;
  const { by } = /** @type {Reaction} */ (terms[first].reaction);
  if (terms.some(({ reaction }) => reaction && plain(reaction.by) !== plain(by))) return side;
  const sum = `\\sum\\nolimits_{${ANY}} \\lambda_{${ANY}}\\,\\frac{\\partial \\Phi_{${ANY}}}{\\partial ${by}}`;
  return terms.map(({ text, sign, reaction }, i) => (i === first ? `${sign}${sum}` : reaction ? "" : text)).join("");
}

/** The multipliers of all reactions, in their order. @param {readonly Part[]} parts */
function multipliersIn(parts) {
  const found = parts.flatMap(({ right }) => termsOf(right).flatMap(({ reaction }) => (reaction ? [reaction] : [])));
  return [...new Map(found.map(({ constraint, multiplier }) => [constraint, multiplier])).values()];
}

/** Equations with two constraints or more, with a sum over these. @param {readonly Part[]} parts @param {string} gap @returns {Part[]} */
export function overReactions(parts, gap) {
  const multipliers = multipliersIn(parts);
  if (multipliers.length < 2) return [...parts];
  /** @type {Set<string>} */
  const said = new Set();
  const made = parts.flatMap((part) => {
    const right = summedUp(part.right);
    if (right !== part.right || !isLaw(part)) return [{ ...part, right }];
    const law = part.right.replace(NAMED, `\\Phi_{${ANY}}`);
    if (said.has(plain(law))) return [];
    said.add(plain(law));
    return [{ ...part, right: law }];
  });
  const told = { left: "", right: `(\\lambda_{${ANY}} = ${multipliers.join(",\\, ")})`, gap, apart: true };
  const before = made.findIndex(({ left }, i) => i > 0 && left !== "");
  const at = before < 0 ? made.length : before;
  return [...made.slice(0, at), told, ...made.slice(at)];
}

/** Whether a row says of a constraint that a derivative of it is zero. @param {Part} part */
const isLaw = ({ left, right }) => !left && /=\s*0\s*$/.test(right) && [...right.matchAll(NAMED)].length === 1;
