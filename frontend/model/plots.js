/** What the plots show: rows of curves over one time axis. */

import { largestError } from "./trajectory.js";
import { unitText } from "./numbers.js";

/** @typedef {import("./types.js").Trajectory} Trajectory */
/** @typedef {import("./types.js").Scene} Scene */
/** @typedef {{key: string, latex: string, className: string, values: number[], dash: string, band: boolean, beside?: number[]}} Curve  beside: the times of another run */
/** @typedef {{key: string, unit: string, curves: Curve[]}} Row */
/** @typedef {{ink: string, muted: string, grid: string, paper: string, of: (className: string) => string}} Palette */

/** An error estimate above this share of a row's range is shown as a band. */
const VISIBLE = 0.01;
const LEAST_RANGE = 1e-3;

const DASHES = ["dash", "dot"];

/**
 * The rows of a motion; the same curves of runs beside it are dashed in them.
 * @param {Scene} scene @param {Trajectory} trajectory @param {readonly Trajectory[]} [beside]
 * @returns {Row[]}
 */
export function rowsOf(scene, trajectory, beside = []) {
  const others = beside.map((run) => rowsOfOne(scene, run));
  return rowsOfOne(scene, trajectory).map((row) => ({
    ...row,
    curves: [...row.curves, ...others.flatMap((rows, i) => (rows.find(({ key }) => key === row.key)?.curves ?? [])
      .filter(({ dash }) => dash === "solid")
      .map((curve) => ({ ...curve, dash: DASHES[i % 2], band: false, beside: beside[i].t })))],
  }));
}

/**
 * Coordinates of the same unit share a row; the energies have the last one.
 * @param {Scene} scene @param {Trajectory} trajectory
 * @returns {Row[]}
 */
function rowsOfOne(scene, trajectory) {
  /** @type {Map<string, Row>} */
  const rows = new Map();
  scene.coordinates.forEach((coordinate, index) => {
    const values = trajectory.coordinates[coordinate.name];
    if (!values) return;
    const row = rows.get(coordinate.unit) ?? { key: `q${index}`, unit: unitText(coordinate.unit), curves: [] };
    const latex = coordinate.latex || coordinate.name;
    row.curves.push({ key: coordinate.name, latex, className: `q-${index}`, values, dash: "solid", band: true });
    rows.set(coordinate.unit, row);
  });
  return [...rows.values(), ...energyRow(trajectory)];
}

/** @param {Trajectory} trajectory @returns {Row[]} */
function energyRow({ energy }) {
  if (!energy) return [];
  const curve = (/** @type {keyof typeof energy} */ key, /** @type {string} */ latex, /** @type {string} */ className, dash = "solid") => ({
    key, latex, className, values: energy[key], dash, band: false,
  });
  const curves = [
    curve("kinetic", "E", "energy-kinetic"),
    curve("potential", "V", "energy-potential"),
    curve("balance", "E+V-\\textstyle\\int\\! P\\,dt", "energy-balance", "dot"),
  ];
  return [{ key: "energy", unit: "J", curves }];
}

/** Between two rows there is room for the names of the curves: this many times the page's type size. */
const GAP = 1.5;

/**
 * The rows' parts of the height, from the top, with a gap between them.
 * @param {number} count @param {number} height in pixels @param {number} em the page's type size in pixels
 */
export function domainsOf(count, height, em) {
  const inner = height - marginsOf(em).t - marginsOf(em).b;
  const gap = Math.min(0.15, (GAP * em) / Math.max(inner, 1));
  const share = (1 - gap * (count - 1)) / count;
  return Array.from({ length: count }, (_, i) => {
    const top = 1 - i * (share + gap);
    return [Math.max(0, top - share), top];
  });
}

/**
 * Plotly traces of all rows.
 * @param {readonly Row[]} rows @param {Trajectory} trajectory @param {Palette} palette
 */
export function tracesOf(rows, trajectory, palette) {
  return rows.flatMap((row, r) =>
    row.curves.flatMap((curve) => {
      const axis = { xaxis: "x", yaxis: r === 0 ? "y" : `y${r + 1}` };
      const color = palette.of(curve.className);
      const trace = {
        type: "scatter", mode: "lines", x: curve.beside ?? trajectory.t, y: curve.values, name: curve.key, className: curve.className, hoverinfo: "skip",
        line: { color, width: curve.dash === "solid" ? 2 : 1.6, dash: curve.dash, simplify: false }, ...axis,
      };
      return curve.band ? [...bandOf(curve, trajectory, color, axis), trace] : [trace];
    }),
  );
}

