/** Curves of forces: reactions of constraints and of what is released, dry friction, contacts. */

import { smooth } from "./interpolation.js";
import { decimalsKnown } from "./trajectory.js";

/** @typedef {import("./types.js").Trajectory} Trajectory */
/** @typedef {import("./types.js").Scene} Scene */
/** @typedef {import("./look.js").Look} Look */
/** @typedef {import("./curves.js").Curve} Curve */
/** @typedef {import("./curves.js").Row} Row */

/**
 * Reactions along the motion: multipliers of constraints, and what holds what was released; those of a unit share a row.
 * @param {Scene} scene @param {Trajectory} trajectory @param {Look} look @returns {Row[]}
 */
export function reactionRows(scene, trajectory, { hidden }) {
  const { t: times, multipliers, reactions } = trajectory;
  if (!multipliers) return [];
  /** @type {Map<string, Row>} */
  const rows = new Map();
  Object.entries(multipliers).forEach(([name, values], k) => {
    const { unit = "", of_rod: pulls = false } = reactions?.[name] ?? {};
    const row = rows.get(unit) ?? { key: `reactions${rows.size || ""}`, unit, least: 0, curves: [] };
    rows.set(unit, row);
    row.curves.push({
      key: `reaction-${name}`,
      name,
      latex: symbolOfForce(scene, trajectory, name),
      className: `q-${scene.coordinates.length + k}`,
      values,
      times,
      at: smooth(times, values),
      decimals: decimalsKnown(times, values, []),
      dash: "solid",
      band: false,
      beside: false,
      wrapped: false,
      hidden: hidden.includes(`reaction-${name}`),
      pulls,
    });
  });
  return [...rows.values()];
}

/**
 * The force R of each friction between ±F⁰, which it reaches where what sticks begins to slip.
 * @param {Scene} scene @param {Trajectory} trajectory @param {Look} look @returns {Row[]}
 */
export function frictionRows(scene, trajectory, { hidden }) {
  const { t: times, friction } = trajectory;
  const { coordinates, loads } = scene;
  const first = coordinates.length + countOfReactions(scene, trajectory);
  /** The coordinate that a friction acts on, or one of those that it is a sum of. @param {string} name */
  const slipping = (name) => {
    const text = loads.find((load) => load.name === name)?.coordinate ?? "";
    const parts = coordinates.filter((one) => text.split(/[\s()+-]+/).includes(one.name));
    return parts.every((one) => one.unit === parts[0]?.unit) ? parts[0] : undefined;
  };
  const several = Object.keys(friction ?? {}).length > 1;
  return Object.entries(friction ?? {}).map(([name, { force, largest }], k) => {
    const along = slipping(name);
    const curve = (/** @type {string} */ key, /** @type {string} */ latex, /** @type {number[]} */ values) => ({
      key: `${key}-${name}`,
      name: several ? `${latex} (${name})` : latex,
      latex,
      className: `q-${first + k}`,
      values,
      times,
      at: smooth(times, values),
      decimals: decimalsKnown(times, values, []),
      dash: key === "friction" ? "solid" : "dash",
      band: false,
      beside: false,
      wrapped: false,
      hidden: hidden.includes(`${key}-${name}`),
    });
    const symbol = symbolOfForce(scene, trajectory, name);
    const most = symbol.replace("R", "F^0");
    const curves = [
      curve("friction", symbol, force),
      curve("most", most, largest),
      curve(
        "least",
        `-${most}`,
        largest.map((value) => -value),
      ),
    ];
    return { key: `friction${k}`, unit: CONJUGATE[along?.unit ?? ""] ?? "", least: 0, curves };
  });
}

/**
 * The forces N of contacts that rest, or of strings that are taut, as far as there is one at any time.
 * @param {Scene} scene @param {Trajectory} trajectory @param {Look} look @returns {Row[]}
 */
export function contactRow(scene, trajectory, { hidden }) {
  const { t: times, contacts } = trajectory;
  const { coordinates, loads } = scene;
  const first = coordinates.length + countOfReactions(scene, trajectory) + (loads ?? []).length;
  const acting = Object.entries(contacts ?? {}).filter(([, { force }]) => force.some((value) => value !== 0));
  const curves = acting.map(([name, { force }], k) => {
    const latex = symbolOfContact(trajectory, name);
    return {
      key: `contact-${name}`,
      name: acting.length > 1 ? `${latex} (${name})` : latex,
      latex,
      className: `q-${first + k}`,
      values: force,
      times,
      at: smooth(times, force),
      decimals: decimalsKnown(times, force, []),
      dash: "solid",
      band: false,
      beside: false,
      wrapped: false,
      hidden: hidden.includes(`contact-${name}`),
    };
  });
  const [unit = "", ...others] = new Set(acting.map(([, one]) => one.unit));
  return curves.length ? [{ key: "contacts", unit: others.length ? "" : unit, least: 0, curves }] : [];
}

/** How many colours those of constraints and of what is released take. @param {Scene} scene @param {Trajectory} trajectory */
const countOfReactions = ({ constraints }, { multipliers }) =>
  Math.max((constraints ?? []).length, Object.keys(multipliers ?? {}).length);

/** N, with a number where there are several contacts. @param {Trajectory} trajectory @param {string} name */
function symbolOfContact({ contacts }, name) {
  const names = Object.keys(contacts ?? {});
  return names.length > 1 ? `N_{${names.indexOf(name) + 1}}` : "N";
}

/**
 * What a friction, a contact, a multiplier or a reaction is called in the plots.
 * @param {Scene} scene @param {Trajectory} trajectory @param {string} name
 */
export function symbolOfForce({ coordinates, parameters }, trajectory, name) {
  const frictions = Object.keys(trajectory.friction ?? {});
  if (frictions.includes(name)) return frictions.length > 1 ? `R_{${frictions.indexOf(name) + 1}}` : "R";
  if (name in (trajectory.contacts ?? {})) return symbolOfContact(trajectory, name);
  const released = [...coordinates, ...parameters].find((one) => one.name === name);
  return released ? `Z_{${released.latex || name}}` : symbolOf(name);
}

/** What works through a displacement of this unit. @type {Record<string, string>} */
const CONJUGATE = { m: "N", rad: "N m" };

/**
 * When the force of a rod or string changes its sign: there a string would go slack, and a rod begins to push or to pull.
 * @param {Curve} curve
 */
export function slackTimes({ pulls, times, values, at }) {
  if (!pulls) return [];
  return times.slice(1).flatMap((end, i) => {
    let [low, high] = [times[i], end];
    if (!(values[i] * values[i + 1] < 0 && high > low)) return [];
    for (let n = 0; n < HALVINGS; n += 1) {
      const middle = (low + high) / 2;
      if (at(middle) * values[i] > 0) low = middle;
      else high = middle;
    }
    return [low];
  });
}

const HALVINGS = 40;

/** How the name of a multiplier is written: a Greek letter as such, a number behind it below. @param {string} name */
function symbolOf(name) {
  const [, letters, index] = /^([A-Za-z]+)_?(\w*)$/.exec(name) ?? ["", name, ""];
  const letter = letters.length > 1 ? `\\${GREEK.has(letters) ? letters : `mathit{${letters}}`}` : letters;
  return index ? `${letter}_{${index}}` : letter;
}

/** Greek letters that multipliers are called by. */
const GREEK = new Set(["lambda", "mu", "nu", "kappa", "sigma", "tau", "rho", "xi", "eta", "zeta"]);
