/** Steps worth looking at for a scene with these eigenvalues. */

/**
 * The range of a slider for h: from where nothing fails to where everything explicit has.
 * @param {number[][]} eigenvalues  [Re λ, Im λ]
 * @returns {[number, number]}
 */
export function stepRange(eigenvalues) {
  const fastest = Math.max(...eigenvalues.map(([re, im]) => Math.hypot(re, im)), 0) || 1;
  return [0.02 / fastest, 8 / fastest];
}