/**
 * The band q ± estimate, if it can be seen.
 * @param {Curve} curve @param {Trajectory} trajectory @param {string} color @param {object} axis
 */
function bandOf(curve, trajectory, color, axis) {
  const error = trajectory.error?.estimate ?? [];
  // Below one a tolerance is absolute: a coordinate at rest has no range, and a small error there is none to show.
  const range = Math.max(Math.max(...curve.values) - Math.min(...curve.values), LEAST_RANGE);
  if (!((largestError(trajectory) ?? 0) > VISIBLE * range)) return [];
  const wide = (/** @type {number} */ sign) => curve.values.map((v, i) => v + sign * Math.min(error[i] ?? range, range));
  const x = [...trajectory.t, ...[...trajectory.t].reverse()];
  const y = [...wide(1), ...wide(-1).reverse()];
  const line = { width: 0 };
  return [{ type: "scatter", mode: "lines", x, y, fill: "toself", fillcolor: color, opacity: 0.18, line, className: curve.className, hoverinfo: "skip", ...axis }];
}

/** Margins of the plots in pixels; the style sheet places cursor and names by the same. @param {number} em */
export const marginsOf = (em) => ({ l: 2.9 * em, r: 0.65 * em, t: 1.5 * em, b: 1.5 * em });

/**
 * Plotly layout: one time axis at the bottom, one value axis per row.
 * @param {readonly Row[]} rows @param {number} end @param {Palette} palette @param {string} lang
 * @param {number} height in pixels @param {number} em the page's type size in pixels
 */
export function layoutOf(rows, end, palette, lang, height, em) {
  const font = { family: "system-ui, sans-serif", size: 0.7 * em, color: palette.muted };
  const line = { gridcolor: palette.grid, zeroline: false, ticks: "", fixedrange: true, exponentformat: "power" };
  const axes = domainsOf(rows.length, height, em).map((domain, r) => [
    r === 0 ? "yaxis" : `yaxis${r + 1}`,
    { ...line, domain, nticks: 4, zeroline: true, zerolinecolor: palette.grid, zerolinewidth: 1.5, ...rangeOf(rows[r]) },
  ]);
  return {
    ...Object.fromEntries(axes),
    xaxis: { ...line, range: [0, end || 1], anchor: rows.length > 1 ? `y${rows.length}` : "y", nticks: 8 },
    margin: { ...marginsOf(em), pad: em / 4 },
    showlegend: false,
    hovermode: false,
    dragmode: false,
    font,
    paper_bgcolor: "rgba(0,0,0,0)",
    plot_bgcolor: "rgba(0,0,0,0)",
    separators: lang === "de" ? ",." : ".,",
  };
}

/** A runaway curve leaves the frame when its outermost values lie this many times further out than the rest. */
const RUNAWAY = 4;

/** The range of the values, without the last few of them if they have run away. @param {readonly number[]} sorted */
function usual(sorted) {
  const at = (/** @type {number} */ part) => sorted[Math.round((sorted.length - 1) * part)];
  const span = Math.max(at(0.97) - at(0.03), 1e-9);
  const held = (/** @type {number} */ extreme, /** @type {number} */ usual) => (Math.abs(extreme - usual) > RUNAWAY * span ? usual : extreme);
  return [held(at(0), at(0.03)), held(at(1), at(0.97))];
}

/**
 * A little room on both sides; a constant curve gets a range that shows it as constant.
 * @param {Row} row
 */
function rangeOf(row) {
  const values = row.curves.flatMap((curve) => curve.values).filter(Number.isFinite);
  if (!values.length) return {};
  const [low, high] = usual(values.sort((a, b) => a - b));
  const span = Math.max(high - low, 1e-6 * Math.max(Math.abs(low), Math.abs(high)), 1e-9);
  return { range: [low - 0.08 * span, high + 0.08 * span] };
}

/**
 * Pixels of a time on the plots, and back.
 * @param {number} width @param {number} end @param {number} em
 */
export function timeScale(width, end, em) {
  const { l, r } = marginsOf(em);
  const inner = Math.max(1, width - l - r);
  return {
    pixel: (/** @type {number} */ t) => l + (end > 0 ? t / end : 0) * inner,
    time: (/** @type {number} */ x) => Math.max(0, Math.min(end, ((x - l) / inner) * end)),
  };
}
