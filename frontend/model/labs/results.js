/** What experiments have found. */

/**
 * What each experiment answers, by its name.
 * @typedef {import("../types.js").Paths} Paths
 * @typedef {{[P in keyof Paths as P extends `/api/v1/experiments/${infer E}` ? E : never]: P extends `/api/v1${infer A}`
 *   ? import("../types.js").Answered<A> : never}} Results
 */
/** @typedef {Omit<Results[keyof Results], "charts"> & {charts: import("./chart.js").Chart[]}} Result  of any of them */

/**
 * What the experiment of a name has found; null if it was another one, or none.
 * @template {keyof Results} E @param {Result | null} result @param {E} experiment @returns {Results[E] | null}
 */
export const resultOf = (result, experiment) =>
  result?.experiment === experiment ? /** @type {Results[E]} */ (/** @type {unknown} */ (result)) : null;
