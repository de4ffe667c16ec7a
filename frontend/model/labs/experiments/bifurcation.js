/** What a scene settles to while a parameter is swept both ways, and where that changes. */

import { choice, duration, expression, number, side, tick } from "../options.js";

/** @param {string} name @param {string} field @param {number} usual */
const count = (name, field, usual) =>
  number({ name, usual, field, asked: (given) => (given === usual ? {} : { [field]: given }) });

/** Which way the plane is passed; it has a name of its own, for another one is usual in a section. */
const passing = { ...choice("direction", ["falling", "rising", "both"], "falling"), name: "passing", key: "passing" };

const VALUES = 200;
/** Of motions that jump or stick each event takes as long as thousands of steps. */
const FEWER = 24;
/** So much of a range that begins with nothing: there a drive stands still, and has no period. */
const BESIDE = 0.05;

const swept = side("sweep", 1, VALUES);
/** @param {import("../options.js").Scene} scene */
const isJumping = ({ events, loads }) =>
  (events ?? []).some(({ then }) => then === "bounce") || (loads ?? []).some(({ kind }) => kind === "friction");

/** @type {typeof swept} */
const sweep = {
  ...swept,
  usualIn(scene) {
    const range = swept.usualIn?.(scene);
    if (!range) return null;
    const from = range.from === 0 ? BESIDE * range.to : range.from;
    return isJumping(scene) ? { ...range, from, count: FEWER } : { ...range, from };
  },
};

/** @type {import("../options.js").Experiment} */
export default {
  example: { scene: "driven-pendulum", sweep: { parameter: "gamma", from: 1.05, to: 1.087 } },
  options: [
    sweep,
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
