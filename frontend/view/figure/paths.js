/** The whole path of every body, as a line that stays. */

import { polyline } from "../../model/drawing/geometry.js";

/** Points of a path: more are not seen. */
const POINTS = 1500;

/** @param {import("./open.js").Bench} bench @param {ReturnType<typeof import("./layer.js").layerIn>} layer */
export function createPaths({ parts: { drawing }, state }, { draw }) {
  /** @type {unknown[]} */
  let drawnFor = [];

  return {
    show() {
      const { place, scene, trajectory } = state();
      const { stage } = drawing;
      const on = place.with.includes("paths") && scene && trajectory && stage;
      const given = [on && trajectory, stage];
      if (given.every((part, i) => part === drawnFor[i])) return;
      drawnFor = given;
      if (!on) return draw({ shapes: [], labels: [] });
      const stride = Math.ceil(trajectory.t.length / POINTS);
      const path = (/** @type {string} */ name) => polyline((trajectory.positions[name] ?? []).filter((_, i) => i % stride === 0).map(stage.project));
      draw({ shapes: scene.bodies.map(({ name }) => ({ key: name, d: path(name), className: `path body-${name}` })), labels: [] }, stage.size);
    },
  };
}
