/** A handout: the whole derivation of a scene, with its values and one picture of it; or a general proof. */

import { ApiError } from "./api.js";
import { linesOf } from "./reveal.js";
import { asTyped, completed, OWN } from "./own.js";
import { sampled, samplesFor } from "./sampling.js";
import { mover } from "./store.js";
import { readChanges } from "./values.js";

/** @typedef {import("./types.js").Failure} Failure */
/**
 * @typedef {object} Sheet
 * @property {import("./types.js").Place} place
 * @property {import("./types.js").Catalog} catalog
 * @property {import("./types.js").Scene | null} scene
 * @property {import("./reveal.js").Line[]} lines
 * @property {import("./types.js").Trajectory | null} trajectory
 * @property {string} proof  the id of a general proof; "" for a scene
 * @property {boolean} substeps  whether they are told, too
 * @property {Failure | null} failure
 */

/** @type {import("./types.js").Parts} */
const PARTS = ["coordinates", "rates", "positions", "loads", "multipliers", "energy"];
export const SECONDS = 10;
const SAMPLES = samplesFor(500);

/**
 * @param {ReturnType<typeof import("./store.js").createStore<Sheet>>} store
 * @param {import("./api.js").Api} api
 * @param {import("./own.js").SceneDocument | null} own  the viewer's own scene, if it is that
 */
export function createHandout(store, api, own) {
  const { get, set } = store;
  const move = mover(store);

  /** @returns {Promise<Partial<Sheet>>} */
  async function proven() {
    const { chapters } = await api.proof(get().proof, get().place.lang);
    return { lines: linesOf(chapters), failure: null };
  }

  /** @returns {Promise<Partial<Sheet>>} */
  async function derived() {
    const { lang, scene, n, formulation, set: changes, release } = get().place;
    const { parameters: values, initial } = readChanges(changes);
    const asked = scene === OWN && own ? asTyped(own) : scene;
    /** @type {Record<string, number>} */
    const parameters = n ? { n } : {};
    const released = release ? { release: release.split(",") } : {};
    const [{ chapters }, document, trajectory] = await Promise.all([
      api.derive({ scene: asked, lang, formulation, parameters, ...released }),
      own && scene === OWN ? completed(own) : api.scene(scene, lang, n),
      sampled(api.simulate)({
        scene: asked,
        parameters: { ...values, ...parameters },
        initial,
        t_end: SECONDS,
        samples: SAMPLES,
        include: PARTS,
        ...released,
        lang,
      }).catch(() => null),
    ]);
    return { lines: linesOf(chapters), scene: document, trajectory, failure: null };
  }

  async function load() {
    const { lang } = get().place;
    const keep = (/** @type {Partial<Sheet>} */ part) => get().place.lang === lang && set(part);
    try {
      const texts = api.catalog(lang, "lecture").then((catalog) => keep({ catalog }));
      const [sheet] = await Promise.all([get().proof ? proven() : derived(), texts]);
      keep(sheet);
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      const catalog = await api.catalog(lang, "lecture").catch(() => ({}));
      set({ failure: error.failure, catalog });
    }
  }

  return {
    load,
    move,
    /** @param {import("./types.js").Lang} lang */
    async language(lang) {
      move({ lang });
      await load();
    },
    toggleSubsteps: () => set({ substeps: !get().substeps }),
  };
}
