/**
 * Sentences of the server: words, with formulas between dollar signs. A dollar sign of a user is written ＄ there, so that it opens no formula.
 * What users wrote and comes by itself (titles, labels, names) is no sentence: templates show it as text.
 */

/** @typedef {string} CatalogText  a sentence that the server made: only its formulas are markup */
/** @typedef {{ text: string, formula: boolean }} Piece */

/** Words and formulas in their order; a dollar sign without a second one is a sign like any other. @param {CatalogText} sentence @returns {Piece[]} */
export function pieces(sentence) {
  const parts = sentence.split("$");
  if (parts.length % 2 === 0) return [{ text: sentence, formula: false }];
  return parts
    .map((text, i) => (i % 2 ? { text, formula: true } : { text: text.replaceAll("＄", "$"), formula: false }))
    .filter(({ text }) => text);
}

/** A sentence without markup, for titles and screen readers. @param {CatalogText} sentence */
export const plainly = (sentence) =>
  pieces(sentence)
    .map(({ text, formula }) => (formula ? text.replace(/\\(htmlClass\{[^}]*\}|[a-z]+)|[{}\\]/g, "$1") : text))
    .join("");

// What the server marks in formulas, and the page itself where a term comes from; names of users stand behind the hyphen.
const OWN =
  /^(?:(?:q|p|body|load|constraint|energy|term|vector|of)-[\w-]+|t(?:-\d+){3}|differential|variation|time-term|slip)$/;

/** Whether all of these are classes that formulas have; any other would let LaTeX look like a part of the page. @param {string} classes */
export const areOfFormulas = (classes) => classes.split(/\s+/).every((name) => OWN.test(name));
