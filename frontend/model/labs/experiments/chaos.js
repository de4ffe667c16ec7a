/** How far a motion can be foretold, and when each start turns over. */

import { duration, tick } from "../options.js";

/** @type {import("../options.js").Experiment} */
export default {
  example: { scene: "double-pendulum", initial: { phi1: { value: 2 }, phi2: { value: 2.5 } } },
  options: [duration(), tick("flips", true, (map) => ({ map }))],
};
