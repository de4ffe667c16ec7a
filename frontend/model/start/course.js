/** The lecture as a course: its chapters in order, each entry the address at which its subject is shown. */

import { exampleOf, NOTHING, writeQuestion as writeLab } from "../labs/question.js";
import { HOME, writePlace } from "../url.js";
import { example } from "../variations/examples.js";
import { writeQuestion } from "../variations/question.js";

/** @typedef {import("../types.js").Place} Place */
/** @typedef {{id: string, path: string, place: Partial<Place>, more?: string}} Entry  more: what the query says besides the place */
/** @typedef {{id: string, entries: Entry[]}} Part */

/** @param {string} id @param {string} scene @param {string} step @param {Partial<Place>} [more] @returns {Entry} */
const shown = (id, scene, step, more = {}) => ({ id, path: "/scene", place: { scene, step, ...more } });
/** @param {string} id  of the example @returns {Entry} */
const varied = (id) => ({ id, path: "/variations", place: {}, more: writeQuestion(example(id)) });
/** @param {string} id @param {string} step @returns {Entry} */
const proved = (id, step) => ({ id, path: "/proof", place: { step } });

/** @param {string} id @param {string} lab @returns {Entry} */
const measured = (id, lab) => ({
  id,
  path: "/labs",
  place: {},
  more: writeLab({ ...NOTHING, ...exampleOf(lab), lab }),
});

/** @type {Part[]} */
export const COURSE = [
  { id: "variation", entries: [varied("identity"), varied("square"), varied("chain")] },
  {
    id: "displacement",
    entries: [
      shown("position", "base-pendulum", "position:bob"),
      shown("virtual", "base-pendulum", "virtual-displacement:bob"),
      shown("guided", "guided-pendulum", "guided-position:bob"),
      shown("differential", "guided-pendulum", "total-differential:bob"),
    ],
  },
  {
    id: "forces",
    entries: [
      shown("force", "elastic-pendulum", "work-of-force:drive"),
      shown("coefficients", "elastic-pendulum", "generalized-forces"),
      shown("moment", "pendulum-with-moment", "work-of-moment:drive"),
      shown("distributed", "wind-on-rod", "work-of-distributed-force:wind"),
    ],
  },
  {
    id: "dalembert",
    entries: [
      proved("proof", ""),
      shown("dots", "elastic-pendulum", "cancellation-of-dots:bob"),
      shown("inertia", "elastic-pendulum", "inertia-work:phi"),
    ],
  },
  {
    id: "lagrange",
    entries: [
      shown("energy", "elastic-pendulum", "kinetic-energy-of-particle:bob"),
      shown("decomposition", "elastic-pendulum", "decomposition"),
      shown("function", "elastic-pendulum", "lagrangian"),
      shown("equations", "elastic-pendulum", "equation:phi"),
      shown("guided-equation", "guided-pendulum", "equation:phi"),
    ],
  },
  {
    id: "beyond",
    entries: [
      shown("linear", "elastic-pendulum", "linearization:1"),
      shown("hamilton", "elastic-pendulum", "", { formulation: "hamilton" }),
      shown("chaos", "double-pendulum", "equation:phi1"),
      shown("kapitza", "kapitza", ""),
    ],
  },
  {
    id: "labs",
    entries: [
      measured("cost", "work-precision"),
      measured("order", "convergence"),
      measured("energy", "energy-drift"),
      measured("failure", "stability"),
      measured("upright", "stability-map"),
      measured("horizon", "chaos"),
      measured("section", "poincare-section"),
      measured("uncertainty", "uncertainty"),
      measured("cascade", "bifurcation"),
      measured("basins", "basins"),
      measured("least", "fidelity"),
    ],
  },
];

/** The address of an entry, in the reader's language and appearance. @param {Entry} entry @param {Pick<Place, "lang" | "theme">} reader */
export function addressOf({ path, place, more }, { lang, theme }) {
  const query = writePlace({ ...HOME, ...place, lang, theme });
  return path + query + (more ? `${query ? "&" : "?"}${more}` : "");
}
