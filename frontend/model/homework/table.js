/** Tables as files: comma, semicolon or tab between the cells, quotes around those that need them. */

const SEPARATORS = [",", ";", "\t"];

/** The rows of a CSV. @param {string} text @param {string} separator @returns {string[][]} */
function cellsOf(text, separator) {
  /** @type {string[][]} */
  const rows = [[]];
  let cell = "";
  let quoted = false;
  for (let i = 0; i < text.length; i += 1) {
    const letter = text[i];
    if (quoted && letter === '"' && text[i + 1] === '"') cell += text[(i += 1)];
    else if (letter === '"' && (quoted || cell === "")) quoted = !quoted;
    else if (!quoted && letter === separator) cell = endCell(rows, cell);
    else if (!quoted && letter === "\n") {
      cell = endCell(rows, cell.replace(/\r$/, ""));
      rows.push([]);
    } else cell += letter;
  }
  endCell(rows, cell);
  return rows.filter((row) => row.some((one) => one.trim()));
}

/** @param {string[][]} rows @param {string} cell */
function endCell(rows, cell) {
  rows[rows.length - 1].push(cell);
  return "";
}

/** The rows below the header, by its names in lower case. @param {string} text @returns {Record<string, string>[]} */
export function readTable(text) {
  const clean = text.replace(/^\ufeff/, "").replace(/\r\n?/g, "\n");
  const [first = ""] = clean.split("\n");
  const separator = SEPARATORS.reduce((best, one) => (first.split(one).length > first.split(best).length ? one : best));
  const [header = [], ...rows] = cellsOf(clean, separator);
  const names = header.map((name) => name.trim().toLowerCase());
  return rows.map((row) => Object.fromEntries(names.map((name, i) => [name, row[i] ?? ""])));
}

/** A cell that a spreadsheet would take for a formula is made a text. @param {unknown} value */
function safe(value) {
  const text = String(value ?? "");
  const harmless = typeof value === "string" && /^[=+\-@\t\r]/.test(text) ? `'${text}` : text;
  return /[",\n\r]/.test(harmless) ? `"${harmless.replaceAll('"', '""')}"` : harmless;
}

/** @param {readonly string[]} names @param {readonly Record<string, unknown>[]} rows */
export const writeTable = (names, rows) => [names, ...rows.map((row) => names.map((name) => row[name]))].map((row) => `${row.map(safe).join(",")}\n`).join("");
