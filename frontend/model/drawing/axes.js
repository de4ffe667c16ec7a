/** The directions in which components are counted, in a corner where nothing moves; and a cross at the origin. */

import { add, line, scaled } from "./geometry.js";
import { solidArrow } from "./marks.js";
import { letterSize } from "./placing.js";

/** @typedef {import("../types.js").Pixel} Pixel */

/** Lengths in units of the drawing: of an arrow, from its tip to its letter, from the edges, of the cross. */
const ARROW = 2.4;
const BEYOND = 0.25;
const MARGIN = 1.3;
const CROSS = 0.45;
/** An axis that comes towards the viewer is seen this short at least. */
const SHORTEST = 0.5;
const NAMES = ["x", "y", "z"];
/** Half the width and height of their letters, in em. */
const HALF = [0.75, 0.6];

/**
 * One arrow for each component of a position, in the order of the components; in space as the scene is seen.
 * @param {import("./stage.js").Stage} stage
 * @returns {import("../types.js").Figure}
 */
export function axesOf(stage) {
  const { scene, size, unit, scale, direct, project } = stage;
  const em = letterSize(stage);
  const names = NAMES.slice(0, scene.dimension);
  const arrows = names.map((_, axis) => {
    const [x, y] = scaled(direct(names.map((_, other) => Number(other === axis))), ARROW / scale);
    const seen = Math.hypot(x, y) / ARROW;
    return scaled([x, y], (unit * Math.max(seen, SHORTEST)) / (seen || 1));
  });
  const ends = arrows.map(([x, y]) => {
    const long = Math.hypot(x, y);
    const room = BEYOND * unit + (em * (HALF[0] * Math.abs(x) + HALF[1] * Math.abs(y))) / long;
    return scaled([x, y], 1 + room / long);
  });
  const margin = Math.max(MARGIN * unit, em); // letters are not smaller in a small drawing
  /** @type {Pixel} */
  const corner = [
    margin - Math.min(0, ...ends.map(([x]) => x)),
    size.height - margin - Math.max(0, ...ends.map(([, y]) => y)),
  ];
  const origin = project(names.map(() => 0));
  const cross = [0, 1].map((c) => {
    /** @type {Pixel} */
    const arm = c ? [0, CROSS * unit] : [CROSS * unit, 0];
    return line(add(origin, scaled(arm, -1)), add(origin, arm));
  });
  return {
    shapes: [
      { key: "origin", d: cross.join(""), className: "extension" },
      ...arrows.flatMap((arrow, axis) => solidArrow(corner, arrow, `axis-${names[axis]}`, "axes", 0.75 * unit)),
    ],
    labels: names.map((name, axis) => ({
      key: `axis-${name}`,
      latex: `\\mathbf{e}_${name}`,
      at: add(corner, ends[axis]),
      className: "axes",
    })),
  };
}
