/** What a scene settles to while a parameter is swept both ways, and where that changes. */

import { choice, duration, expression, number, side, tick } from "../options.js";

/** @param {string} name @param {string} field @param {number} usual */
const count = (name, field, usual) =>
  number({ name, usual, field, asked: (given) => (given === usual ? {} : { [field]: given }) });

/** Which way the plane is passed; it has a name of its own, for another one is usual in a section. */
const passing = { ...choice("direction", ["falling", "rising", "both"], "falling"), name: "passing", key: "passing" };

/** @type {import("../options.js").Experiment} */
export default {
  example: { scene: "driven-pendulum", sweep: { parameter: "gamma", from: 1.05, to: 1.087 } },
  options: [
    side("sweep", 1),
    expression("vertical"),
    expression("period"),
    expression("plane"),
    passing,
    count("settle", "skip", 100),
    count("shown", "crossings", 48),
    count("folds", "folds", 8),
    tick("orbits", true, (wanted) => (wanted ? {} : { orbits: false })),
    duration(),
  ],
  driven: true,
};
