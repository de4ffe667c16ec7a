/** A motion as still pictures over time, for paper: one for each row of curves, with the numbers on its axes. */

import { traced, unbroken } from "./curve.js";
import { rowsOf } from "./curves.js";
import { polyline } from "./drawing/geometry.js";
import { scaleOf } from "./figure/phase.js";
import { endOf } from "./trajectory.js";

/** @typedef {import("./figure/phase.js").Tick} Tick */
/** @typedef {{latex: string, className: string, dash: string, path: string}} Line */
/** @typedef {{key: string, unit: string, lines: Line[], columns: Tick[], rows: Tick[]}} Picture */

/** Pictures have this size, in units of their own, and this room for numbers. */
export const SIZE = { width: 310, height: 130 };
export const ROOM = { left: 34, right: 8, top: 4, bottom: 18 };

/**
 * @param {import("./types.js").Scene} scene @param {import("./types.js").Trajectory} trajectory
 * @returns {Picture[]}
 */
export function picturesOf(scene, trajectory) {
  const time = scaleOf([0, endOf(trajectory)], ROOM.left, SIZE.width - ROOM.right, { share: 0 });
  return rowsOf(scene, trajectory).map(({ key, unit, least, curves }) => {
    const solid = curves.filter(({ dash }) => dash === "solid");
    const up = scaleOf(
      solid.flatMap(({ values }) => values).filter(Number.isFinite),
      SIZE.height - ROOM.bottom,
      ROOM.top,
      { apart: 24, least },
    );
    const lines = solid.map(({ latex, className, dash, times, at }) => {
      const trace = traced((t) => [time.pixel(t), up.pixel(at(t))], times);
      return {
        latex,
        className,
        dash,
        path: unbroken(trace, at)
          .map(({ points }) => polyline(points))
          .join(""),
      };
    });
    return { key, unit, lines, columns: time.ticks, rows: up.ticks };
  });
}
