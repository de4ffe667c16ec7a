/**
 * What of the drawing symbols belong to that stand for no single thing in it: those of the whole system, generalized
 * forces, and constraints with their multipliers. Classes `of-body_bob`, `of-load_spring`, `of-q_0`, `of-constraint_rod`,
 * `of-time`; they give no colour.
 */

/** @typedef {Pick<import("./types.js").Scene, "parameters"> & Partial<Pick<import("./types.js").Scene, "bodies" | "loads" | "coordinates" | "constraints">>} Named */
/** @typedef {Partial<Pick<NonNullable<import("./types.js").Derivation["result"]>, "generalized_forces" | "constraints">>} Results */
/** @typedef {"bodies" | "stores" | "fields" | "damping" | "loads" | "coordinates" | "constraints" | "time"} Kind */

/** Kinds of loads that have a potential, one that may depend on rates, and those that take energy. */
const STORING = /^(gravity|spring|potential)$/;
const FIELD = /^generalized-potential$/;
const DAMPING = /^(damper|dissipation)$/;

/** What a symbol belongs to: the first of these that the scene has. @type {Record<string, Kind[][]>} */
const SYSTEM = {
  "energy-kinetic": [["bodies"]],
  "energy-potential": [["stores"]],
  "\\delta W_{a}": [["loads"]],
  "\\delta W^{z}": [["constraints"]],
  "\\delta W": [["loads"]],
  W: [["loads"]],
  L: [["bodies", "stores"]],
  h: [["bodies", "stores"]],
  I: [["bodies", "stores"]],
  R: [["damping"], ["bodies", "stores"]],
  U: [["fields"], ["bodies", "stores"]],
  V: [["stores"]],
  s: [["constraints"]],
  t: [["time"]],
  M: [["bodies"]],
  K: [["stores"], ["loads"]],
  D: [["loads"]],
  f: [["loads"]],
  x: [["coordinates"]],
  y: [["coordinates"]],
  "\\mathbf{M}": [["bodies"]],
  "\\mathbf{K}": [["stores"], ["loads"]],
  "\\mathbf{D}": [["loads"]],
  "\\mathbf{f}": [["loads"]],
  "\\mathbf{A}": [["constraints"]],
  "\\mathbf{N}": [["constraints"]],
  "\\boldsymbol{\\lambda}": [["constraints"]],
  "\\mathbf{q}": [["coordinates"]],
  "\\mathbf{x}": [["coordinates"]],
  "\\mathbf{y}": [["coordinates"]],
  "\\Phi": [["constraints"]],
  "\\omega": [["coordinates"]],
  "\\kappa": [["coordinates"]],
  "\\lambda": [["constraints"], ["coordinates"]],
  "\\varepsilon": [["coordinates"]],
};

/** Symbols with an index: modes their number, what is meant at an equilibrium 0, on its constraints r. @param {string} symbol */
const unnumbered = (symbol) => symbol.replace(/_(?:\{\d+\}|[\dr])$/, "");

/**
 * The classes of what each symbol of the system belongs to, "" for one that is none, and of each generalized force, by
 * its letter and the number of its coordinate.
 * @param {Named} scene @param {Results | null} [result]
 */
export function belongings({ bodies = [], loads = [], coordinates = [], constraints }, result) {
  const of = (/** @type {string} */ kind, /** @type {readonly {name: string}[]} */ things) =>
    things.map(({ name }) => `of-${kind}_${name}`);
  const ofLoads = (/** @type {RegExp} */ kinds) =>
    of(
      "load",
      loads.filter(({ kind }) => kinds.test(kind)),
    );
  const sets = {
    bodies: of("body", bodies),
    loads: of("load", loads),
    stores: ofLoads(STORING),
    fields: ofLoads(FIELD),
    damping: ofLoads(DAMPING),
    coordinates: coordinates.map((_, i) => `of-q_${i}`),
    constraints: (constraints ?? []).map(({ name }) => ofConstraint(name ?? "")),
    time: ["of-time"],
  };
  const forces = (result?.generalized_forces?.total ?? []).map(({ coordinate, terms = [] }) => ({
    coordinate,
    sources: [...new Set(terms.flatMap(({ sources }) => sources))].map((source) => `of-${source.replace(":", "_")}`),
  }));
  return {
    ofSystem(/** @type {string} */ symbol) {
      const kinds = SYSTEM[symbol] ?? SYSTEM[unnumbered(symbol)] ?? [];
      const found = kinds.map((some) => some.flatMap((kind) => sets[kind])).find((names) => names.length);
      return (found ?? []).join(" ");
    },
    ofCoordinate(/** @type {string} */ letter, /** @type {number} */ i) {
      const found = forces.find(({ coordinate }) => coordinate === coordinates[i]?.name);
      return [`of-q_${i}`, ...(letter === "Q" ? (found?.sources ?? []) : [])].join(" ");
    },
  };
}

/** What marks a constraint, its multiplier and its work: what keeps it in the drawing, and the arrow of its reaction. @param {string} name */
export const ofConstraint = (name) => `constraint-${name} of-constraint_${name} vector-z`;

/**
 * What multipliers are called, and the classes of their reactions: of the colour that they have in the plots, too, where
 * they come behind the coordinates.
 * @param {Named} scene @param {Results | null | undefined} result @returns {[string, string][]} LaTeX and classes
 */
export const multipliersOf = ({ coordinates = [] }, result) =>
  (result?.constraints ?? []).map(({ name, multiplier }, k) => [
    multiplier.latex,
    `q-${coordinates.length + k} ${ofConstraint(name)}`,
  ]);
