/** Arrows r and v of bodies, reactions of constraints and dry friction: of those whose symbols are pointed at, and of all while their tool is on; and of what is released. */

import { groundOf, placed } from "../../model/drawing/placing.js";
import { vectorFigure, vectorSymbols } from "../../model/figure/vectors.js";
import { endOf, frictionsAt, multipliersAt, snapshotAt } from "../../model/trajectory.js";

/** @typedef {import("../../model/figure/vectors.js").Arrow} Arrow */

const VECTORS = /** @type {const} */ (["r", "v"]);
/** More arrows than any scene has. */
const MANY = 1000;
const pointedAt = (/** @type {string} */ text) => /** @type {Arrow[]} */ (JSON.parse(text));

/** @param {import("./open.js").Bench} bench @param {ReturnType<typeof import("./layer.js").layerIn>} layer */
export function createVectors(bench, { draw }) {
  const { root, parts, state, clock, now, kinematics } = bench;
  let drawn = false;
  /** How many arrows the letters of the drawing keep off. */
  let avoided = 0;
  /** @type {{of: unknown, symbols: Map<string, string>}} */
  let known = { of: null, symbols: new Map() };

  function symbols() {
    const { chapters = [], result = null } = state().derivation ?? {};
    if (known.of !== chapters) known = { of: chapters, symbols: vectorSymbols(chapters, result) };
    return known.symbols;
  }

  /** What was released is held by an arrow as long as it is asked for. @returns {Arrow[]} */
  function released() {
    return state()
      .place.release.split(",")
      .filter(Boolean)
      .map((of) => ({ of, vector: "h" }));
  }

  function wanted() {
    const { place, scene } = state();
    if (scene && place.with.split(",").includes("vectors"))
      return [
        ...scene.bodies.flatMap(({ name: of }) => VECTORS.map((vector) => ({ of, vector }))),
        ...(scene.constraints ?? []).map(({ name }) => ({ of: name ?? "", vector: /** @type {const} */ ("z") })),
        ...scene.loads
          .filter(({ kind }) => kind === "friction")
          .map(({ name }) => ({ of: name, vector: /** @type {const} */ ("f") })),
        ...released(),
      ];
    const { vectors } = root.dataset;
    return [...(vectors && vectors !== "[]" ? pointedAt(vectors) : []), ...released()];
  }

  function clear() {
    if (drawn) draw({ shapes: [], labels: [] });
    drawn = false;
    keepOff(null, 0);
  }

  /** With the tool, letters of the drawing make room for arrows; what is pointed at for a moment moves none. @param {import("../../model/types.js").Figure | null} figure @param {number} count */
  function keepOff(figure, count) {
    if (!figure && !avoided) return;
    parts.drawing.keepOff(figure ? { ...groundOf(figure), letters: [], turn: count / MANY } : undefined);
    if (!clock.playing || avoided !== count) parts.drawing.draw(clock.time);
    avoided = count;
  }

  function move() {
    const [arrows, moving, moment] = [wanted(), kinematics(), now()];
    const { stage } = parts.drawing;
    const { trajectory } = state();
    if (!arrows.length || !moving || !moment || !stage || !trajectory) return clear();
    const at = (/** @type {number} */ t) => snapshotAt(trajectory, t);
    const multipliers = (/** @type {number} */ t) => multipliersAt(trajectory, t);
    const frictions = (/** @type {number} */ t) => frictionsAt(trajectory, t);
    const motion = { kinematics: moving, symbols: symbols(), at, multipliers, frictions, end: endOf(trajectory) };
    const figure = vectorFigure(stage, moment, arrows, motion);
    const all = state().place.with.split(",").includes("vectors") || released().length > 0;
    keepOff(all ? figure : null, all ? arrows.length : 0);
    draw(placed(stage, figure, clock.time, parts.drawing.ground), stage.size);
    drawn = true;
  }

  root.addEventListener("lit", move);
  return { move };
}
