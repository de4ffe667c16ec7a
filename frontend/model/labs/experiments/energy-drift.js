/** What becomes of the energy over very many steps. */

import { choice } from "../options.js";

/** @type {import("../options.js").Experiment} */
export default { example: { scene: "elastic-pendulum" }, options: [choice("steps", [1e3, 1e4, 1e5, 1e6], 1e5)] };
