/**
 * The symbols of a scene in its formulas, made known to the page: parameters by their number, `p-0`, `p-1` …, as the
 * server marks coordinates by theirs, and places and velocities of bodies as such. So each can be found in the drawing.
 */

/** @typedef {import("./types.js").Step} Step */
/** @typedef {import("./types.js").Scene} Scene */

/** What stands as it is: classes, words, upright and bold letters, layout; and commands and letters that are no parameter. */
const OTHER = [
  String.raw`\\htmlClass\{[^}]*\}`,
  String.raw`\\(?:text|math[a-z]+|begin|end|operatorname)\{[^}]*\}(?:\[l\])?`,
  String.raw`\\\\(?:\[[^\]]*\])?`,
  String.raw`\\[a-zA-Z]+`,
  String.raw`[a-zA-Z](?:_(?:\{[^{}]*\}|[a-zA-Z0-9]))?`,
].join("|");
/** What takes the next letter by itself takes no class about it. */
const BARE = String.raw`(?<![_^]|\\(?:d?dot|sqrt|bar|hat|vec|[td]?frac|math[a-z]+)\s*)`;
const POWER = String.raw`(?:\^(?:\{[^{}]*\}|\d))?`;
const PLACE = /\\htmlClass\{(body-[\w-]+(?: [\w-]+)*)\}\{(?=\\mathbf\{([rv])\})/g;

/** The class of a parameter, "" for a name that is none. @param {Pick<Scene, "parameters">} scene @param {string | undefined} name */
export function parameterClass({ parameters }, name) {
  const index = parameters.findIndex((parameter) => parameter.name === name);
  return index < 0 ? "" : `p-${index}`;
}

/** A symbol and nothing that only begins like it. @param {string} latex */
const whole = (latex) =>
  `${latex.replace(/[\\^$.*+?()[\]{}|]/g, "\\$&")}${/\\[a-zA-Z]+$/.test(latex) ? "(?![a-zA-Z])" : ""}`;

/** A symbol as it is written with and without braces about its index. @param {string} latex */
function spellings(latex) {
  const [, base, index] = /^(.*?)_\{?([^{}]*)\}?$/.exec(latex) ?? [];
  return index ? [`${base}_{${index}}`, ...(index.length === 1 ? [`${base}_${index}`] : [])] : [latex];
}

/**
 * What marks the parameters of a scene in a formula; a power stays with its base, over the index of which it stands.
 * @param {Pick<Scene, "parameters">} scene @returns {(latex: string) => string}
 */
export function markerOf({ parameters = [] }) {
  const numbers = new Map(
    parameters.flatMap(({ name, latex }, i) =>
      spellings(latex || name).map((text) => /** @type {const} */ ([text, i])),
    ),
  );
  const longest = [...numbers.keys()].sort((a, b) => b.length - a.length).map(whole);
  const pattern = new RegExp(longest.length ? `${BARE}(${longest.join("|")})(?!_)${POWER}|${OTHER}` : OTHER, "g");
  return (latex) =>
    latex
      .replace(PLACE, "\\htmlClass{$1 vector-$2}{")
      .replace(pattern, (all, symbol) => (symbol ? `\\htmlClass{p-${numbers.get(symbol)}}{${all}}` : all));
}

/** A step whose formulas have their symbols marked, with all parts of it. @param {Step} step @param {(latex: string) => string} mark @returns {Step} */
export function withSymbols(step, mark) {
  const formula = step.marked || step.latex;
  const substeps = step.substeps?.map((part) => withSymbols(part, mark));
  return { ...step, ...(formula ? { marked: mark(formula) } : {}), ...(substeps ? { substeps } : {}) };
}
