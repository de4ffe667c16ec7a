/** Short motions of the built-in scenes, for the drawings of the start page; a few are asked for at a time. */

import { sampled, samplesFor } from "../sampling.js";

const SECONDS = 6;
const RATE = 30;
const AT_ONCE = 3;
/** @type {import("../types.js").Parts} */
const PARTS = ["coordinates", "rates", "positions", "loads"];

/** @typedef {{scene: import("../types.js").Scene, trajectory: import("../types.js").Trajectory}} Sample */

/**
 * @param {Pick<import("../api.js").Api, "scene" | "simulate">} api
 * @param {() => import("../types.js").Lang} lang
 */
export function createSamples(api, lang) {
  /** @type {(() => Promise<void>)[]} */
  const waiting = [];
  let running = 0;

  function next() {
    const task = running < AT_ONCE ? waiting.shift() : undefined;
    if (!task) return;
    running += 1;
    void task().finally(() => {
      running -= 1;
      next();
    });
  }

  /** @param {string} id @returns {Promise<Sample | null>} null where it cannot be had: the card then goes without */
  async function sample(id) {
    const request = {
      scene: id,
      t_end: SECONDS,
      samples: samplesFor(SECONDS * RATE),
      include: PARTS,
      lang: lang(),
    };
    const [scene, trajectory] = await Promise.all([api.scene(id, lang()), sampled(api.simulate)(request)]);
    return trajectory.t.length && !trajectory.coarse ? { scene, trajectory } : null;
  }

  return {
    /** @param {string} id @returns {Promise<Sample | null>} */
    ask: (id) =>
      new Promise((done) => {
        waiting.push(() => sample(id).then(done, () => done(null)));
        next();
      }),
  };
}
