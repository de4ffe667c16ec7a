/** Arrows r and v of bodies: of those whose symbols are pointed at, and of all while their tool is on. */

import { placed } from "../../model/drawing/placing.js";
import { vectorFigure, vectorSymbols } from "../../model/figure/vectors.js";
import { endOf, snapshotAt } from "../../model/trajectory.js";

/** @typedef {import("../../model/figure/vectors.js").Arrow} Arrow */

const VECTORS = /** @type {const} */ (["r", "v"]);
const pointedAt = (/** @type {string} */ text) => /** @type {Arrow[]} */ (JSON.parse(text));

/** @param {import("./open.js").Bench} bench @param {ReturnType<typeof import("./layer.js").layerIn>} layer */
export function createVectors(bench, { draw }) {
  const { root, parts, state, clock, now, kinematics } = bench;
  let drawn = false;
  /** @type {{of: unknown, symbols: Map<string, string>}} */
  let known = { of: null, symbols: new Map() };

  function symbols() {
    const chapters = state().derivation?.chapters ?? [];
    if (known.of !== chapters) known = { of: chapters, symbols: vectorSymbols(chapters) };
    return known.symbols;
  }

  function wanted() {
    const { place, scene } = state();
    const all = place.with.split(",").includes("vectors") ? (scene?.bodies ?? []) : [];
    if (all.length) return all.flatMap(({ name: body }) => VECTORS.map((vector) => ({ body, vector })));
    const { vectors } = root.dataset;
    return vectors && vectors !== "[]" ? pointedAt(vectors) : [];
  }

  function clear() {
    if (drawn) draw({ shapes: [], labels: [] });
    drawn = false;
  }

  function move() {
    const [arrows, moving, moment] = [wanted(), kinematics(), now()];
    const { stage, ground } = parts.drawing;
    const { trajectory } = state();
    if (!arrows.length || !moving || !moment || !stage || !trajectory) return clear();
    const at = (/** @type {number} */ t) => snapshotAt(trajectory, t);
    const about = { kinematics: moving, symbols: symbols(), at, end: endOf(trajectory) };
    draw(placed(stage, vectorFigure(stage, moment, arrows, about), clock.time, ground), stage.size);
    drawn = true;
  }

  root.addEventListener("lit", move);
  return { move };
}
