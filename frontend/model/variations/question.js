/** What is to be varied, as it is typed; as a request; and as an address. */

/** @typedef {"expression" | "value" | "integral"} Kind  the value of f itself, at an instant, or the integral over the time */
/**
 * @typedef {object} Question
 * @property {Kind} kind
 * @property {string} expression
 * @property {"plain" | "latex"} syntax
 * @property {string} functions  names, by commas
 * @property {string} direction  names of the directions, by commas; δ of each function if empty
 * @property {string} parameters  names, by commas
 * @property {string} at  the instant
 * @property {string} from
 * @property {string} to
 * @property {string} ends
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
export const ENDS = ["fixed", "free", "fixed-free", "free-fixed"];
const USUAL = { samples: "sin(t)", along: "t", values: "1" };
const TEXTS = /** @type {const} */ (["expression", "functions", "direction", "parameters", "at", "from", "to", "t"]);
const TABLES = /** @type {const} */ (["samples", "along", "values"]);
const LONGEST = 2000;

/** The names in a list by commas. @param {string} text */
export const namesIn = (text) => text.split(/[,;\s]+/).filter(Boolean);
/** What is typed for a name, or what stands there until something is. @param {Question} question @param {"samples" | "along" | "values"} table @param {string} name */
export const textOf = (question, table, name) => question[table][name] ?? USUAL[table];
/** Both ends in one word: "fixed" for both, "fixed-free" for the lower and the upper. @param {string} lower @param {string} upper */
export const endsOf = (lower, upper) => (lower === upper ? lower : `${lower}-${upper}`);
/** @param {string} ends */
export const bothEnds = (ends) => (ends.includes("-") ? ends.split("-") : [ends, ends]);

/** @param {Question} question @param {string} lang */
export function requestOf(question, lang) {
  const { kind, expression, syntax, at, from, to, ends } = question;
  const functional = { expression: null, value: { kind, at }, integral: { kind, from, to, ends } }[kind];
  const [functions, direction, parameters] = [question.functions, question.direction, question.parameters].map(namesIn);
  return { expression, syntax, functions, direction, parameters, functional, lang };
}

/** The same with concrete functions, for the difference quotient. @param {Question} question @param {string} lang */
export function quotientRequestOf(question, lang) {
  const request = requestOf(question, lang);
  const table = (/** @type {"samples" | "along" | "values"} */ key, /** @type {string[]} */ names) =>
    names.map((name) => [name, textOf(question, key, name)]);
  const numeric = {
    functions: Object.fromEntries(table("samples", request.functions)),
    direction: Object.fromEntries(table("along", request.functions)),
    parameters: Object.fromEntries(table("values", request.parameters).map(([name, text]) => [name, numberOf(text)])),
    t: numberOf(question.t),
  };
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
  const oneOf = (
    /** @type {readonly string[]} */ allowed,
    /** @type {string} */ key,
    /** @type {string} */ otherwise,
  ) => {
    const value = given.get(key) ?? "";
    return allowed.includes(value) ? value : otherwise;
  };
  const texts = TEXTS.map((key) => [key, (given.get(key) ?? EMPTY[key]).slice(0, LONGEST)]);
  const tables = TABLES.map((key) => [key, Object.fromEntries(pairsIn((given.get(key) ?? "").slice(0, LONGEST)))]);
  return {
    ...EMPTY,
    ...Object.fromEntries([...texts, ...tables]),
    kind: /** @type {Kind} */ (oneOf(KINDS, "kind", EMPTY.kind)),
    syntax: /** @type {"plain" | "latex"} */ (oneOf(["plain", "latex"], "syntax", EMPTY.syntax)),
    ends: oneOf(ENDS, "ends", EMPTY.ends),
  };
}

/** @param {string} text @returns {[string, string][]} */
function pairsIn(text) {
  const cut = text.split(";").map((pair) => /^(\w+):(.*)$/s.exec(pair.trim()));
  return cut.flatMap((found) => (found ? [/** @type {[string, string]} */ ([found[1], found[2]])] : []));
}
