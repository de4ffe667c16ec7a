/** The whole path of every body, as a line that stays. */

import { trailOf } from "../../model/drawing/trail.js";
import { endOf } from "../../model/trajectory.js";

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
      const path = (/** @type {string} */ name) => trailOf(stage, name, trajectory.t[0] ?? 0, endOf(trajectory));
      draw(
        {
          shapes: scene.bodies.map(({ name }) => ({ key: name, d: path(name), className: `path body-${name}` })),
          labels: [],
        },
        stage.size,
      );
    },
  };
}
