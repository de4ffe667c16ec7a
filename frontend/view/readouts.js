/** The present values of coordinates and energies, in their colours; written directly, ten times a second at most. */

import { fixed, unitText } from "../model/numbers.js";
import { atMost, digitsIn } from "./digits.js";
import { snapshotAt } from "../model/trajectory.js";

/** @typedef {import("../model/types.js").Scene} Scene */
/** @typedef {import("../model/types.js").Trajectory} Trajectory */

/** Milliseconds between two changes: faster ones cannot be read. */
const PAUSE = 100;

/** @param {HTMLElement} root */
export function createReadouts(root) {
  /** @type {{trajectory: Trajectory, lang: string, write: ((t: number) => string)} | null} */
  let shown = null;
  let due = atMost(PAUSE);

  return {
    /** @param {Scene | null} scene @param {Trajectory | null} trajectory @param {string} lang */
    show(scene, trajectory, lang) {
      if (!scene || !trajectory?.t.length) {
        root.replaceChildren();
        shown = null;
      } else if (shown?.trajectory !== trajectory || shown.lang !== lang) {
        shown = { trajectory, lang, write: fields(root, scene, trajectory, lang) };
        due = atMost(PAUSE);
      }
    },
    /** The same as a sentence's part. @param {number} t */
    text(t) {
      return shown?.write(t) ?? "";
    },
    /** @param {number} t */
    move(t) {
      if (shown && due()) shown.write(t);
    },
  };
}

/** @param {HTMLElement} root @param {Scene} scene @param {Trajectory} trajectory @param {string} lang */
function fields(root, scene, trajectory, lang) {
  const wanted = scene.coordinates.filter((c) => trajectory.coordinates[c.name]);
  const cells = wanted.map((coordinate) => {
    const line = document.createElement("div");
    const [symbol, value] = [document.createElement("span"), document.createElement("span")];
    line.className = `q-${scene.coordinates.indexOf(coordinate)}`;
    value.className = "number";
    globalThis.katex.render(`${coordinate.latex || coordinate.name} =`, symbol, { throwOnError: false, strict: "ignore", output: "html" });
    line.append(symbol, value);
    return { line, value: digitsIn(value), coordinate };
  });
  root.replaceChildren(...cells.map((cell) => cell.line));
  return (/** @type {number} */ t) => {
    const now = snapshotAt(trajectory, t);
    for (const { value, coordinate } of cells) {
      value.data = `${fixed(now.coordinates[coordinate.name], 3, lang)} ${unitText(coordinate.unit)}`;
    }
    return cells.map(({ value, coordinate }) => `${coordinate.name} = ${value.data}`).join(", ");
  };
}
