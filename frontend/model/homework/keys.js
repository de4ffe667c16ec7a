/** The mechanics keyboard: what it offers for a scene and a task, and what each key writes in either syntax. */

import { dotted } from "../values.js";

/** @typedef {{label: string, latex: string, plain: string, name: string}} Key  LaTeX shown, LaTeX and text written; `|` is where one writes on, and `name` is said aloud */
/** @typedef {{id: string, keys: Key[]}} Row */

const VIRTUAL = ["virtual-displacement", "virtual-work"];
const GREEK = [
  "alpha",
  "beta",
  "gamma",
  "delta",
  "epsilon",
  "theta",
  "lambda",
  "mu",
  "xi",
  "pi",
  "rho",
  "sigma",
  "tau",
  "varphi",
  "psi",
  "omega",
  "Omega",
];

/** @param {string} label @param {string} latex @param {string} plain @param {string} [name] @returns {Key} */
const key = (label, latex, plain, name = plain) => ({ label, latex, plain, name });

const OPERATIONS = [
  key("\\tfrac{a}{b}", "\\frac{#@}{#?}", "/", "a/b"),
  key("a^2", "^2", "^2"),
  key("a^n", "^{#?}", "^"),
  key("\\sqrt{a}", "\\sqrt{#0}", "sqrt(|)"),
  key("(\\,)", "\\left(#0\\right)", "(|)", "( )"),
  key("\\sin", "\\sin\\left(#0\\right)", "sin(|)"),
  key("\\cos", "\\cos\\left(#0\\right)", "cos(|)"),
  key("\\cdot", "\\cdot", "*"),
  key("+", "+", " + "),
  key("-", "-", " - "),
];
const EQUALS = key("=", "=", " = ");
const OR = key(";", ";", "; ", ";");
const PLUS_MINUS = key("\\pm", "\\pm", "±", "±");
const LESS = key("<", "<", " < ", "<");
const MORE = key(">", ">", " > ", ">");
/** What stands between the formulas of an answer. @type {Record<string, Key[]>} */
const RELATIONS = {
  equation: [EQUALS],
  equations: [EQUALS],
  set: [EQUALS],
  positions: [EQUALS, OR, PLUS_MINUS],
  stability: [LESS, MORE],
  rate: [EQUALS, OR, PLUS_MINUS],
};
/** The words of an answer. @type {Record<string, readonly string[]>} */
const WORDS = { stability: ["homework.word-stable", "homework.word-unstable", "homework.word-for"] };
const TIME = [
  key("t", "t", "t"),
  key("\\tfrac{\\mathrm d}{\\mathrm dt}", "\\frac{d}{dt}\\left(#0\\right)", "diff(|, t)", "d/dt"),
];

/** The dots of a rate stand on the letter, not on its index. @param {string} latex */
const twiceDotted = (latex) => dotted(latex).replace("\\dot{", "\\ddot{");

/** @param {import("./sheet.js").TaskSymbol} symbol @param {string} kind */
function motionKeys({ name, latex }, kind) {
  const all = [key(latex, latex, name), key(dotted(latex), dotted(latex), `dot(${name})`)];
  if (VIRTUAL.includes(kind)) return [all[0], key(`\\delta ${latex}`, `\\delta ${latex}`, `delta(${name})`)];
  return kind === "position" ? all.slice(0, 1) : [...all, key(twiceDotted(latex), twiceDotted(latex), `ddot(${name})`)];
}

/** @param {string} word */
const wordKey = (word) => key(`\\text{${word}}`, `\\operatorname{${word}}`, ` ${word} `, word);

/**
 * @param {Pick<import("./sheet.js").Entry, "symbols" | "task" | "scene">} entry
 * @param {(key: string) => string} t  texts
 * @returns {Row[]}
 */
export function keyboardOf({ symbols, task, scene }, t) {
  const guided = new Set((scene.guides ?? []).map(({ coordinate }) => coordinate));
  const coordinates = symbols.filter(({ kind, name }) => kind === "coordinate" && !guided.has(name));
  const parameters = symbols
    .filter(({ kind }) => kind === "parameter")
    .map(({ name, latex }) => key(latex, latex, name));
  const words = (WORDS[task.form] ?? []).map((word) => wordKey(t(word)));
  const frequency = task.form === "set" ? [key("\\omega", "\\omega", "omega")] : [];
  return [
    { id: "motion", keys: [...frequency, ...coordinates.flatMap((symbol) => motionKeys(symbol, task.kind)), ...TIME] },
    { id: "parameters", keys: parameters },
    { id: "operations", keys: [...words, ...(RELATIONS[task.form] ?? []), ...OPERATIONS] },
    { id: "greek", keys: GREEK.map((name) => key(`\\${name}`, `\\${name}`, name.replace("var", ""))) },
  ].filter(({ keys }) => keys.length > 0);
}

/** Whether a key is a word, as wide as two. @param {Key} key */
export const isWord = ({ label }) => label.startsWith("\\text");

/** How many keys stand in a row of a phone, so that none is alone in the last. @param {number} count */
export const columnsFor = (count) => [6, 5, 4].find((columns) => count % columns !== 1) ?? 6;

/** In as few rows as will do, all of nearly the same length. @template T @param {T[]} all @param {number} most in a row @returns {T[][]} */
export function inRows(all, most) {
  const rows = Math.ceil(all.length / most);
  const end = (/** @type {number} */ row) => Math.round((all.length * row) / rows);
  return Array.from({ length: rows }, (_, row) => all.slice(end(row), end(row + 1)));
}

/** What a key does to a text field. @param {string} text @param {number} start @param {number} end of what is selected @param {string} plain */
export function written(text, start, end, plain) {
  const [before, after = ""] = plain.split("|");
  const chosen = plain.includes("|") ? text.slice(start, end) : "";
  const value = text.slice(0, start) + before + chosen + after + text.slice(end);
  return { value, caret: start + before.length + chosen.length };
}

/** Typed in a math field: phidot, phiddot, dphi and the names of the scene become what they mean. @param {import("./sheet.js").TaskSymbol[]} symbols */
export function shortcutsOf(symbols) {
  const named = symbols.filter(({ name }) => name.length > 1).map(({ name, latex }) => [name, latex]);
  const moving = symbols
    .filter(({ kind }) => kind === "coordinate")
    .flatMap(({ name, latex }) => [
      [`${name}'`, dotted(latex)],
      [`${name}''`, twiceDotted(latex)],
      [`${name}dot`, dotted(latex)],
      [`${name}ddot`, twiceDotted(latex)],
      [`delta${name}`, `\\delta ${latex}`],
    ]);
  const greek = [...GREEK, "phi"].map((name) => [name, `\\${name}`]);
  const functions = ["sin", "cos", "tan", "arcsin", "arccos", "arctan", "exp", "ln"].map((name) => [name, `\\${name}`]);
  return Object.fromEntries([...greek, ...functions, ["sqrt", "\\sqrt{#?}"], ["*", "\\cdot"], ...named, ...moving]);
}
