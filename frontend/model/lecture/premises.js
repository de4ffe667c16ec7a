/** What a step rests on, as short formulas that stand above it: the result of each earlier step, without the way to it. */

import { rowsOf, sidesOf } from "../linebreak.js";
import { sizeOf } from "../measure.js";

/** @typedef {import("../types.js").Step} Step */
/** @typedef {import("../reveal.js").Line} Line */
/** @typedef {{step: Step, line: Line, latex: string}} Premise  latex: short, or "" where no short form is left of it */

/** Em that a short formula may be wide and high. */
const WIDE = 26;
const HIGH = 3;
const FOLLOWS = /\\(Longleftrightarrow|Rightarrow|Longrightarrow)/;

/** @param {Step} step @returns {Step[]} */
const within = (step) => [step, ...step.substeps.flatMap(within)];

/** Each earlier step or substep that a step or its substeps rest on, in their order. @param {readonly Line[]} lines @param {Line} line @returns {Premise[]} */
export function premisesOf(lines, line) {
  const own = within(line.step);
  const wanted = new Set(own.flatMap(({ premises }) => premises));
  for (const { id } of own) wanted.delete(id);
  return lines
    .slice(0, line.index)
    .flatMap((earlier) => within(earlier.step).map((step) => ({ step, line: earlier })))
    .filter(({ step }) => wanted.has(step.id))
    .map(({ step, line: from }) => ({ step, line: from, latex: shortForm(step.marked || step.latex) }));
}

/** What a formula comes to: the left side of each of its chains, and the last or else the first member that is short. @param {string} latex */
export function shortForm(latex) {
  if (!latex) return "";
  /** @type {{left: string, members: string[]}[]} */
  const chains = [];
  for (const { text } of rowsOf(latex)) {
    const [left, right] = sidesOf(text).map((side) => side.replace(/&\s*$/, "").trim());
    const last = chains.at(-1);
    if (last && (!left || FOLLOWS.test(left))) last.members.push(right);
    else chains.push({ left, members: [right] });
  }
  const found = chains.map(({ left, members }) => {
    const last = members[members.length - 1];
    const stands = members.length > 1 && !/^\s*=/.test(last);
    return [stands ? last : `${left} ${last}`, `${left} ${members[0]}`].find(isShort) ?? "";
  });
  const all = found.join(",\\quad ");
  return found.every(Boolean) && isShort(all) ? all : (found.find(Boolean) ?? "");
}

/** @param {string} latex */
function isShort(latex) {
  const { width, height, depth } = sizeOf(latex);
  return width <= WIDE && height + depth <= HIGH;
}
