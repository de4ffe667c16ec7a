/**
 * Long formulas in lines: a row too wide for its place goes on below, before a plus or minus of its outermost sum, as
 * textbooks set it. Classes that colour a sum as a whole are kept on each of its lines.
 */

const OPENING = /^(\{|\(|\[|\\left|\\begin)/;
const CLOSING = /^(\}|\)|\]|\\right|\\end)/;
/** In a term too long by itself a row may go on within brackets, as long as they need not fit their content. */
const BRACKET = /^[()[\]]$/;
const TOKEN = /\\begin\{[a-z*]+\}|\\end\{[a-z*]+\}|\\left(?:\\[a-zA-Z{}|]+|.)|\\right(?:\\[a-zA-Z{}|]+|.)|\\\\(?:\[[^\]]*\])?|\\[a-zA-Z]+|\\.|[\s\S]/g;
const RELATION = /^(=|\\(approx|equiv|neq|le|ge|Longleftrightarrow|Rightarrow|to))$/;
const ROWS = /^\\begin\{aligned\}([\s\S]*)\\end\{aligned\}$/;
/** What goes on below stands in from where its row began. */
const INDENT = "\\qquad {}";
/** Left sides that take more of a row than this, and more letters, have one of their own, and the relations hang below them. */
const HEAVY = 0.3;
const SHORT = 6;
const HANGING = "\\quad {}";

/**
 * Cuts before every token of the outermost level for which `where` holds.
 * @param {string} latex @param {(token: string, before: string) => boolean} where  before: what the piece holds so far
 * @param {boolean} [within]  whether brackets count as the outermost level, too
 */
function cut(latex, where, within = false) {
  const pieces = [""];
  let depth = 0;
  for (const [token] of latex.matchAll(TOKEN)) {
    const passed = within && BRACKET.test(token);
    if (!passed && CLOSING.test(token)) depth -= 1;
    if (depth === 0 && where(token, pieces[pieces.length - 1])) pieces.push("");
    pieces[pieces.length - 1] += token;
    if (!passed && OPENING.test(token)) depth += 1;
  }
  return pieces;
}

/** The rows of an aligned formula, each with the gap that follows it. @param {string} body */
function rowsOf(body) {
  let ended = false;
  return cut(body, (token) => {
    const starts = ended;
    ended = token.startsWith("\\\\");
    return starts;
  }).map((row) => {
    const [, text, gap] = /** @type {RegExpMatchArray} */ (row.match(/^([\s\S]*?)(\\\\(?:\[[^\]]*\])?)?$/));
    return { text, gap: gap ?? "" };
  });
}

/** How wide a formula is, roughly, in letters. @param {string} latex */
export function weight(latex) {
  const flat = latex
    .replace(/\\htmlClass\{[^}]*\}/g, "")
    .replace(/\\(begin|end)\{[^}]*\}|\\(left|right|,|;|!|quad|qquad|,)|\\\\(\[[^\]]*\])?|[{}^_&\s]/g, "")
    .replace(/\\(dot|ddot|mathbf|mathrm|frac|text|partial)/g, (_, name) => (name === "partial" ? "∂" : ""))
    .replace(/\\(sin|cos|tan|exp|log)/g, "sin")
    .replace(/\\[a-zA-Z]+/g, "x");
  return flat.length;
}

/** A sign that joins two terms, not one that leads a term or follows a relation. @param {string} token @param {string} before */
function joins(token, before) {
  const last = before.trim().split(/\s+/).at(-1) ?? "";
  return /^[+-]$/.test(token) && last !== "" && !RELATION.test(last) && !/[+([-]$/.test(last);
}

/** The terms of the outermost sum, each with its sign; a coloured sum counts by its own terms. @param {string} sum @param {number} most @returns {string[]} */
function termsOf(sum, most) {
  return cut(sum, joins).flatMap((term) => coloured(term, most) ?? (weight(term) > most ? cut(term, joins, true) : [term]));
}

/** The terms of a sum within one colour, each in that colour; null if the term is not such a sum. @param {string} term @param {number} most */
function coloured(term, most) {
  const found = term.match(/^\s*([=+]?)\s*\\htmlClass\{([^}]*)\}\{([\s\S]*)\}\s*$/);
  if (!found || closesEarly(found[3])) return null;
  const [, sign, names, content] = found;
  const inner = termsOf(content, most);
  return inner.length < 2 ? null : inner.map((part, i) => (i ? `\\htmlClass{${names}}{{}${part}}` : `${sign}\\htmlClass{${names}}{${part}}`));
}

/** Whether what looks like the inside of one group is the end of one and the beginning of another. @param {string} content */
function closesEarly(content) {
  let depth = 0;
  for (const [token] of content.matchAll(TOKEN)) {
    if (token === "{") depth += 1;
    if (token === "}" && --depth < 0) return true;
  }
  return false;
}

/** The two sides of a row: up to its mark of alignment, and after it. @param {string} row */
function sidesOf(row) {
  const [head, ...rest] = cut(row, (_, before) => before.endsWith("&"));
  return rest.length ? [head, rest.join("")] : ["", head];
}

/** @param {{text: string, gap: string}[]} rows @param {number} most */
function hung(rows, most) {
  const heaviest = Math.max(...rows.map(({ text }) => weight(sidesOf(text)[0])));
  if (heaviest <= Math.max(SHORT, HEAVY * most)) return rows;
  return rows.flatMap(({ text, gap }) => {
    const [left, right] = sidesOf(text);
    const row = { text: `& ${HANGING}${right}`, gap };
    return weight(left) ? [{ text: `& ${left.replace(/&$/, "")}`, gap: " \\\\[0.2em] " }, row] : [row];
  });
}

/** @param {string} row @param {number} most @returns {string[]} */
function broken(row, most) {
  if (weight(row) <= most) return [row];
  const [begin, whole] = sidesOf(row);
  const hangs = whole.trimStart().startsWith(HANGING);
  const [left, right] = hangs ? [`${begin} ${HANGING}`, whole.trimStart().slice(HANGING.length)] : [begin, whole];
  const lines = [left];
  for (const term of termsOf(right, most)) {
    const last = lines[lines.length - 1];
    if (weight(last) > 0 && last !== left && weight(last) + weight(term) > most) lines.push(`& ${INDENT}${term}`);
    else lines[lines.length - 1] += term;
  }
  return lines;
}

/**
 * The formula with rows of at most `part` of its widest one; a formula that cannot be broken comes back as it is.
 * @param {string} latex @param {number} part between 0 and 1
 */
export function brokenRows(latex, part) {
  const aligned = latex.trim().match(ROWS);
  const given = rowsOf(aligned ? aligned[1] : `& ${latex}`);
  const most = part * Math.max(...given.map(({ text }) => weight(text)));
  const rows = hung(given, most);
  const lines = rows.flatMap(({ text, gap }) => {
    const parts = broken(text, most);
    return parts.map((line, i) => line + (i < parts.length - 1 ? " \\\\[0.2em] " : gap));
  });
  return lines.length === given.length ? latex : `\\begin{aligned}${lines.join("")}\\end{aligned}`;
}
