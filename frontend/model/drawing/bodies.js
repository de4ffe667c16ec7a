/** The bodies of a system: bob, disc, hoop, cart, block; with the letters of their masses. */

import { add, circle, line, polygon, polyline } from "./geometry.js";
import { boxAbout } from "./placing.js";
import { latexOf, letterClass, marked, placeOf, sizeOf } from "./stage.js";

/** @typedef {import("../types.js").Element} Element */
/** @typedef {import("../types.js").Figure} Figure */
/** @typedef {import("../types.js").Pixel} Pixel */
/** @typedef {import("./stage.js").Stage} Stage */
/** @typedef {import("../types.js").Snapshot} Snapshot */

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
