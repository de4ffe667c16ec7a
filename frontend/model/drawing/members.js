/** What a system is made of: rod, string, spring, bob, cart, block, disc, hoop. */

import { add, circle, coil, lengthOf, line, normal, polygon, polyline, scaled, subtract, unit } from "./geometry.js";
import { boxAbout } from "./placing.js";
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

/** @param {Element} element @param {Stage} stage @param {Snapshot} now @param {string} key @returns {Figure} */
export function bob(element, stage, now, key) {
  const place = placeOf(stage, now, element.at ?? "");
  const className = marked(`ink steel bob body-${element.at}`, element);
  const radius = stage.unit * 0.85;
  return {
    shapes: [{ key, d: circle(radius), className, at: place, boxes: [boxAbout(place, radius)] }],
    labels: massOf(element.at, stage, place, radius),
  };
}

/** Directions in which the letter of a mass can stand from its body, in eighths of a turn from the right; the usual first. */
const SIDES_OF_BODY = [0, 4, 7, 5, 1, 3, 6, 2];

/**
 * The letter of a body's mass beside it, where its mass is a parameter.
 * @param {string | undefined} name of the body @param {Stage} stage @param {Pixel} place @param {number} across @param {number} [along] half its size @returns {Figure["labels"]}
 */
export function massOf(name, stage, place, across, along = across) {
  const body = stage.scene.bodies.find((candidate) => candidate.name === name);
  const mass = stage.scene.parameters.find((parameter) => parameter.name === body?.mass);
  if (!mass) return [];
  const [first, ...others] = SIDES_OF_BODY.map((eighth) => {
    const turn = (eighth * Math.PI) / 4;
    const round = across === along ? Math.SQRT1_2 : 1; // a ball has no corners
    const part = eighth % 2 ? round : 1;
    const [x, y] = [Math.sign(Math.round(Math.cos(turn))), Math.sign(Math.round(Math.sin(turn)))];
    return add(place, [x * part * (across + 1.1 * stage.unit), y * part * (along + 1.1 * stage.unit)]);
  });
  const latex = latexOf(stage.scene, mass.name);
  return [
    {
      key: `mass-${name}`,
      latex,
      at: first,
      others,
      className: `mass ${letterClass(stage.scene, mass.name)} body-${name}`,
    },
  ];
}

/** @param {Element} element @param {Stage} stage @param {Snapshot} now @param {string} key @returns {Figure} */
export function disc(element, stage, now, key) {
  const radius = sizeOf(element.radius, stage) * stage.scale || stage.unit * 2;
  const place = placeOf(stage, now, element.at ?? "");
  const angle = now.coordinates[element.coordinate ?? ""];
  const mark = angle === undefined ? "" : line([0, 0], [radius * Math.sin(angle), -radius * Math.cos(angle)]);
  const shapes = [
    {
      key,
      d: circle(radius),
      className: marked(`ink steel body-${element.at}`, element),
      at: place,
      boxes: [boxAbout(place, radius)],
    },
    { key: `${key}-mark`, d: mark, className: "ink", at: place },
    { key: `${key}-axle`, d: circle(stage.unit * 0.25), className: "ink paper", at: place },
  ];
  return { shapes, labels: massOf(element.at, stage, place, radius) };
}

/** Sides of the polygon that a hoop is drawn as. */
const SIDES = 72;

/**
 * A ring about a place; in space it stands upright, turned about the vertical by its coordinate.
 * @param {Element} element @param {Stage} stage @param {Snapshot} now @param {string} key
 * @returns {Figure}
 */
export function hoop(element, stage, now, key) {
  const radius = sizeOf(element.radius, stage);
  const turn = now.coordinates[element.coordinate ?? ""] ?? 0;
  const centre = now.positions[element.at ?? ""] ?? [0, 0, 0].slice(0, stage.scene.dimension);
  const ring = Array.from({ length: SIDES + 1 }, (_, i) => {
    const [across, along] = [
      radius * Math.sin((i * 2 * Math.PI) / SIDES),
      radius * Math.cos((i * 2 * Math.PI) / SIDES),
    ];
    const offset = centre.length < 3 ? [across, along] : [across * Math.cos(turn), across * Math.sin(turn), along];
    return stage.project(centre.map((x, c) => x + offset[c]));
  });
  const upright = [-1.2, 1.2].map((reach) => stage.project(centre.map((x, c) => (c === 2 ? x + reach * radius : x))));
  const axis = centre.length < 3 ? [] : [{ key: `${key}-axis`, d: line(upright[0], upright[1]), className: "axis" }];
  return {
    shapes: [...axis, { key, d: polyline(ring), className: marked(`ink body-${element.at}`, element) }],
    labels: [],
  };
}

/** A box on two wheels, or (as `block`) without. @param {Element} element @param {Stage} stage @param {Snapshot} now @param {string} key @returns {Figure} */
export function cart(element, stage, now, key) {
  const place = placeOf(stage, now, element.at ?? "");
  const w = (sizeOf(element.width, stage) * stage.scale) / 2 || stage.unit * 2.4;
  const h = (sizeOf(element.height, stage) * stage.scale) / 2 || stage.unit * 1.1;
  const wheel = stage.unit * 0.5;
  const wheels = element.kind === "block" ? [] : [-1, 1];
  const shapes = [
    ...wheels.map((side) => ({
      key: `${key}-wheel${side}`,
      d: circle(wheel, [side * w * 0.6, h + wheel]),
      className: "ink paper",
      at: place,
    })),
    {
      key,
      d: polygon([
        [-w, -h],
        [w, -h],
        [w, h],
        [-w, h],
      ]),
      className: marked(`ink steel body-${element.at}`, element),
      at: place,
      boxes: [boxAbout(place, w, h)],
    },
  ];
  return { shapes, labels: massOf(element.at, stage, place, w, h) };
}
