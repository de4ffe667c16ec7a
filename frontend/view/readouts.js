/** The present values of coordinates and energies, in their colours; written directly, one after the other, each ten times a second at most. */

import { fixed, unitText } from "../model/numbers.js";
import { atMost, digitsIn } from "./digits.js";
import { typeset } from "./typesetting.js";
import { coordinateAt } from "../model/trajectory.js";

/** @typedef {import("../model/types.js").Scene} Scene */
/** @typedef {import("../model/types.js").Trajectory} Trajectory */

/** Milliseconds between two changes: faster ones cannot be read. */
const PAUSE = 100;

/** @param {HTMLElement} root */
export function createReadouts(root) {
  /** @type {{trajectory: Trajectory, lang: string, fields: Field[], next: number} | null} */
  let shown = null;
  let due = atMost(PAUSE);

  return {
    /** @param {Scene | null} scene @param {Trajectory | null} trajectory @param {string} lang */
    show(scene, trajectory, lang) {
      if (!scene || !trajectory?.t.length) {
        root.replaceChildren();
        shown = null;
      } else if (shown?.trajectory !== trajectory || shown.lang !== lang) {
        shown = { trajectory, lang, fields: fieldsIn(root, scene, trajectory, lang), next: 0 };
        due = atMost(PAUSE / shown.fields.length);
      }
    },
    /** The same as a sentence's part. @param {number} t */
    text: (t) => (shown?.fields ?? []).map(({ name, write }) => `${name} = ${write(t)}`).join(", "),
    /** One after the other: all at once would make a frame late. @param {number} t */
    move(t) {
      if (!shown?.fields.length || !due()) return;
      shown.fields[shown.next].write(t);
      shown.next = (shown.next + 1) % shown.fields.length;
    },
  };
}

/** @typedef {{name: string, write: (t: number) => string}} Field  writes the value at a moment, and says it */

/** @param {HTMLElement} root @param {Scene} scene @param {Trajectory} trajectory @param {string} lang @returns {Field[]} */
function fieldsIn(root, scene, trajectory, lang) {
  root.replaceChildren();
  return scene.coordinates
    .filter(({ name }) => trajectory.coordinates[name])
    .map((coordinate) => {
      const line = document.createElement("div");
      const [symbol, value] = [document.createElement("span"), document.createElement("span")];
      line.className = `q-${scene.coordinates.indexOf(coordinate)}`;
      value.className = "number";
      typeset(symbol, `${coordinate.latex || coordinate.name} =`, false, "html");
      line.append(symbol, value);
      root.append(line);
      const digits = digitsIn(value);
      const write = (/** @type {number} */ t) =>
        (digits.data = `${fixed(coordinateAt(trajectory, coordinate.name, t), 3, lang)} ${unitText(coordinate.unit)}`);
      write(0);
      return { name: coordinate.name, write };
    });
}
