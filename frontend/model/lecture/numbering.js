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
 * A single body needs no number, and bodies whose names are all short keep them.
 * @param {Pick<Scene, "bodies" | "parameters"> | null | undefined} scene @param {(body: string) => string} called @returns {Numbering}
 */
export function numberingOf(scene, called) {
  const names = scene ? scene.bodies.map(({ name }) => called(name)) : [];
  if (!scene || names.length < 2 || names.every(({ length }) => length <= SHORT))
    return { short: (latex) => latex, within: () => [] };
  const numbers = numbersOf(/** @type {Scene} */ (scene));
  const all = names.map((name, i) => ({ name, number: numbers[i], text: upright(name) }));
  return {
    short: (latex) => all.reduce((left, { text, number }) => left.replaceAll(text, number), latex),
    within: (formulas) =>
      all
        .filter(({ text }) => formulas.some((latex) => latex.includes(text)))
        .map(({ number, name }) => ({ number, name })),
  };
}
