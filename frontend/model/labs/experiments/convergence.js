/** How fast errors fall with the step. */

import { duration } from "../options.js";

/** @type {import("../options.js").Experiment} */
export default { example: { scene: "elastic-pendulum" }, options: [duration()] };
