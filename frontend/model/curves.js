/** Curves of a motion, in rows: those of one row share an axis. */

import { knotsBetween } from "./curve.js";
import { contactRow, frictionRows, reactionRows } from "./forces.js";
import { smooth } from "./interpolation.js";
import { readLook, spanOf, wrap } from "./look.js";
import { unitText } from "./numbers.js";
import { coordinateAt, decimalsKnown, endOf, leastRange } from "./trajectory.js";

/** @typedef {import("./types.js").Trajectory} Trajectory */
/** @typedef {import("./types.js").Scene} Scene */
/** @typedef {import("./look.js").Look} Look */
/**
 * @typedef {{key: string, name: string, latex: string, className: string, values: readonly number[], times: readonly number[],
 *   at: (t: number) => number, decimals: (t: number) => number, dash: string, band: boolean, beside: boolean, wrapped: boolean, hidden: boolean, pulls?: boolean}} Curve  values at the
 *   samples, and between them; decimals: that are known of its value; wrapped: its values are within (−π, π], what lies between them is not yet; beside: of another run; pulls: a force of a rod or string, which would go slack where it changes its sign
 * @typedef {{key: string, unit: string, least: number, curves: Curve[]}} Row  least: a range below which there is nothing to be seen
 */

const DASHES = ["dash", "dot"];

/**
 * The rows of a motion; the same curves of runs beside it are dashed in them.
 * @param {Scene} scene @param {Trajectory} trajectory @param {readonly Trajectory[]} [beside] @param {Look} [look]
 * @returns {Row[]}
 */
export function rowsOf(scene, trajectory, beside = [], look = readLook("")) {
  const others = beside.map((run) => rowsOfOne(scene, run, look));
  return rowsOfOne(scene, trajectory, look).map((row) => ({
    ...row,
    curves: [
      ...row.curves,
      ...others.flatMap((rows, i) =>
        rows
          .flatMap(({ curves }) => curves)
          .filter(({ key, dash }) => dash === "solid" && row.curves.some((curve) => curve.key === key))
          .map((curve) => ({ ...curve, dash: DASHES[i % 2], band: false, beside: true })),
      ),
    ],
  }));
}

/** On an axis so many times as long as its range a curve looks like a line. */
const FLAT = 12;

/** @param {readonly (readonly number[])[]} curves */
function widthOf(curves) {
  const all = curves.flat().filter(Number.isFinite);
  return Math.max(...all) - Math.min(...all);
}

/** Whether a curve and those of a row are all to be seen on one axis; what hardly moves is not, on whichever. @param {Row} row @param {readonly number[]} values @param {Look["axes"]} axes */
function fits({ curves, least }, values, axes) {
  if (axes) return axes === "one";
  const all = [...curves.map((curve) => curve.values), values];
  const moving = all.map((one) => widthOf([one])).filter((range) => range > least);
  return widthOf(all) <= FLAT * Math.min(...moving);
}

/**
 * Coordinates of the same unit share a row as long as each is to be seen in it; reactions have one, each friction has,
 * contacts have one, the energies have the last.
 * @param {Scene} scene @param {Trajectory} trajectory @param {Look} look
 * @returns {Row[]}
 */
function rowsOfOne(scene, trajectory, look) {
  /** @type {(Row & {of: string})[]} */
  const rows = [];
  scene.coordinates.forEach((coordinate, index) => {
    const computed = trajectory.coordinates[coordinate.name];
    if (!computed) return;
    const wrapped = look.wrapped && coordinate.unit === "rad" && computed.some((angle) => wrap(angle) !== angle);
    const values = wrapped ? computed.map(wrap) : computed;
    const shared = rows.find((row) => row.of === coordinate.unit && fits(row, values, look.axes));
    const row = shared ?? {
      key: `q${index}`,
      of: coordinate.unit,
      unit: unitText(coordinate.unit),
      least: leastRange(trajectory),
      curves: [],
    };
    const latex = coordinate.latex || coordinate.name;
    const at = (/** @type {number} */ t) => coordinateAt(trajectory, coordinate.name, t);
    row.curves.push({
      key: coordinate.name,
      name: coordinate.name,
      latex,
      className: `q-${index}`,
      values,
      times: trajectory.t,
      at,
      decimals: decimalsKnown(trajectory.t, computed, trajectory.error?.estimate ?? []),
      dash: "solid",
      band: !wrapped,
      beside: false,
      wrapped,
      hidden: look.hidden.includes(coordinate.name),
    });
    if (!shared) rows.push(row);
  });
  const span = look.span && spanOf(look, endOf(trajectory));
  const others = [
    ...reactionRows(scene, trajectory, look),
    ...frictionRows(scene, trajectory, look),
    ...contactRow(scene, trajectory, look),
    ...energyRow(trajectory, look),
  ];
  return [...rows.map(({ of: _, ...row }) => row), ...others].map((row) =>
    span ? { ...row, curves: row.curves.map((curve) => within(curve, ...span)) } : row,
  );
}

/** A part of a curve. @param {Curve} curve @param {number} from @param {number} to @returns {Curve} */
function within(curve, from, to) {
  const times = knotsBetween(curve.times, from, to);
  const { at, wrapped } = curve;
  return { ...curve, times, values: times.map((t) => (wrapped ? wrap(at(t)) : at(t))) };
}

/** @param {Trajectory} trajectory @param {Look} look @returns {Row[]} */
function energyRow({ t: times, energy }, { hidden }) {
  if (!energy) return [];
  const curve = (
    /** @type {"kinetic" | "potential" | "balance"} */ key,
    /** @type {string} */ latex,
    /** @type {string} */ className,
    name = latex,
    dash = "solid",
  ) => ({
    key,
    name,
    latex,
    className,
    values: energy[key],
    times,
    at: smooth(times, energy[key]),
    decimals: decimalsKnown(times, energy[key], []),
    dash,
    band: false,
    beside: false,
    wrapped: false,
    hidden: hidden.includes(key),
  });
  const balance = energy.works
    ? curve("balance", "E+V-\\textstyle\\int\\! P\\,dt", "energy-balance", "E + V − ∫P dt", "dot")
    : curve("balance", "E+V", "energy-balance", "E + V", "dot");
  const curves = [curve("kinetic", "E", "energy-kinetic"), curve("potential", "V", "energy-potential"), balance];
  return [{ key: "energy", unit: "J", least: 0, curves }];
}

/** The value of a curve at a moment, as it is drawn. @param {Curve} curve @param {number} t */
export const readingOf = ({ at, wrapped }, t) => (wrapped ? wrap(at(t)) : at(t));
