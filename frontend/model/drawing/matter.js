/** Where the matter of a body is. */

import { evaluator } from "../kinematics/expression.js";

/** @typedef {import("./stage.js").Stage} Stage */
/** @typedef {import("../types.js").Snapshot} Snapshot */
/** @typedef {import("../kinematics/expression.js").Values} Values */
/** @typedef {(values: Values) => number[] | null} Centre */

/** Nodes and weights of Gauss and Legendre on 0 … 1: exact for lines and planes of uniform density, and near enough else. */
const NODES = [
  [0.1127016653792583, 5 / 18],
  [0.5, 8 / 18],
  [0.8872983346207417, 5 / 18],
];

/**
 * The centre of mass: where its trajectory says, of a continuum ∫ r dm / ∫ dm; null where the page cannot read it.
 * @param {Stage} stage @param {Snapshot} now @param {string} name of a body or point @returns {number[] | null}
 */
export function massCentre(stage, now, name) {
  const body = stage.scene.bodies.find((candidate) => candidate.name === name);
  if (body?.kind !== "continuum") return now.positions[name] ?? null;
  const centre = stage.once(`centre of ${name}`, () => centreOf(body));
  const given = Object.fromEntries(stage.scene.parameters.map((parameter) => [parameter.name, parameter.value]));
  return centre?.({ ...given, ...now.coordinates, t: now.t }) ?? null;
}

/** @param {import("../types.js").Body} body @returns {Centre | null} */
function centreOf({ material, density, position }) {
  try {
    const axes = (material ?? []).map(({ name, from, to }) => ({ name, from: evaluator(from), to: evaluator(to) }));
    const [thick, parts] = [evaluator(density ?? "1"), (position ?? []).map(evaluator)];
    return (values) => {
      let [mass, sum] = [0, parts.map(() => 0)];
      for (const { at, weight } of pointsIn(axes, values)) {
        const dm = weight * thick(at);
        mass += dm;
        sum = sum.map((x, c) => x + dm * parts[c](at));
      }
      const centre = sum.map((x) => x / mass);
      return centre.every(Number.isFinite) ? centre : null;
    };
  } catch {
    return null;
  }
}

/**
 * Places in the material, with their share of it.
 * @param {{name: string, from: (values: Values) => number, to: (values: Values) => number}[]} axes @param {Values} values
 * @returns {{at: Values, weight: number}[]}
 */
function pointsIn(axes, values) {
  return axes.reduce(
    (points, { name, from, to }) =>
      points.flatMap(({ at, weight }) => {
        const [low, long] = [from(at), to(at) - from(at)];
        return NODES.map(([s, w]) => ({ at: { ...at, [name]: low + s * long }, weight: weight * w * long }));
      }),
    [{ at: values, weight: 1 }],
  );
}
