/** What is to be varied, as it is typed; as a request; and as an address. */

import { oneOf } from "../url.js";

/** @typedef {import("../types.js").Contract["VariationRequest"]} Request */
/** @typedef {import("../types.js").Contract["IntegralFunctional"]} Integral */
/** @typedef {typeof HOLDS[number]} End  what holds the functions there */
/** @typedef {"expression" | "value" | "integral"} Kind  the value of f itself, at an instant, or the integral over the time */
/**
 * @typedef {object} Question
 * @property {Kind} kind
 * @property {string} expression
 * @property {NonNullable<Request["syntax"]>} syntax
 * @property {string} functions  names, by commas
 * @property {string} direction  names of the directions, by commas; δ of each function if empty
 * @property {string} parameters  names, by commas
 * @property {string} at  the instant
 * @property {string} from
 * @property {string} to
 * @property {NonNullable<Integral["ends"]>} ends
 * @property {Record<string, string>} samples  x(t) by function
 * @property {Record<string, string>} along  v(t) by function
 * @property {Record<string, string>} values  by parameter
 * @property {string} t  the instant at which an expression is looked at
 */

/** @type {Question} */
export const EMPTY = {
  kind: "expression",
  expression: "",
  syntax: "plain",
  functions: "x",
  direction: "",
  parameters: "",
  at: "0",
  from: "0",
  to: "1",
  ends: "fixed",
  samples: {},
  along: {},
  values: {},
  t: "1",
};
export const KINDS = /** @type {const} */ (["expression", "value", "integral"]);
const SYNTAXES = /** @type {const} */ (["plain", "latex"]);
/** What holds the functions at an end: they and their rates are prescribed, they alone are, or nothing is. */
export const HOLDS = /** @type {const} */ (["fixed", "hinged", "free"]);
const USUAL = { samples: "sin(t)", along: "t", values: "1" };
const TEXTS = /** @type {const} */ (["expression", "functions", "direction", "parameters", "at", "from", "to", "t"]);
const TABLES = /** @type {const} */ (["samples", "along", "values"]);
const LONGEST = 2000;

/** The names in a list by commas. @param {string} text */
export const namesIn = (text) => text.split(/[,;\s]+/).filter(Boolean);
/** What is typed for a name, or what stands there until something is. @param {Question} question @param {"samples" | "along" | "values"} table @param {string} name */
export const textOf = (question, table, name) => question[table][name] ?? USUAL[table];
/** Both ends in one word: "fixed" for both, "fixed-free" for the lower and the upper. @param {End} lower @param {End} upper @returns {Question["ends"]} */
export const endsOf = (lower, upper) =>
  lower === upper ? lower : /** @type {Question["ends"]} */ (`${lower}-${upper}`);
/** @param {Question["ends"]} ends @returns {[End, End]} */
export const bothEnds = (ends) => {
  const [lower, upper = lower] = /** @type {End[]} */ (ends.split("-"));
  return [lower, upper];
};
export const ENDS = HOLDS.flatMap((lower) => HOLDS.map((upper) => endsOf(lower, upper)));

/** @param {Question} question @returns {Request["functional"]} */
function functionalOf({ kind, at, from, to, ends }) {
  if (kind === "integral") return { kind, from, to, ends };
  return kind === "value" ? { kind, at } : null;
}

/** @param {Question} question @param {import("../types.js").Lang} lang */
export function requestOf(question, lang) {
  const { expression, syntax } = question;
  const functional = functionalOf(question);
  const [functions, direction, parameters] = [question.functions, question.direction, question.parameters].map(namesIn);
  return { expression, syntax, functions, direction, parameters, functional, lang };
}

/** The same with concrete functions, for the difference quotient. @param {Question} question @param {import("../types.js").Lang} lang @returns {Request} */
export function quotientRequestOf(question, lang) {
  const request = requestOf(question, lang);
  const table = (/** @type {"samples" | "along"} */ key) =>
    Object.fromEntries(request.functions.map((name) => [name, textOf(question, key, name)]));
  const parameters = request.parameters.map((name) => [name, numberOf(textOf(question, "values", name))]);
  const numeric = /** @type {Request["numeric"]} */ ({
    functions: table("samples"),
    direction: table("along"),
    parameters: Object.fromEntries(parameters),
    t: numberOf(question.t),
  });
  return { ...request, include: ["quotient"], numeric };
}

/** A decimal comma is one; what is no number goes as it is, for the server to say so. @param {string} text */
export function numberOf(text) {
  const plain = text.trim().replace(",", ".");
  return plain && Number.isFinite(Number(plain)) ? Number(plain) : text;
}

/** The query of a question; what is as in an empty one is left out. @param {Question} question */
export function writeQuestion(question) {
  const query = new URLSearchParams();
  for (const key of /** @type {const} */ (["kind", "syntax", "ends", ...TEXTS]))
    if (question[key] !== EMPTY[key]) query.set(key, question[key]);
  for (const key of TABLES) {
    const entries = Object.entries(question[key]);
    if (entries.length) query.set(key, entries.map(([name, text]) => `${name}:${text}`).join(";"));
  }
  return query
    .toString()
    .replaceAll("%3A", ":")
    .replaceAll("%2C", ",")
    .replaceAll("%28", "(")
    .replaceAll("%29", ")")
    .replaceAll("%3B", ";");
}

/** The question in a query; null if it has none. @param {string} query @returns {Question | null} */
export function readQuestion(query) {
  const given = new URLSearchParams(query);
  if (!given.get("expression")) return null;
  const texts = TEXTS.map((key) => [key, (given.get(key) ?? EMPTY[key]).slice(0, LONGEST)]);
  const tables = TABLES.map((key) => [key, Object.fromEntries(pairsIn((given.get(key) ?? "").slice(0, LONGEST)))]);
  return {
    ...EMPTY,
    ...Object.fromEntries([...texts, ...tables]),
    kind: oneOf(KINDS, given.get("kind"), EMPTY.kind),
    syntax: oneOf(SYNTAXES, given.get("syntax"), EMPTY.syntax),
    ends: oneOf(ENDS, given.get("ends"), EMPTY.ends),
  };
}

/** @param {string} text @returns {[string, string][]} */
function pairsIn(text) {
  const cut = text.split(";").map((pair) => /^(\w+):(.*)$/s.exec(pair.trim()));
  return cut.flatMap((found) => (found ? [/** @type {[string, string]} */ ([found[1], found[2]])] : []));
}
