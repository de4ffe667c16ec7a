/** Where in the plane of two parameters a driven motion is stable. */

import { side } from "../options.js";

/** @type {import("../options.js").Experiment} */
export default {
  example: {
    scene: "kapitza",
    x: { parameter: "omega", from: 10, to: 120 },
    y: { parameter: "y0", from: 0.01, to: 0.2 },
  },
  options: [side("x", 1), side("y", 2)],
  driven: true,
};
