/**
 * The symbols of a scene in its formulas, made known to the page: parameters by their number, `p-0`, `p-1` …, as the
 * server marks coordinates by theirs, and places and velocities of bodies as such. So each can be found in the drawing.
 * What belongs to the whole system, to a coordinate or to a constraint is marked by what is to be found of it.
 */

import { belongings, multipliersOf, ofConstraint } from "./belongings.js";

/** @typedef {import("./types.js").Step} Step */
/** @typedef {import("./types.js").Scene} Scene */

/** @typedef {import("./belongings.js").Named} Named */

const RAISED = String.raw`\^(?:\{[^{}]*\}|\d)`;
const POWER = `(?:${RAISED})?`;
const GROUP = String.raw`\{(?:[^{}]|\{(?:[^{}]|\{[^{}]*\})*\})*\}`;
const INDEX = String.raw`(?:_(?:${GROUP}|[a-zA-Z0-9]))?`;
/** What stands as it is: coordinates that are marked, classes, words, upright and bold letters, layout; and commands and letters that are no name. */
const OTHER = [
  String.raw`\\htmlClass\{q-\d[^}]*\}${GROUP}`,
  String.raw`\\htmlClass\{[^}]*\}`,
  String.raw`\\(?:text|math[a-z]+|begin|end|operatorname)\{[^}]*\}(?:\[l\])?`,
  String.raw`\\\\(?:\[[^\]]*\])?`,
  String.raw`\\[a-zA-Z]+${INDEX}${POWER}${INDEX}`,
  String.raw`[a-zA-Z]${INDEX}${POWER}${INDEX}`,
].join("|");
/** What takes the next letter by itself takes no class about it. */
const BARE = String.raw`(?<![_^]|\\(?:d?dot|sqrt|bar|hat|vec|[td]?frac|math[a-z]+)\s*)`;
const PLACE = /\\htmlClass\{(body-[\w-]+(?: [\w-]+)*)\}\{(?=\\mathbf\{([rv])\})/g;
const CONSTRAINT = /\\htmlClass\{constraint-([\w-]+)\}\{(?=\\Phi|\\delta W)/g;
const OF_SYSTEM = /\\htmlClass\{(energy-(?:kinetic|potential))\}\{|\\delta W(?:_\{a\}|\^\{z\}(?!_)|(?![_^]))/g;

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

/** @param {readonly string[]} indices @returns {RegExp} Q₁ and p₁ with their index and what stands above it, as the server marks it or bare */
const ofCoordinates = (indices) =>
  new RegExp(
    String.raw`([Qp])_\{(?:\\htmlClass\{q-(\d+)\}\{(?:[^{}]|\{[^{}]*\})*\}|(${indices.map(whole).join("|") || "(?!)"}))\}(?:\^\{(?:[^{}]|\{[^{}]*\})*\})?`,
    "g",
  );

/** The classes of everything that has a name in the scene, by its LaTeX; what is named first has it. @param {Named} scene @param {import("./belongings.js").Results | null} [result] */
function namesIn(scene, result) {
  const { parameters = [], coordinates = [] } = scene;
  const named = [
    ...parameters.map(({ name, latex }, i) => [latex || name, `p-${i}`]),
    ...coordinates.map(({ name, latex }, i) => [latex || name, `q-${i}`]),
    ...multipliersOf(scene, result),
  ];
  return new Map(
    named
      .flatMap(([latex, classes]) => spellings(latex).map((text) => /** @type {const} */ ([text, classes])))
      .reverse(),
  );
}

/**
 * What marks the names of a scene in a formula, and what belongs to the whole system; a power stays with its base, over
 * the index of which it stands. With an index behind a power it is another symbol: R is not in R^{h}_{1}.
 * @param {Named} scene @param {import("./belongings.js").Results | null} [result] @returns {(latex: string) => string}
 */
export function markerOf(scene, result) {
  const { ofSystem, ofCoordinate } = belongings(scene, result);
  const names = namesIn(scene, result);
  const longest = [...names.keys()].sort((a, b) => b.length - a.length).map(whole);
  const pattern = new RegExp(`${BARE}(${longest.join("|") || "(?!)"})(?!_|${RAISED}_)${POWER}|${OTHER}`, "g");
  const bare = new RegExp(`${BARE}$`);
  const indices = (scene.coordinates ?? []).map(({ name, latex }) => latex || name);
  const generalized = ofCoordinates(indices);
  /** @param {string} symbol @param {string} before */
  function ofWhole(symbol, before) {
    const base = symbol.replace(new RegExp(RAISED), "");
    const classes = !names.has(base) && bare.test(before) ? ofSystem(base) : "";
    return classes ? `\\htmlClass{${classes}}{${symbol}}` : symbol;
  }
  return (latex) =>
    latex
      .replace(PLACE, "\\htmlClass{$1 vector-$2}{")
      .replace(CONSTRAINT, (_, name) => `\\htmlClass{${ofConstraint(name)}}{`)
      .replace(OF_SYSTEM, (all, energy) => {
        const classes = ofSystem(energy ?? all);
        if (!classes) return all;
        return energy ? `\\htmlClass{${energy} ${classes}}{` : `\\htmlClass{${classes}}{${all}}`;
      })
      .replace(generalized, (all, letter, i, index) => {
        const at = i === undefined ? indices.indexOf(index) : Number(i);
        return `\\htmlClass{${ofCoordinate(letter, at)}}{${all}}`;
      })
      .replace(pattern, (all, symbol, at, text) =>
        symbol ? `\\htmlClass{${names.get(symbol)}}{${all}}` : ofWhole(all, text.slice(0, at)),
      );
}

/** A step whose formulas have their symbols marked, with all parts of it. @param {Step} step @param {(latex: string) => string} mark @returns {Step} */
export function withSymbols(step, mark) {
  const formula = step.marked || step.latex;
  const substeps = step.substeps?.map((part) => withSymbols(part, mark));
  return { ...step, ...(formula ? { marked: mark(formula) } : {}), ...(substeps ? { substeps } : {}) };
}
