/** What experiments have found, as far as the page shows it beside their charts. */

/**
 * @typedef {import("./stream.js").Result} Result
 * @typedef {import("./stream.js").Found<"WorkPrecisionAnswer">} WorkPrecision
 * @typedef {import("./stream.js").Found<"StabilityAnswer">} Stability
 * @typedef {import("./stream.js").Found<"FidelityAnswer">} Fidelity
 * @typedef {Stability["methods"][number]} FailingStep
 * @typedef {Fidelity["rungs"][number]} Rung
 * @typedef {{"work-precision": WorkPrecision, stability: Stability, fidelity: Fidelity}} Results
 */

/**
 * What the experiment of a name has found; null if it was another one, or none.
 * @template {keyof Results} E @param {Result | null} result @param {E} experiment @returns {Results[E] | null}
 */
export const resultOf = (result, experiment) =>
  result?.experiment === experiment ? /** @type {Results[E]} */ (result) : null;
