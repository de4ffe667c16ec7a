/** The LaTeX of formulas as a sequence of tokens: cutting it where nothing is open, and guessing how wide it is. */

const OPENING = /^(\{|\(|\[|\\left|\\begin)/;
const CLOSING = /^(\}|\)|\]|\\right|\\end)/;
const BRACKET = /^[()[\]]$/;
const TOKEN =
  /\\begin\{[a-z*]+\}|\\end\{[a-z*]+\}|\\left(?:\\[a-zA-Z{}|]+|.)|\\right(?:\\[a-zA-Z{}|]+|.)|\\\\(?:\[[^\]]*\])?|\\[a-zA-Z]+|\\.|[\s\S]/g;
const MATRIX = /\\begin\{(bmatrix\*?)\}(?:\[l\])?([\s\S]*?)\\end\{\1\}/g;

/** @param {string} latex */
export const tokensOf = (latex) => [...latex.matchAll(TOKEN)].map(([token]) => token);

/**
 * Cuts before every token of the outermost level for which `where` holds.
 * @param {string} latex @param {(token: string, before: string) => boolean} where  before: what the piece holds so far
 * @param {number} [levels]  how many brackets within each other count as the outermost level, too
 */
export function cut(latex, where, levels = 0) {
  const pieces = [""];
  let [depth, passed] = [0, 0];
  for (const token of tokensOf(latex)) {
    const opens = OPENING.test(token);
    const closes = CLOSING.test(token);
    const bracket = depth === 0 && BRACKET.test(token);
    if (closes && bracket && passed > 0) passed -= 1;
    // A bracket that a piece before has opened closes nothing here.
    else if (closes) depth = Math.max(0, depth - 1);
    if (depth === 0 && where(token, pieces[pieces.length - 1])) pieces.push("");
    pieces[pieces.length - 1] += token;
    if (opens && bracket && passed < levels) passed += 1;
    else if (opens) depth += 1;
  }
  return pieces;
}

/** Parts with the separators between them, which end the part before. @param {string} latex @param {(token: string) => boolean} separates */
export function parted(latex, separates) {
  let ended = false;
  return cut(latex, (token) => {
    const starts = ended;
    ended = separates(token);
    return starts;
  });
}

/** @param {string} token */
export const endsRow = (token) => token.startsWith("\\\\");

/** The entries of a matrix by rows. @param {string} body  between its beginning and its end */
export function entriesOf(body) {
  return parted(body, endsRow).map((row) =>
    parted(row.replace(/\\\\(\[[^\]]*\])?$/, ""), (token) => token === "&").map((entry) =>
      entry.replace(/&$/, "").trim(),
    ),
  );
}

/** Every matrix of a formula made into something else. @param {string} latex @param {(matrix: string, entries: string[][]) => string} make */
export const withMatrices = (latex, make) => latex.replace(MATRIX, (matrix, _, body) => make(matrix, entriesOf(body)));

/** What is between the braces that begin at a token, and the token behind them. @param {string[]} tokens @param {number} begin @returns {[string, number]} */
export function groupAt(tokens, begin) {
  let [depth, at] = [0, begin];
  do {
    if (tokens[at] === "{") depth += 1;
    if (tokens[at] === "}") depth -= 1;
    at += 1;
  } while (depth > 0 && at < tokens.length);
  return [tokens.slice(begin + 1, at - 1).join(""), at];
}

/** Fractions within fractions would be set small twice in a matrix: the outermost of them is as large as outside. @param {string} matrix */
function unshrunk(matrix) {
  const tokens = tokensOf(matrix);
  for (let at = 0; at < tokens.length; at += 1) {
    if (tokens[at] !== "\\frac" || tokens[at + 1] !== "{") continue;
    const [, middle] = groupAt(tokens, at + 1);
    const [, end] = groupAt(tokens, middle);
    if (!tokens.slice(at + 1, end).includes("\\frac")) continue;
    tokens[at] = "\\dfrac";
    at = end - 1;
  }
  return tokens.join("");
}

/** From one row of a matrix with fractions to the next, beyond what others have: set as closely they would touch; fractions of numbers that are set small need less. */
const AIR = { some: "\\\\[0.1em] ", full: "\\\\[0.3em] " };

/** Matrices with fractions, their rows apart. @param {string} latex */
export const airy = (latex) =>
  latex.replace(MATRIX, (given) => {
    const matrix = unshrunk(given);
    const large = /\\d?frac|\\tfrac(?!\{\d+\}\{\d+\})/.test(matrix);
    const apart = large ? AIR.full : /\\tfrac/.test(matrix) ? AIR.some : null;
    return apart ? matrix.replace(/\\\\(?!\[)\s*/g, () => apart) : matrix;
  });

/** A matrix is as wide as its columns, each as wide as its widest entry. @param {string[][]} entries */
function width(entries) {
  const columns = Math.max(...entries.map((row) => row.length));
  return Array.from({ length: columns }, (_, c) => Math.max(...entries.map((row) => weight(row[c] ?? "")))).reduce(
    (sum, column) => sum + column + 1,
    1,
  );
}

/** How wide a formula is, roughly, in letters. @param {string} latex @returns {number} */
export function weight(latex) {
  const flat = withMatrices(latex, (_, entries) => "x".repeat(width(entries)))
    .replace(/\\htmlClass\{[^}]*\}/g, "")
    .replace(/\\(begin|end)\{[^}]*\}|\\(left|right|[Bb]igg?[lr]|,|;|!|quad|qquad|,)|\\\\(\[[^\]]*\])?|[{}^_&\s]/g, "")
    .replace(/\\(dot|ddot|mathbf|mathrm|frac|text|partial)/g, (_, name) => (name === "partial" ? "∂" : ""))
    .replace(/\\(sin|cos|tan|exp|log)/g, "sin")
    .replace(/\\[a-zA-Z]+/g, "x");
  return flat.length;
}
