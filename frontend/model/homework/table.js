/**
 * Tables as spreadsheets write and read them: comma, semicolon or tab between the cells, and several encodings. Where a
 * semicolon separates the cells, the comma stands in the numbers. A table is written as the one that it answers was.
 */

/** @typedef {Record<string, string>} Row */
/** @typedef {{separator: string, marked: boolean}} Style  `marked`: it begins with a byte order mark, for which spreadsheets look */
/** @typedef {{header: string[], rows: Row[], style: Style}} Table */

const SEPARATORS = [",", ";", "\t"];
const MARK = "\ufeff";
/** The first line by which spreadsheets tell each other the separator. */
const TOLD = /^"?sep=([,;\t])"?\s*\n/i;
/** The key of cells for which the header has no name. */
export const BEYOND = "beyond the header";

/** @type {Style} */
export const PLAIN = { separator: ",", marked: false };

/** The rows of a CSV that are not empty. @param {string} text @param {string} separator @returns {string[][]} */
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
      cell = endCell(rows, cell);
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

/** UTF-16 and UTF-8 by their marks, UTF-8 without, else what a spreadsheet in the west of Europe writes. @param {Uint8Array} bytes */
function decoded(bytes) {
  const [first, second] = bytes;
  const encoding = first === 0xff && second === 0xfe ? "utf-16le" : first === 0xfe && second === 0xff ? "utf-16be" : "utf-8";
  try {
    const text = new TextDecoder(encoding, { fatal: true, ignoreBOM: true }).decode(bytes);
    return { text: text.replace(MARK, ""), marked: text.startsWith(MARK) };
  } catch {
    return { text: new TextDecoder("windows-1252").decode(bytes), marked: true };
  }
}

/** The columns by their names in lower case, and the rows below. @param {Uint8Array} bytes @returns {Table} */
export function readTable(bytes) {
  const { text, marked } = decoded(bytes);
  const lines = text.replace(/\r\n?/g, "\n");
  const [first] = lines.split("\n", 1);
  const told = TOLD.exec(lines);
  const separator = told ? told[1] : SEPARATORS.reduce((best, one) => (first.split(one).length > first.split(best).length ? one : best));
  const [names = [], ...rows] = cellsOf(lines.replace(TOLD, ""), separator);
  const header = names.map((name) => name.trim().toLowerCase());
  return { header, rows: rows.map((row) => rowOf(header, row)), style: { separator, marked } };
}

/** @param {string[]} header @param {string[]} cells @returns {Row} */
function rowOf(header, cells) {
  const beyond = cells.slice(header.length).filter((cell) => cell.trim());
  return Object.fromEntries([...header.map((name, i) => [name, cells[i] ?? ""]), ...(beyond.length ? [[BEYOND, beyond.join(" ")]] : [])]);
}

/** A cell that a spreadsheet would take for a formula is made a text. @param {unknown} value @param {string} separator */
function written(value, separator) {
  if (typeof value === "number") return separator === ";" ? String(value).replace(".", ",") : String(value);
  const text = String(value ?? "");
  const harmless = /^[=+\-@\t\r]/.test(text) ? `'${text}` : text;
  return /["\n\r]/.test(harmless) || harmless.includes(separator) ? `"${harmless.replaceAll('"', '""')}"` : harmless;
}

/** @param {readonly string[]} names @param {readonly Record<string, unknown>[]} rows @param {Style} style */
export function writeTable(names, rows, { separator, marked } = PLAIN) {
  const lines = [names, ...rows.map((row) => names.map((name) => row[name]))];
  return (marked ? MARK : "") + lines.map((line) => `${line.map((value) => written(value, separator)).join(separator)}\n`).join("");
}
