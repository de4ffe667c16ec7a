/** What joins the bodies of a system: rod, string, spring, damper. */

import { add, coil, lengthOf, line, normal, polyline, scaled, subtract, unit } from "./geometry.js";
import { latexOf, letterClass, marked, placeOf, sizeOf } from "./stage.js";

/** @typedef {import("../types.js").Element} Element */
/** @typedef {import("../types.js").Figure} Figure */
/** @typedef {import("../types.js").Pixel} Pixel */
/** @typedef {import("./stage.js").Stage} Stage */
/** @typedef {import("../types.js").Snapshot} Snapshot */

/** @param {Element} element @param {Stage} stage @param {Snapshot} now @param {string} key @returns {Figure} */
export function rod(element, stage, now, key) {
  const [from, to] = [placeOf(stage, now, element.from ?? ""), placeOf(stage, now, element.to ?? "")];
  return {
    shapes: [{ key, d: line(from, to), className: marked("ink rod", element), strips: [[from, to]] }],
    labels: named(element.label, stage, [from, to], key, 1.1 * stage.unit, outside(stage, key, from, to)),
  };
}

/** Chords of a slack string, halvings that find how deep it hangs, and how much shorter than itself it is seen to be slack. */
const CHORDS = 24;
const HALVINGS = 24;
const TAUT = 1e-3;

/**
 * A string, as long as its label says: straight where it is taut, else a parabola of its length that hangs down.
 * @param {Element} element @param {Stage} stage @param {Snapshot} now @param {string} key @returns {Figure}
 */
export function string(element, stage, now, key) {
  const [from, to] = [placeOf(stage, now, element.from ?? ""), placeOf(stage, now, element.to ?? "")];
  const length = sizeOf(element.label, stage) * stage.scale;
  const isSlack = length * (1 - TAUT) > lengthOf(subtract(to, from));
  const points = isSlack ? hanging(from, to, length, stage.down) : [from, to];
  return {
    shapes: [{ key, d: polyline(points), className: marked("ink rod", element), strips: chordsOf(points) }],
    labels: named(element.label, stage, [from, to], key, 1.1 * stage.unit, outside(stage, key, from, to)),
  };
}

/** @param {Pixel} from @param {Pixel} to @param {number} length @param {Pixel} down @returns {Pixel[]} */
function hanging(from, to, length, down) {
  const curve = (/** @type {number} */ depth) =>
    Array.from({ length: CHORDS + 1 }, (_, i) => {
      const part = i / CHORDS;
      return add(add(from, scaled(subtract(to, from), part)), scaled(down, 4 * depth * part * (1 - part)));
    });
  let [shallow, deep] = [0, length];
  for (let n = 0; n < HALVINGS; n += 1) {
    const middle = (shallow + deep) / 2;
    const reach = chordsOf(curve(middle)).reduce((sum, [a, b]) => sum + lengthOf(subtract(b, a)), 0);
    [shallow, deep] = reach < length ? [middle, deep] : [shallow, middle];
  }
  return curve(deep);
}

/** @param {Pixel[]} points @returns {[Pixel, Pixel][]} */
const chordsOf = (points) => points.slice(1).map((point, i) => [points[i], point]);

/** The unit of a stiffness. */
const STIFFNESS = "N/m";
/** Where along an element its letter stands: not in the middle, where that of its angle is. */
const ALONG = 0.7;

/** The letter of a rod goes to its other side when it has swung so far, as part of its length. */
const SWINGS = 0.2;

/**
 * The side away from the vertical, where no angle is written, and how often it has changed.
 * @param {Stage} stage @param {string} key @param {Pixel} from @param {Pixel} to
 */
function outside(stage, key, from, to) {
  const [across] = unit(subtract(to, from));
  const kept = stage.once(`side ${key}`, () => ({ side: Math.sign(across) || 1, moves: 0 }));
  if (across * kept.side < -SWINGS) Object.assign(kept, { side: -kept.side, moves: kept.moves + 1 });
  return kept;
}

/**
 * The letter of a length or a stiffness beside its element.
 * @param {string | undefined} name  of a parameter or coordinate @param {Stage} stage @param {[Pixel, Pixel]} ends
 * @param {string} key @param {number} gap @param {{side: number, moves: number}} [beside]  side 1: to the right of what hangs down @returns {Figure["labels"]}
 */
