/** The experiments that ask something of their own, each in a file: here they are named, in the order of their answers in the address. */

import chaos from "./experiments/chaos.js";
import convergence from "./experiments/convergence.js";
import energyDrift from "./experiments/energy-drift.js";
import fidelity from "./experiments/fidelity.js";
import stabilityMap from "./experiments/stability-map.js";
import stability from "./experiments/stability.js";
import workPrecision from "./experiments/work-precision.js";
import { duration } from "./options.js";

/** @typedef {import("./options.js").Experiment} Experiment */
/** @typedef {import("./options.js").Option} Option */

/** @type {Record<string, Experiment>} */
const EXPERIMENTS = {
  "work-precision": workPrecision,
  convergence,
  "energy-drift": energyDrift,
  stability,
  "stability-map": stabilityMap,
  chaos,
  fidelity,
};

/** What is asked of an experiment of which only the server knows. @type {Experiment} */
const OTHER = { example: { scene: "double-pendulum" }, options: [duration()] };

/** @param {string} lab */
export const experimentOf = (lab) => EXPERIMENTS[lab] ?? OTHER;

/** Every option there is, once. */
export const OPTIONS = [
  ...new Map(
    Object.values(EXPERIMENTS)
      .flatMap(({ options }) => options)
      .map((option) => [option.name, option]),
  ).values(),
];
