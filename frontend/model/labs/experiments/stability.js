/** At which step each method fails. */

import { choice, duration, parameter } from "../options.js";

/** @type {import("../options.js").Experiment} */
export default {
  example: { scene: "quarter-car" },
  options: [choice("at", ["state", "rest"], "state"), parameter("stiffness"), duration()],
};
