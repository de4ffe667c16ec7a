/**
 * Bodies called by numbers in the formulas of a lecture, as on a blackboard: r₂ where the text says r of the second bob.
 * What a number stands for is told beside the formulas.
 */

/** @typedef {import("../types.js").Scene} Scene */
/** @typedef {{number: string, name: string}} Numbered */
/** @typedef {{short: (latex: string) => string, within: (formulas: readonly string[]) => Numbered[]}} Numbering  within: those that stand in formulas */

/** Letters up to which the name of a body is as short as a number. */
const SHORT = 4;
/** A mass with a number, as m₂. */
const NUMBERED = /^\\?[a-zA-Z]+_\{?(\d+)\}?$/;

/** A name as it stands in formulas: what LaTeX would read as a command is left out there. @param {string} name */
const upright = (name) => `\\text{${name.replace(/[^\p{L}\p{N}_ .,()-]/gu, "").replaceAll("_", "\\_")}}`;

/** Those of their masses where each has one, else in their order. @param {Scene} scene @returns {string[]} */
function numbersOf({ bodies, parameters }) {
  const found = bodies.map(({ mass }) => {
    const parameter = parameters.find(({ name }) => name === mass);
    return NUMBERED.exec(parameter?.latex || parameter?.name || "")?.[1] ?? "";
  });
  const distinct = new Set(found.filter(Boolean)).size === bodies.length;
  return distinct ? found : bodies.map((_, i) => String(i + 1));
}

/**
 * The bodies that are called by numbers: a single one needs none, and those whose names are all short keep them.
 * @param {Pick<Scene, "bodies" | "parameters"> | null | undefined} scene @param {(body: string) => string} called @returns {Numbered[]}
 */
export function numberedIn(scene, called) {
  const names = scene ? scene.bodies.map(({ name }) => called(name)) : [];
  if (!scene || names.length < 2 || names.every(({ length }) => length <= SHORT)) return [];
  const numbers = numbersOf(/** @type {Scene} */ (scene));
  return names.map((name, i) => ({ name, number: numbers[i] }));
}

/** @param {readonly Numbered[]} numbered @returns {Numbering} */
export function numberingBy(numbered) {
  const all = numbered.map((one) => ({ ...one, text: upright(one.name) }));
  return {
    short: (latex) => all.reduce((left, { text, number }) => left.replaceAll(text, number), latex),
    within: (formulas) =>
      all
        .filter(({ text }) => formulas.some((latex) => latex.includes(text)))
        .map(({ number, name }) => ({ number, name })),
  };
}
