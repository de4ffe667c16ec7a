/**
 * A coordinate as the drawing shows it where the scene says nothing: what a place passes through while the coordinate
 * grows from zero to its value and all others stay. That is a straight line with an arrow, or an arc about its centre.
 */

import { evaluator } from "../kinematics/expression.js";
import { add, arrowHead, lengthOf, line, normal, scaled, subtract, unit, wrapped } from "./geometry.js";
import { angle, tipBox } from "./marks.js";
import { arc } from "./space.js";
import { coordinateClass, latexOf, marked } from "./stage.js";

/** @typedef {import("../types.js").Element} Element */
/** @typedef {import("../types.js").Figure} Figure */
/** @typedef {import("../types.js").Pixel} Pixel */
/** @typedef {import("../types.js").Scene} Scene */
/** @typedef {import("../types.js").Snapshot} Snapshot */
/** @typedef {import("./stage.js").Stage} Stage */
/** @typedef {import("../kinematics/expression.js").Values} Values */
/** @typedef {{names: Set<string>, at: (values: Values) => number[]}} Field  where a place is, and the names that it depends on */

/** @type {Figure} */
const NOTHING = { shapes: [], labels: [] };
/** Radius of an arc in units of the drawing, as part of its place's distance from the centre at most, and in units at least. */
const RADIUS = 4.2;
const NEAR = 0.62;
const LEAST = 2.2;
/** How far a line stands aside, in units. */
const ASIDE = 1.6;
/** Below this many units there is nothing to see. */
const SHORTEST = 0.35;
const LINED = 0.8;

/** Elements that show a coordinate with its letter; others only move by it. */
const LETTERED = /^(dimension|angle|polar|azimuth|top|coordinate)$/;

/** The places of a scene whose position the page can read. @param {Scene} scene @returns {Map<string, Field>} */
export function fieldsOf({ bodies, points }) {
  const found = [...bodies, ...points].flatMap(({ name, position, ...rest }) => {
    try {
      const parts = (position ?? []).map(evaluator);
      const names = new Set((position ?? []).flatMap((text) => text.match(/[A-Za-z_]\w*/g) ?? []));
      const material = "material" in rest && Array.isArray(rest.material) && rest.material.length;
      return parts.length && !material
        ? [/** @type {const} */ ([name, { names, at: (/** @type {Values} */ q) => parts.map((part) => part(q)) }])]
        : [];
    } catch {
      return [];
    }
  });
  return new Map(found);
}

/** The place that shows a coordinate best: the one that the fewest others move. @param {Scene} scene @param {Map<string, Field>} fields @param {string} coordinate */
function shownBy({ coordinates }, fields, coordinate) {
  const others = (/** @type {Field} */ { names }) => coordinates.filter(({ name }) => names.has(name)).length;
  return [...fields.values()].filter(({ names }) => names.has(coordinate)).sort((a, b) => others(a) - others(b))[0];
}

/** @param {number[]} a @param {number[]} b @param {number} s */
const along = (a, b, s) => a.map((x, i) => x + s * b[i]);
/** @param {number[]} a @param {number[]} b */
const minus = (a, b) => along(a, b, -1);
/** @param {number[]} a @param {number[]} b */
const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);

/**
 * The centre of the circle through three places, or null if they lie on a line: c − a = s u + t v with u = b − a, v = c − a
 * is equally far from all of them.
 * @param {number[]} a @param {number[]} b @param {number[]} c @returns {number[] | null}
 */
export function centreOf(a, b, c) {
  const [u, v] = [minus(b, a), minus(c, a)];
  const [uu, vv, uv] = [dot(u, u), dot(v, v), dot(u, v)];
  const size = 2 * (uu * vv - uv * uv);
  if (!(size > 1e-9 * uu * vv)) return null;
  return along(along(a, u, (vv * (uu - uv)) / size), v, (uu * (vv - uv)) / size);
}

/** @param {Element} element @param {Stage} stage @param {Snapshot} now @param {string} key @returns {Figure} */
export function coordinate(element, stage, now, key) {
  const name = element.coordinate ?? "";
  const field = stage.once(`field of ${name}`, () =>
    shownBy(
      stage.scene,
      stage.once("fields", () => fieldsOf(stage.scene)),
      name,
    ),
  );
  if (!field) return spun(element, stage, now, key);
  const given = stage.once("given", () =>
    Object.fromEntries(stage.scene.parameters.map(({ name, value }) => [name, value])),
  );
  const values = { ...given, ...now.coordinates, t: now.t };
  const at = (/** @type {number} */ q) => field.at({ ...values, [name]: q });
  const value = now.coordinates[name] ?? 0;
  const ends = [at(0), at(value)];
  if (!ends.flat().every(Number.isFinite)) return NOTHING;
  const centre =
    stage.scene.coordinates.find((one) => one.name === name)?.unit === "rad" ? centreOf(at(0), at(1), at(2)) : null;
  return centre
    ? turned(element, stage, { key, centre, at, turn: wrapped(value) })
    : shifted(element, stage, { key, from: stage.project(ends[0]), to: stage.project(ends[1]) });
}

