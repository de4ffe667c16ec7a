/** How much of a model may be left out. */

import { duration, number } from "../options.js";

/** @type {import("../options.js").Experiment} */
export default {
  example: { scene: "elastic-pendulum" },
  options: [
    duration(),
    // In percent of the motion.
    number({
      name: "allowed",
      label: "fidelity.tolerance",
      usual: 1,
      field: "tolerance",
      scale: 100,
      asked: (percent) => ({ tolerance: percent / 100 }),
    }),
  ],
};
