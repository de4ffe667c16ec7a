/**
 * The symbols of a scene in its formulas, made known to the page: parameters by their number, `p-0`, `p-1` …, as the
 * server marks coordinates by theirs, and places and velocities of bodies as such. So each can be found in the drawing.
 *
 * What belongs to the whole system or to a coordinate is marked by what is to be found of it: `of-body_bob` in E, and
 * `of-q_0` with the loads that do work along it in Q₁; t by `of-time`. These give no colour.
 */

/** @typedef {import("./types.js").Step} Step */
/** @typedef {import("./types.js").Scene} Scene */

/** What stands as it is: classes, words, upright and bold letters, layout; and commands and letters that are no parameter. */
const OTHER = [
  String.raw`\\htmlClass\{[^}]*\}`,
  String.raw`\\(?:text|math[a-z]+|begin|end|operatorname)\{[^}]*\}(?:\[l\])?`,
  String.raw`\\\\(?:\[[^\]]*\])?`,
  String.raw`\\[a-zA-Z]+`,
  String.raw`[a-zA-Z](?:_(?:\{[^{}]*\}|[a-zA-Z0-9]))?`,
].join("|");
/** What takes the next letter by itself takes no class about it. */
const BARE = String.raw`(?<![_^]|\\(?:d?dot|sqrt|bar|hat|vec|[td]?frac|math[a-z]+)\s*)`;
const POWER = String.raw`(?:\^(?:\{[^{}]*\}|\d))?`;
const PLACE = /\\htmlClass\{(body-[\w-]+(?: [\w-]+)*)\}\{(?=\\mathbf\{([rv])\})/g;

/** The class of a parameter, "" for a name that is none. @param {Pick<Scene, "parameters">} scene @param {string | undefined} name */
export function parameterClass({ parameters }, name) {
  const index = parameters.findIndex((parameter) => parameter.name === name);
  return index < 0 ? "" : `p-${index}`;
}

/** Q₁ and p₁ with their index and what stands above it. */
const OF_COORDINATE = /([Qp])_\{\\htmlClass\{q-(\d+)\}\{(?:[^{}]|\{[^{}]*\})*\}\}(?:\^\{(?:[^{}]|\{[^{}]*\})*\})?/g;
const OF_SYSTEM = /\\htmlClass\{(energy-(?:kinetic|potential))\}\{|\\delta W_\{a\}/g;
/** Kinds of loads that have a potential. */
const STORING = /^(gravity|spring|potential)$/;
/** What of the drawing a symbol of the system belongs to. @type {Record<string, ("bodies" | "stores" | "loads" | "coordinates" | "time")[]>} */
const SYSTEM = {
  "energy-kinetic": ["bodies"],
  "energy-potential": ["stores"],
  "\\delta W_{a}": ["loads"],
  L: ["bodies", "stores"],
  t: ["time"],
  "\\mathbf{M}": ["bodies"],
  "\\mathbf{K}": ["stores"],
  "\\mathbf{D}": ["loads"],
  "\\mathbf{f}": ["loads"],
  "\\mathbf{q}": ["coordinates"],
  "\\mathbf{x}": ["coordinates"],
};

/** @typedef {Pick<Scene, "parameters"> & Partial<Pick<Scene, "bodies" | "loads" | "coordinates">>} Named */
/** @typedef {Pick<NonNullable<import("./types.js").Derivation["result"]>, "generalized_forces">} Forces */

/**
 * The classes of what each symbol of the system belongs to, and of each generalized force.
 * @param {Named} scene @param {Forces | null} [result]
 */
function belongings({ bodies = [], loads = [], coordinates = [] }, result) {
  const of = (/** @type {string} */ kind, /** @type {{name: string}[]} */ things) =>
    things.map(({ name }) => `of-${kind}_${name}`);
  const sets = {
    bodies: of("body", bodies),
    loads: of("load", loads),
    stores: of(
      "load",
      loads.filter(({ kind }) => STORING.test(kind)),
    ),
    coordinates: coordinates.map((_, i) => `of-q_${i}`),
    time: ["of-time"],
  };
  const forces = (result?.generalized_forces?.total ?? []).map(({ coordinate, terms = [] }) => ({
    coordinate,
    sources: [...new Set(terms.flatMap(({ sources }) => sources))].map((source) => `of-${source.replace(":", "_")}`),
  }));
  return {
    ofSystem: (/** @type {string} */ symbol) => (SYSTEM[symbol] ?? []).flatMap((set) => sets[set]).join(" "),
    ofCoordinate(/** @type {string} */ letter, /** @type {number} */ i) {
      const found = forces.find(({ coordinate }) => coordinate === coordinates[i]?.name);
      return [`of-q_${i}`, ...(letter === "Q" ? (found?.sources ?? []) : [])].join(" ");
    },
  };
}

/** A symbol and nothing that only begins like it. @param {string} latex */
const whole = (latex) =>
  `${latex.replace(/[\\^$.*+?()[\]{}|]/g, "\\$&")}${/\\[a-zA-Z]+$/.test(latex) ? "(?![a-zA-Z])" : ""}`;

/** A symbol as it is written with and without braces about its index. @param {string} latex */
function spellings(latex) {
  const [, base, index] = /^(.*?)_\{?([^{}]*)\}?$/.exec(latex) ?? [];
  return index ? [`${base}_{${index}}`, ...(index.length === 1 ? [`${base}_${index}`] : [])] : [latex];
}

/** Symbols that the scene has given another meaning. @param {Named} scene */
const takenBy = ({ parameters, coordinates = [] }) =>
  new Set([...parameters, ...coordinates].flatMap(({ name, latex }) => spellings(latex || name)));

/**
 * What marks the parameters of a scene in a formula, and what belongs to the whole system; a power stays with its base,
 * over the index of which it stands.
 * @param {Named} scene @param {Forces | null} [result] @returns {(latex: string) => string}
 */
export function markerOf(scene, result) {
  const { parameters = [] } = scene;
  const { ofSystem, ofCoordinate } = belongings(scene, result);
  const taken = takenBy({ ...scene, parameters });
  const numbers = new Map(
    parameters.flatMap(({ name, latex }, i) =>
      spellings(latex || name).map((text) => /** @type {const} */ ([text, i])),
    ),
  );
  const longest = [...numbers.keys()].sort((a, b) => b.length - a.length).map(whole);
  const pattern = new RegExp(`${BARE}(${longest.join("|") || "(?!)"})(?!_)${POWER}|${OTHER}`, "g");
  const bare = new RegExp(`${BARE}$`);
  /** @param {string} symbol @param {string} before */
  function ofWhole(symbol, before) {
    const classes = symbol in SYSTEM && !taken.has(symbol) && bare.test(before) ? ofSystem(symbol) : "";
    return classes ? `\\htmlClass{${classes}}{${symbol}}` : symbol;
  }
  return (latex) =>
    latex
      .replace(PLACE, "\\htmlClass{$1 vector-$2}{")
      .replace(OF_SYSTEM, (all, energy) => {
        const classes = ofSystem(energy ?? all);
        if (!classes) return all;
        return energy ? `\\htmlClass{${energy} ${classes}}{` : `\\htmlClass{${classes}}{${all}}`;
      })
      .replace(OF_COORDINATE, (all, letter, i) => `\\htmlClass{${ofCoordinate(letter, Number(i))}}{${all}}`)
      .replace(pattern, (all, symbol, at, text) =>
        symbol ? `\\htmlClass{p-${numbers.get(symbol)}}{${all}}` : ofWhole(all, text.slice(0, at)),
      );
}

/** A step whose formulas have their symbols marked, with all parts of it. @param {Step} step @param {(latex: string) => string} mark @returns {Step} */
export function withSymbols(step, mark) {
  const formula = step.marked || step.latex;
  const substeps = step.substeps?.map((part) => withSymbols(part, mark));
  return { ...step, ...(formula ? { marked: mark(formula) } : {}), ...(substeps ? { substeps } : {}) };
}
