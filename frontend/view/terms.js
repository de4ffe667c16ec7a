/** Where the terms of a typeset formula stand: cut at its signs, as they are said. */

const LIMIT = "\u200b";

/** How many brackets begin or end here: KaTeX writes neighbours as one. @param {Element} node @param {string} kind */
const brackets = (node, kind) =>
  node.classList.contains(kind) ? Math.max(1, (node.textContent ?? "").replaceAll(LIMIT, "").length) : 0;
/** @param {Element} node */
const relates = (node) => node.classList.contains("mrel");
/** @param {Element} node */
const adds = (node) => node.classList.contains("mbin") && /^[+−]$/.test(node.textContent ?? "");
/** Groups and marks, which are no symbols themselves. @param {Element} node */
const isGroup = (node) =>
  node.className === "mord" ? node.childElementCount > 0 : node.matches(".katex-base, .base, .enclosing, .katex-html");

/** @param {Element} node @returns {Iterable<Element>} */
function* symbols(node) {
  if (isGroup(node)) for (const child of node.children) yield* symbols(child);
  else if ((node.textContent ?? "").replaceAll(LIMIT, "").trim()) yield node;
  else if (node.querySelector("svg")) yield node;
}

/** The rows of the formula, each with what stands to the left and to the right of its sign. @param {Element} formula @returns {Element[][]} */
function rowsOf(formula) {
  const cells = [...formula.querySelectorAll(":scope > .rows > .cell")];
  if (cells.length)
    return cells.flatMap((cell, i) => (i % 2 ? [] : [[cell, cells[i + 1]]])).map((row) => row.map(inside));
  const html = formula.querySelector(".katex-html");
  // Lines are aligned at their signs; the columns of a matrix are centred.
  const table = html?.querySelector(".mtable");
  if (!table?.querySelector(":scope > .col-align-r")) return html ? [[html]] : [];
  const columns = [...table.children]
    .filter((column) => /col-align/.test(column.className))
    .map((column) => [...(column.querySelector(".vlist")?.children ?? [])]);
  return columns[0].map((_, row) =>
    columns.flatMap((column) => [...(column[row]?.children ?? [])].filter((one) => !one.matches(".pstrut"))),
  );
}

/** @param {Element} cell */
const inside = (cell) => cell.querySelector(".katex-html") ?? cell;

/** The symbols of every term, in the order in which the terms are said. @param {Element} formula @returns {Element[][]} */
export function termsIn(formula) {
  /** @type {Element[][]} */
  const terms = [];
  let depth = 0;
  for (const row of rowsOf(formula)) {
    let fresh = true;
    for (const symbol of row.flatMap((cell) => [...symbols(cell)])) {
      depth = Math.max(0, depth - brackets(symbol, "mclose"));
      const begins = depth === 0 && (fresh || adds(symbol) || relates(symbol));
      const afterSign = terms.at(-1)?.every(relates) && terms.length > 0 && !fresh;
      if (begins && !(afterSign && relates(symbol))) terms.push([]);
      (terms.at(-1) ?? terms[terms.push([]) - 1]).push(symbol);
      depth += brackets(symbol, "mopen");
      fresh = false;
    }
  }
  return terms;
}
