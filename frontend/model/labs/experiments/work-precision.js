/** Which method is the cheapest for an error that is wanted. */

import { duration, tick } from "../options.js";

/** @type {import("../options.js").Experiment} */
export default {
  example: { scene: "double-pendulum" },
  options: [duration(), tick("peers", false, (peers) => ({ peers }))],
};
