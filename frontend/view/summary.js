/** The motion as sentences. */

import { fixed, unitText } from "../model/numbers.js";
import { courseOf, keepsEnergy } from "../model/summary.js";
import { coordinateAt, endOf } from "../model/trajectory.js";

/**
 * @param {import("../model/types.js").Scene} scene @param {import("../model/types.js").Trajectory} trajectory
 * @param {import("../model/catalog.js").Translate} t @param {string} lang
 */
export function summary(scene, trajectory, t, lang) {
  const number = (/** @type {number} */ value) => fixed(value, 2, lang);
  const told = scene.coordinates
    .filter(({ name }) => trajectory.coordinates[name])
    .map(({ name, unit }) => {
      const course = courseOf(trajectory.t, (t) => coordinateAt(trajectory, name, t));
      const numbers = Object.entries(course)
        .filter(([key]) => key !== "kind")
        .map(([key, value]) => [key, number(Number(value))]);
      return t(`motion.${course.kind}`, { name, unit: unitText(unit), ...Object.fromEntries(numbers) });
    });
  const kept = keepsEnergy(trajectory);
  const energy = kept === null ? [] : [t(kept ? "motion.energy-kept" : "motion.energy-changes")];
  return t("motion", { time: number(endOf(trajectory)), told: [...told, ...energy].join("; ") });
}
