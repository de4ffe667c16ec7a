/** A scene document as TOML 1.0, in the order and manner of the scene files. */

/** @typedef {import("../own.js").SceneDocument} SceneDocument */

const HEAD = ["format", "id", "title", "summary", "dimension"];
const BARE = /^[A-Za-z0-9_-]+$/;

/** @param {string} key */
const keyText = (key) => (BARE.test(key) ? key : string(key));

/** @param {string} text */
function string(text) {
  const escaped = text
    .replace(/["\\]/g, "\\$&")
    .replace(/\p{Cc}/gu, (c) => `\\u${c.charCodeAt(0).toString(16).padStart(4, "0")}`);
  return `"${escaped.replaceAll("\\u000a", "\\n").replaceAll("\\u0009", "\\t")}"`;
}

/** @param {unknown} value */
const isTable = (value) => Boolean(value) && typeof value === "object" && !Array.isArray(value);
/** TOML has no null: what is null is left out. @param {object} table */
const entries = (table) => Object.entries(table).filter(([, value]) => value !== null && value !== undefined);

/** @param {unknown} value @returns {string} */
function inline(value) {
  if (typeof value === "string") return string(value);
  if (typeof value === "number")
    return Number.isInteger(value) && Math.abs(value) >= 1e15 ? value.toExponential() : String(value);
  if (Array.isArray(value))
    return value.some(isTable)
      ? `[\n${value.map((one) => `  ${inline(one)},\n`).join("")}]`
      : `[${value
          .filter((one) => one !== null)
          .map(inline)
          .join(", ")}]`;
  if (!isTable(value)) return String(value);
  const inside = entries(/** @type {object} */ (value)).map(([key, one]) => `${keyText(key)} = ${flat(one)}`);
  return inside.length ? `{ ${inside.join(", ")} }` : "{}";
}

/** Within a table on one line everything stays on it. @param {unknown} value @returns {string} */
const flat = (value) => (Array.isArray(value) ? `[${value.map(flat).join(", ")}]` : inline(value));

/** @param {object} table */
const lines = (table) =>
  entries(table)
    .map(([key, value]) => `${keyText(key)} = ${inline(value)}\n`)
    .join("");

/** @param {SceneDocument} document */
export function tomlOf(document) {
  const rest = entries(document).filter(([key]) => !HEAD.includes(key));
  const isList = (/** @type {unknown} */ value) => Array.isArray(value) && value.length > 0 && value.every(isTable);
  const head = [
    ...HEAD.filter((key) => document[key] !== null && document[key] !== undefined).map((key) => [key, document[key]]),
    ...rest.filter(([, value]) => !isTable(value) && !isList(value)),
  ];
  const lists = rest
    .filter(([, value]) => isList(value))
    .flatMap(([key, rows]) => rows.map((/** @type {object} */ row) => `\n[[${keyText(key)}]]\n${lines(row)}`));
  const tables = rest
    .filter(([, value]) => isTable(value))
    .map(([key, table]) => `\n[${keyText(key)}]\n${lines(table)}`);
  return lines(Object.fromEntries(head)) + lists.join("") + tables.join("");
}
