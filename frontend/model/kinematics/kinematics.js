/** Where everything stands for any values of the coordinates: r(P, t, q), its derivatives, and the virtual work. */

import { evaluator } from "./expression.js";

/** @typedef {import("../types.js").Scene} Scene */
/** @typedef {import("../types.js").Snapshot} Snapshot */
/** @typedef {import("../types.js").Derivation} Derivation */
/** @typedef {import("./expression.js").Values} Values */
/** @typedef {Record<string, number[]>} Places */

/** Step of the difference quotients: the error is its square times the third derivative, far below a pixel. */
const H = 1e-5;

/**
 * @typedef {object} Kinematics
 * @property {string[]} free  the coordinates that no guide prescribes
 * @property {(q: Values, t: number) => Places} places
 * @property {(q: Values, t: number, along: Values, time?: number) => Places} slope  Σ ∂r/∂qᵢ·alongᵢ + ∂r/∂t·time of every place
 * @property {(q: Values, rates: Values, t: number, delta: Values) => {load: string, work: number}[]} works  δW of every load
 * @property {Record<string, (now: Snapshot) => Places>} displacements  ∂r/∂l of places, by what is released
 * @property {Record<string, string>} held  what kind of thing holds it: "length" or "rod" where it is a single rod
 * @property {(now: Snapshot, multipliers: Values) => {constraint: string, multiplier: number, forces: Values}[]} reactions  Qᵢ of every constraint
 */

/**
 * @param {Scene} scene @param {NonNullable<Derivation["result"]>} result @param {Values} parameters as changed
 * @returns {Kinematics}
 */
export function kinematicsOf(scene, result, parameters) {
  const given = { ...Object.fromEntries(scene.parameters.map(({ name, value }) => [name, value])), ...parameters };
  const guided = new Set((scene.guides ?? []).map(({ coordinate }) => coordinate));
  const fields = Object.entries({ ...result.points, ...result.positions }).map(
    ([name, { plain }]) => /** @type {const} */ ([name, plain.map(evaluator)]),
  );
  const terms = (result.virtual_work?.terms ?? []).map(({ plain, sources }) => ({
    work: evaluator(plain),
    load: sources[0] ?? "",
  }));
  const constraints = (result.constraints ?? []).map(({ name, multiplier, forces }) => ({
    name,
    multiplier: multiplier.plain,
    forces: forces.map(({ coordinate, plain }) => ({ coordinate, of: evaluator(plain) })),
  }));

  const displacements = (result.reactions ?? []).map(({ name, displacements: moved }) => {
    const parts = Object.entries(moved ?? {}).map(
      ([place, along]) => /** @type {const} */ ([place, along.map(evaluator)]),
    );
    const at = (/** @type {Snapshot} */ { coordinates, rates, t }) => {
      const values = { ...given, ...coordinates, ...wrapped("dot", rates), t };
      return Object.fromEntries(parts.map(([place, along]) => [place, along.map((part) => part(values))]));
    };
    return /** @type {const} */ ([name, at]);
  });

  /** @param {Values} q @param {number} t @returns {Places} */
  function places(q, t) {
    const values = { ...given, ...q, t };
    return Object.fromEntries(fields.map(([name, parts]) => [name, parts.map((part) => part(values))]));
  }

  return {
    free: scene.coordinates.map(({ name }) => name).filter((name) => !guided.has(name)),
    places,
    displacements: Object.fromEntries(displacements),
    held: Object.fromEntries((result.reactions ?? []).map(({ name, kind }) => [name, kind])),
    slope(q, t, along, time = 0) {
      const [after, before] = [1, -1].map((sign) => places(moved(q, along, sign * H), t + sign * H * time));
      return Object.fromEntries(
        Object.entries(after).map(([name, place]) => [name, place.map((x, c) => (x - before[name][c]) / (2 * H))]),
      );
    },
    works(q, rates, t, delta) {
      const values = { ...given, ...q, ...wrapped("dot", rates), ...wrapped("delta", delta), t };
      const loads = [...new Set(terms.map(({ load }) => load))];
      return loads.map((load) => ({
        load: load.replace(/^load:/, ""),
        work: terms.filter((term) => term.load === load).reduce((sum, term) => sum + term.work(values), 0),
      }));
    },
    reactions({ coordinates, rates, t }, multipliers) {
      const values = { ...given, ...coordinates, ...wrapped("dot", rates), ...multipliers, t };
      return constraints.map(({ name, multiplier, forces }) => ({
        constraint: name,
        multiplier: multipliers[multiplier] ?? NaN,
        forces: Object.fromEntries(forces.map(({ coordinate, of }) => [coordinate, of(values)])),
      }));
    },
  };
}

/** q + s·along @param {Values} q @param {Values} along @param {number} s @returns {Values} */
export function moved(q, along, s = 1) {
  return Object.fromEntries(Object.entries(q).map(([name, value]) => [name, value + s * (along[name] ?? 0)]));
}

/** @param {"dot" | "delta"} operator @param {Values} values @returns {Values} */
const wrapped = (operator, values) =>
  Object.fromEntries(Object.entries(values).map(([name, value]) => [`${operator}(${name})`, value]));

/**
 * The snapshot of a configuration: what the drawing needs to show it.
 * @param {Kinematics} kinematics @param {Snapshot} now @param {Values} q
 * @returns {Snapshot}
 */
export function configured(kinematics, now, q) {
  const places = kinematics.places(q, now.t);
  const finite = Object.entries(places).filter(([, place]) => place.every(Number.isFinite));
  return { ...now, coordinates: q, positions: { ...now.positions, ...Object.fromEntries(finite) } };
}
