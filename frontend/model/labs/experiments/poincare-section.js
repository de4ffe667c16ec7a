/** Which motions of one energy are regular and which chaotic, by their points in a plane. */

import { choice, duration, expression, number, value } from "../options.js";

/** @param {string} name @param {string} field @param {number} usual */
const count = (name, field, usual) =>
  number({ name, usual, field, asked: (given) => (given === usual ? {} : { [field]: given }) });

/** @type {import("../options.js").Experiment} */
export default {
  example: { scene: "double-pendulum", initial: { phi1: { value: 0.9, rate: 0 }, phi2: { value: 0.9, rate: 0 } } },
  options: [
    expression("plane"),
    choice("direction", ["rising", "falling", "both"], "rising"),
    expression("horizontal"),
    expression("vertical"),
    value("energy"),
    count("grid", "count", 6),
    count("crossings", "crossings", 80),
    count("skip", "skip", 0),
    duration(),
  ],
};
