/** What a tolerance of the start, or of parameters, does to a prediction. */

import { choice, duration, expression, number } from "../options.js";

/**
 * Quantities and their tolerances as they are typed, "phi1 = 0.01; l = 0,005": a number that is none is left to the
 * service to refuse.
 * @param {string} text
 */
const tolerancesIn = (text) =>
  Object.fromEntries(
    text
      .split(/;|,(?!\d)/)
      .map((part) => part.split(/[=:]/).map((side) => side.trim()))
      .filter(([name]) => name)
      .map(([name, size = ""]) => [name, size === "" ? null : Number(size.replace(",", "."))]),
  );

/** @type {import("../options.js").Experiment} */
export default {
  example: { scene: "double-pendulum", initial: { phi1: { value: 2, rate: 0 }, phi2: { value: 2.5, rate: 0 } } },
  options: [
    choice("uncertain", ["start", "values", "parameters", "all"], "start"),
    number({
      name: "spread",
      usual: 0,
      field: "tolerance",
      asked: (tolerance) => (tolerance ? { tolerance } : {}),
    }),
    {
      ...expression("tolerances"),
      asked: (text) => (text ? { tolerances: tolerancesIn(String(text)) } : {}),
    },
    choice("distribution", ["normal", "uniform"], "normal"),
    number({ name: "runs", usual: 0, field: "runs", asked: (runs) => (runs ? { runs } : {}) }),
    // In percent of the range.
    number({
      name: "share",
      usual: 25,
      field: "share",
      scale: 100,
      asked: (percent) => (percent === 25 ? {} : { share: percent / 100 }),
    }),
    duration(),
  ],
};
