/** What experiments have found, as far as the page shows it beside their charts. */

/**
 * @typedef {import("./stream.js").Result} Result
 * @typedef {Result & {cheapest: {wanted: number, method: string, time: number, step?: number | null, tolerance?: number | null}[]}} WorkPrecision
 * @typedef {{method: string, bound: number | null, predicted: number | null, measured: number | null, deviation: number | null,
 *   basis: string, cause: string, reason: string, limit: number | null}} FailingStep
 * @typedef {Result & {eigenvalues: [number, number][], methods: FailingStep[], at: string, rest: boolean, varies: number}} Stability
 * @typedef {{id: string, parts: {kind: string, parameters: Record<string, string>}[], degrees: number, refused: object[],
 *   scene: import("../own.js").SceneDocument | null}} Rung
 * @typedef {{rung: string, status: string, error?: number | null, survives?: boolean | null, nudged?: number | null,
 *   operations?: {total: number} | null, time?: number[] | null}} MeasuredRung
 * @typedef {Result & {rungs: Rung[], measured: MeasuredRung[], names: import("./ladder.js").Names, tolerance: number, least: string,
 *   ending: string, until: number}} Fidelity
 * @typedef {{"work-precision": WorkPrecision, stability: Stability, fidelity: Fidelity}} Results
 */

/**
 * What the experiment of a name has found; null if it was another one, or none.
 * @template {keyof Results} E @param {Result | null} result @param {E} experiment @returns {Results[E] | null}
 */
export const resultOf = (result, experiment) =>
  result?.experiment === experiment ? /** @type {Results[E]} */ (result) : null;
