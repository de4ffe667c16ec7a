/** What a formula says, as a whole and term by term. */

/** @typedef {{spoken?: string, spoken_terms?: number[]}} Said  as the server says it; where its terms begin */

/** The terms of a formula, each with its sign, without the pauses between them. @param {Said} said */
export const termsOf = ({ spoken = "", spoken_terms: begins = [] }) =>
  begins.map((start, i) => spoken.slice(start, begins[i + 1]).replace(/[,.]?\s*$/, ""));

/** Which term a key leads to, null out of the formula; undefined if it leads nowhere. @param {string} key @param {number} at @param {number} count @returns {number | null | undefined} */
export function led(key, at, count) {
  const last = count - 1;
  /** @type {Record<string, number | null>} */
  const places = {
    ArrowRight: Math.min(at + 1, last),
    ArrowLeft: Math.max(at - 1, 0),
    Home: 0,
    End: last,
    Enter: at,
    Escape: null,
  };
  return places[key];
}
