/** The experiments for whose questions the page has words of its own, each in a file: here they are named, in the order of their answers in the address. Any other is asked what the service says may be asked. */

import basins from "./experiments/basins.js";
import bifurcation from "./experiments/bifurcation.js";
import chaos from "./experiments/chaos.js";
import convergence from "./experiments/convergence.js";
import energyDrift from "./experiments/energy-drift.js";
import fidelity from "./experiments/fidelity.js";
import poincareSection from "./experiments/poincare-section.js";
import stabilityMap from "./experiments/stability-map.js";
import stability from "./experiments/stability.js";
import uncertainty from "./experiments/uncertainty.js";
import workPrecision from "./experiments/work-precision.js";
import { bounded, duration, optionOf } from "./options.js";

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
  "poincare-section": poincareSection,
  uncertainty,
  bifurcation,
  basins,
  fidelity,
};

/** The scene on which an experiment is shown of which only the service knows. */
const EXAMPLE = { scene: "double-pendulum" };

/** Each once, of the same name the last. @param {Option[]} options */
const distinct = (options) => [...new Map(options.map((option) => [option.name, option])).values()];

/**
 * What is asked of each experiment, with the bounds and defaults that the service tells.
 * @param {readonly import("../types.js").Contract["ExperimentEntry"][]} menu
 */
export function experimentsOf(menu) {
  /** @param {string} lab */
  const fieldsOf = (lab) => menu.find(({ id }) => id === lab)?.options ?? [];
  const own = distinct(Object.values(EXPERIMENTS).flatMap(({ options }) => options));
  /** @param {string} lab @returns {Experiment} */
  function experiment(lab) {
    const fields = fieldsOf(lab);
    const known = EXPERIMENTS[lab];
    if (known) return { ...known, options: known.options.map((option) => bounded(option, fields)) };
    return { example: EXAMPLE, options: fields.length ? fields.map((field) => optionOf(lab, field)) : [duration()] };
  }
  return {
    experiment,
    /** What an address may say while an experiment is shown. @param {string} lab */
    options: (lab) => distinct([...own, ...experiment(lab).options]),
  };
}

/** @typedef {ReturnType<typeof experimentsOf>} Experiments */

/** What the page knows of them by itself. */
export const KNOWN = experimentsOf([]);
