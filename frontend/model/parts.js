/** The rows of a formula in two parts, up to their marks of alignment and after them, and which of them make one equation. */

import { tokensOf } from "./latex.js";
import { sidesOf } from "./linebreak.js";

/** @typedef {{text: string, gap: string}} Row */
/** @typedef {{left: string, right: string, gap: string, apart?: boolean}} Part  of a row: up to its mark of alignment, and after it; apart: it says more of all that stands above, not of one equation */

const RELATION = /^(?:\s|\\[,;:!]|\{\}|\\htmlClass\{[^}]*\}\{)*(?:[=<>]|\\(?:approx|equiv|neq|le|ge|to)(?![a-zA-Z]))/;
const ARROW = /^(?:\s|\\[,;:!])*\\(?:Longleftrightarrow|Rightarrow)(?:\s|\\[,;:!])*$/;
/** A remark on the equation before it: which coordinates it holds for. */
const REMARK = /^\\quad\s*\(/;
/** A matrix by itself, behind what it is equal to, and what it is called. */
export const MATRIX = /^(?:=|\\approx)\s*(\\begin\{bmatrix\}(?:(?!\\begin\{bmatrix\})[\s\S])*\\end\{bmatrix\})$/;
export const CALLED = /^\\mathbf [A-Z](?: _ \w)?$/;

/** @param {Row} row @returns {Part} */
export function partOf({ text, gap }) {
  const [left, right] = sidesOf(text).map((side) => side.replace(/&$/, "").trim());
  return { left, right, gap };
}

/** @param {Part} part */
export const isEquivalent = ({ left }) => ARROW.test(left);

/** Whether a row says more of the equation above it. @param {Part} part */
const goesOn = (part) =>
  !part.apart && (isEquivalent(part) || (!part.left && (RELATION.test(part.right) || REMARK.test(part.right))));

/** What is seen of a formula, without its classes, braces and gaps. @param {string} latex */
export const plain = (latex) =>
  tokensOf(latex.replace(/\\htmlClass\{[^}]*\}/g, ""))
    .filter((token) => /[^\s{}]/.test(token))
    .join(" ");

/** Equations, each with all that it is equal or equivalent to. @param {Part[]} parts */
export function equationsOf(parts) {
  /** @type {Part[][]} */
  const equations = [];
  for (const part of parts) {
    if (equations.length && goesOn(part)) equations[equations.length - 1].push(part);
    else equations.push([part]);
  }
  return equations;
}