/**
 * A turn in the plane that moves no place: round the body that has it in its angle or angular velocity; round a disc from
 * above and clockwise, as the mark on it turns.
 * @param {Element} element @param {Stage} stage @param {Snapshot} now @param {string} key @returns {Figure}
 */
function spun(element, stage, now, key) {
  const name = element.coordinate ?? "";
  const { bodies, coordinates, dimension, drawing } = stage.scene;
  if (dimension === 3) return NOTHING;
  const turns = (/** @type {import("../types.js").Body} */ { angle, angular_velocity }) =>
    [angle, ...(angular_velocity ?? [])].some(
      (text) => typeof text === "string" && new RegExp(`\\b${name}\\b`).test(text),
    );
  const body = bodies.find(turns);
  if (!body || coordinates.find((one) => one.name === name)?.unit !== "rad") return NOTHING;
  const marking = drawing?.elements?.some(({ kind, coordinate: by }) => kind === "disc" && by === name);
  const from = marking ? { offset: Math.PI, direction: /** @type {const} */ ("clockwise") } : {};
  return angle({ ...element, at: body.name, ...from }, stage, now, key);
}

/** @param {Element} element @param {Stage} stage @param {{key: string, centre: number[], at: (q: number) => number[], turn: number}} about @returns {Figure} */
function turned(element, stage, { key, centre, at, turn }) {
  const hub = stage.project(centre);
  const far = Math.hypot(...minus(at(0), centre)) * stage.scale;
  // A body may be so small on the screen that its angle is seen only round it.
  const part = far > 1 ? Math.max(Math.min((RADIUS * stage.unit) / far, NEAR), (LEAST * stage.unit) / far) : 0;
  const on = (/** @type {number} */ q) => along(centre, minus(at(q), centre), part);
  const sides = [stage.project(on(0)), stage.project(on(turn))].map((end, i) => ({
    key: `${key}-${i ? "side" : "axis"}`,
    d: line(hub, add(hub, scaled(subtract(end, hub), 1.08))),
    className: "reference",
  }));
  return arc(element, stage, { key, centre, on, turn: far * part > stage.unit ? turn : 0, below: sides });
}

/** @param {Element} element @param {Stage} stage @param {{key: string, from: Pixel, to: Pixel}} about @returns {Figure} */
function shifted(element, stage, { key, from, to }) {
  const span = subtract(to, from);
  const className = marked(coordinateClass(stage.scene, element.coordinate), element);
  const across = scaled(normal(unit(span, [1, 0])), (normal(unit(span, [1, 0]))[1] > 0 ? -1 : 1) * ASIDE * stage.unit);
  const [a, b] = [add(from, across), add(to, across)];
  const tick = scaled(across, 0.35);
  const reference = { key: `${key}-from`, d: line(from, add(a, tick)), className: "reference" };
  const end = { key: `${key}-to`, d: line(to, add(b, tick)), className: "extension" };
  const long = lengthOf(span);
  if (!(long > SHORTEST * stage.unit)) return { shapes: [reference], labels: [] };
  const size = Math.min(stage.unit * 0.8, long * 0.6);
  const head = arrowHead(b, unit(span), LINED * size);
  const on = (/** @type {number} */ part, /** @type {number} */ out) =>
    add(add(a, scaled(span, part)), scaled(unit(across), out * stage.unit));
  return {
    shapes: [
      reference,
      end,
      {
        key: `${key}-line`,
        d: line(a, add(b, scaled(unit(span), -0.7 * size))) + head,
        className: `pointed mark ${className}`,
        boxes: [tipBox(b, unit(span), LINED * size)],
        strips: [[a, b]],
      },
    ],
    labels: [
      {
        key,
        latex: latexOf(stage.scene, element.coordinate),
        at: on(0.5, 1.1),
        others: [on(0.5, -1.1), on(0.25, 1.1), on(0.75, 1.1), add(b, scaled(unit(span), 1.2 * stage.unit))],
        className,
      },
    ],
  };
}

/** The coordinates that no element of a drawing shows, as elements. @param {Scene} scene @param {readonly Element[]} elements @returns {Element[]} */
export function unshown({ coordinates }, elements) {
  const shown = new Set(elements.filter(({ kind }) => LETTERED.test(kind)).map(({ coordinate }) => coordinate));
  return coordinates
    .filter(({ name }) => !shown.has(name))
    .map(({ name }) => ({ kind: "coordinate", coordinate: name }));
}