function named(name, stage, [from, to], key, gap, { side, moves } = { side: 1, moves: 0 }) {
  if (!name) return [];
  const along = subtract(to, from);
  if (!(lengthOf(along) > 4 * gap)) return [];
  const on = (/** @type {number} */ part, /** @type {number} */ aside) =>
    add(add(from, scaled(along, part)), scaled(normal(unit(along)), -gap * aside));
  const others = [on(0.5, side), on(0.35, side), on(ALONG, -side), on(0.5, -side), on(0.85, side), on(0.35, -side)];
  const className = `length ${letterClass(stage.scene, name)}`;
  return [{ key, latex: latexOf(stage.scene, name), at: on(ALONG, side), others, moves, className }];
}

/**
 * The number of coils belongs to the spring, so it comes from the first sample and not from the moment.
 * @param {Element} element @param {Stage} stage @param {Snapshot} now @param {string} key
 * @returns {Figure}
 */
export function spring(element, stage, now, key) {
  const [from, to] = [element.from ?? "", element.to ?? ""];
  const first = [from, to].map((place) => stage.project(stage.trajectory.positions[place]?.[0] ?? [0, 0]));
  const coils = Math.max(4, Math.min(12, Math.round(lengthOf(subtract(first[1], first[0])) / (stage.unit * 0.85))));
  const ends = beside(element, stage, now);
  const load = element.load ? `load-${element.load}` : "";
  return {
    shapes: [
      {
        key,
        d: coil(...ends, stage.unit * 0.72, coils),
        className: marked(`ink spring ${load}`, element),
        strips: sidesOf(ends, stage.unit * 0.72),
      },
    ],
    labels: named(stiffnessOf(element, stage), stage, ends, key, 1.7 * stage.unit).map((label) => ({
      ...label,
      className: `${label.className} ${load}`,
    })),
  };
}

/** What something is drawn along, and its two sides. @param {[Pixel, Pixel]} ends @param {number} wide @returns {import("../types.js").Strip[]} */
function sidesOf([from, to], wide) {
  const across = scaled(normal(unit(subtract(to, from))), wide);
  return [-1, 0, 1].map((side) => [add(from, scaled(across, side)), add(to, scaled(across, side))]);
}

/** The name of a spring's constant, where it is one; in a potential the one that is a stiffness by its unit. @param {Element} element @param {Stage} stage */
function stiffnessOf({ load }, { scene }) {
  const { stiffness = "", energy = "" } = scene.loads.find(({ name }) => name === load) ?? {};
  const names = new Set(String(energy).match(/[A-Za-z_]\w*/g) ?? []);
  const found = scene.parameters.filter(
    ({ name, unit }) => name === stiffness || (names.has(name) && unit === STIFFNESS),
  );
  return found.length === 1 ? found[0].name : undefined;
}

/**
 * Both ends of an element, moved aside where another lies on the same line.
 * @param {Element} element @param {Stage} stage @param {Snapshot} now
 * @returns {[Pixel, Pixel]}
 */
function beside({ from = "", to = "", offset }, stage, now) {
  const [a, b] = [placeOf(stage, now, from), placeOf(stage, now, to)];
  const aside = scaled(normal(unit(subtract(b, a))), sizeOf(offset, stage) * stage.scale);
  return [add(a, aside), add(b, aside)];
}

/**
 * A dashpot: a cup at the first end, a piston that slides in it at the second.
 * @param {Element} element @param {Stage} stage @param {Snapshot} now @param {string} key
 * @returns {Figure}
 */
export function damper(element, stage, now, key) {
  const [from, to] = beside(element, stage, now);
  const first = ["from", "to"].map((end) =>
    stage.project(stage.trajectory.positions[element[/** @type {"from" | "to"} */ (end)] ?? ""]?.[0] ?? [0, 0]),
  );
  const depth = lengthOf(subtract(first[1], first[0])) * 0.34;
  const along = unit(subtract(to, from));
  const wide = scaled(normal(along), stage.unit * 0.7);
  const [bottom, rim] = [scaled(along, depth * 0.7), scaled(along, depth * 1.7)].map((reach) => add(from, reach));
  const piston = subtract(to, scaled(along, depth * 1.4));
  const narrow = scaled(wide, 0.8);
  const className = marked(`ink ${element.load ? `load-${element.load}` : ""}`, element);
  return {
    shapes: [
      {
        key: `${key}-cup`,
        d:
          line(from, bottom) +
          polyline([add(rim, wide), add(bottom, wide), subtract(bottom, wide), subtract(rim, wide)]),
        className,
      },
      {
        key,
        d: line(to, piston) + line(add(piston, narrow), subtract(piston, narrow)),
        className: `${className} thick`,
        strips: sidesOf([from, to], stage.unit * 0.7),
      },
    ],
    labels: [],
  };
}
