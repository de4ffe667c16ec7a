/** The adjustable numbers of a scene: parameters and initial values, as sliders. */

import { brief, decimalsOf, niceFloor, perSecond } from "./numbers.js";

/** @typedef {import("./types.js").Scene} Scene */
/** @typedef {import("./types.js").Changes} Changes */
/** @typedef {{key: string, group: "initial" | "parameter", field: "value" | "rate", name: string, latex: string,
 *   unit: string, className: string, value: number, min: number, max: number, step: number, decimals: number,
 *   least: number, most: number}} Slider  from `min` to `max` it slides; what is typed may go on to `least` and `most` */

/** @type {Changes} */
export const UNCHANGED = { initial: {}, parameters: {} };

/**
 * All sliders of a scene with the values as changed. Guided coordinates have no initial values.
 * @param {Scene} scene @param {Changes} changes
 * @returns {Slider[]}
 */
export function slidersOf(scene, changes) {
  const guided = new Set((scene.guides ?? []).map((guide) => guide.coordinate));
  const initial = scene.coordinates.flatMap((coordinate, index) => {
    if (guided.has(coordinate.name)) return [];
    const now = changes.initial[coordinate.name] ?? coordinate;
    const { name, unit } = coordinate;
    const latex = coordinate.latex || name;
    const shared = { group: /** @type {const} */ ("initial"), name, className: `q-${index}` };
    const [low, high] = coordinateRange(coordinate);
    const fastest = niceFloor(Math.max(high - low, 1)) * 2.5;
    return [
      slider(
        { ...shared, field: "value", latex: `${latex}(0)`, unit },
        now.value,
        [low, high],
        [coordinate.min, coordinate.max],
      ),
      slider({ ...shared, field: "rate", latex: `${dotted(latex)}(0)`, unit: perSecond(unit) }, now.rate, [
        -fastest,
        fastest,
      ]),
    ];
  });
  return [...initial, ...scene.parameters.map((parameter) => parameterSlider(parameter, changes))];
}

/** The rate of a coordinate: the dot stands on the letter, not on its index. @param {string} latex */
export function dotted(latex) {
  const [, letter, rest] = /^(\\?[A-Za-z]+)(_.+)?$/.exec(latex) ?? ["", latex, ""];
  return `\\dot{${letter}}${rest ?? ""}`;
}

/** What a coordinate may be at the start: as the scene says, else one turn or twice its value. @param {import("./types.js").Coordinate} coordinate @returns {[number, number]} */
export function coordinateRange({ unit, value, min, max }) {
  const reach = unit === "rad" ? Math.PI : Math.max(1, 2 * Math.abs(value));
  return [min ?? Math.min(-reach, value), max ?? Math.max(reach, value)];
}

/** @param {import("./types.js").Parameter} parameter @param {Changes} changes */
function parameterSlider(parameter, changes) {
  const { name, unit, value } = parameter;
  const shared = {
    group: /** @type {const} */ ("parameter"),
    field: /** @type {const} */ ("value"),
    name,
    className: "",
  };
  const low = parameter.min ?? Math.min(0, 4 * value);
  const high = parameter.max ?? Math.max(1, 4 * value);
  return slider(
    { ...shared, latex: parameter.latex || name, unit },
    changes.parameters[name] ?? value,
    [low, high],
    [parameter.min ?? low, parameter.max],
  );
}

/**
 * @param {Pick<Slider, "group" | "field" | "name" | "latex" | "unit" | "className">} about
 * @param {number} value @param {[number, number]} range @param {[(number | null)?, (number | null)?]} bounds  that the scene sets
 * @returns {Slider}
 */
function slider(about, value, [min, max], [least, most] = []) {
  const step = niceFloor((max - min) / 100 || 1);
  return {
    ...about,
    key: `${about.group}-${about.name}-${about.field}`,
    value,
    min,
    max,
    step,
    decimals: decimalsOf(step),
    least: least ?? -Infinity,
    most: most ?? Infinity,
  };
}

/** @param {Slider} slider @param {number} value */
export const heldAt = ({ least, most }, value) => Math.max(least, Math.min(most, value));

/** What the scene allows, as one reads it: 0.2 … 2, or ≥ 0.2. @param {Slider} slider @param {string} lang */
export function rangeText({ least, most }, lang) {
  const [low, high] = [least, most].map((bound) => brief(bound, 6, lang));
  return Number.isFinite(least) ? (Number.isFinite(most) ? `${low} … ${high}` : `≥ ${low}`) : `≤ ${high}`;
}

/**
 * The changes after one slider has moved; a number outside of the bounds that the scene sets is held there.
 * @param {Scene} scene @param {Changes} changes @param {Slider} moved @param {number} value
 * @returns {Changes}
 */
export function changed(scene, changes, moved, value) {
  if (!Number.isFinite(value)) return changes;
  const held = heldAt(moved, value);
  if (moved.group === "parameter") {
    return { ...changes, parameters: { ...changes.parameters, [moved.name]: held } };
  }
  const coordinate = scene.coordinates.find((candidate) => candidate.name === moved.name);
  const before = changes.initial[moved.name] ?? { value: coordinate?.value ?? 0, rate: coordinate?.rate ?? 0 };
  return { ...changes, initial: { ...changes.initial, [moved.name]: { ...before, [moved.field]: held } } };
}

/** Changes as the address has them: "l:0.5" for a parameter, "phi:0.6:0" for value and rate of a coordinate. @param {Changes} changes @param {number} [digits] */
export function writeChanges({ initial, parameters }, digits = 6) {
  const numbers = (/** @type {number[]} */ ...values) =>
    values.map((value) => Number(value.toPrecision(digits))).join(":");
  return [
    ...Object.entries(parameters).map(([name, value]) => `${name}:${numbers(value)}`),
    ...Object.entries(initial).map(([name, { value, rate }]) => `${name}:${numbers(value, rate)}`),
  ].join();
}

/** @param {string} text @returns {Changes} */
export function readChanges(text) {
  const parts = text
    .split(",")
    .map((part) => part.split(":"))
    .filter(
      ([name, ...values]) => name && values.length && values.every((value) => value && Number.isFinite(Number(value))),
    );
  const of = (/** @type {number} */ length) => parts.filter((part) => part.length === length + 1);
  return {
    parameters: Object.fromEntries(of(1).map(([name, value]) => [name, Number(value)])),
    initial: Object.fromEntries(
      of(2).map(([name, value, rate]) => [name, { value: Number(value), rate: Number(rate) }]),
    ),
  };
}

/** @param {Changes} changes */
export function isChanged(changes) {
  return Object.keys(changes.initial).length + Object.keys(changes.parameters).length > 0;
}
