/** The motion that a place in a bifurcation diagram belongs to. */

/** @typedef {import("../types.js").Contract} Contract */
/** @typedef {Contract["BifurcationAnswer"]} Answer */
/** @typedef {{value: number, initial?: Contract["Visit"]["initial"], seen: readonly number[]}} Motion */

/** What a trace of the diagram is made of. @param {Answer} result @param {import("./chart.js").Contract["TraceMeaning"]} meaning @returns {readonly Motion[]} */
function motionsOf(result, { role, part }) {
  if (role === "sweep") return part === "up" ? result.up : result.down;
  if (role === "bifurcation") return result.bifurcations.filter(({ kind }) => kind === part);
  return role === "branch" ? (result.branches[Number(part)]?.motions ?? []) : [];
}

/**
 * The motion next to a place: at that value of the parameter, and where several have it, the one that is seen there.
 * @param {Answer} result @param {import("./chart.js").Contract["TraceMeaning"]} meaning @param {number} x @param {number} y
 * @returns {{parameters: Record<string, number>, initial: Record<string, Contract["Begin"]>} | null}
 */
export function motionAt(result, meaning, x, y) {
  const away = (/** @type {Motion} */ { seen }) => Math.min(...seen.map((one) => Math.abs(one - y)));
  const [nearest] = [...motionsOf(result, meaning)]
    .filter(({ initial }) => initial)
    .sort((a, b) => Math.abs(a.value - x) - Math.abs(b.value - x) || away(a) - away(b));
  return nearest?.initial ? { parameters: { [result.parameter]: nearest.value }, initial: nearest.initial } : null;
}
