/** The motion of the scene, and beside it the one that an answer describes. */

import { attempt } from "./attempt.js";
import { sampled, samplesFor } from "../sampling.js";

/** @typedef {import("./sheet.js").Entry} Entry */

/** @type {import("../types.js").Parts} */
const PARTS = ["coordinates", "rates", "positions", "loads", "error"];
const MOTION = {
  t_end: 10,
  samples: samplesFor(400),
  include: PARTS,
};

/** A built-in scene by its id, any other whole. @param {Entry} entry @returns {import("../types.js").Contract["Scene"]} */
const sceneOf = ({ reference, scene }) =>
  Object.keys(reference).length === 1 && typeof reference.scene === "string" ? reference.scene : scene;

/** @param {import("./state.js").Store} store @param {import("./state.js").Api} api */
export function createComparison(store, api) {
  const { get, set } = store;
  const lang = () => get().asked.place.lang;
  const simulate = sampled(api.simulate);

  /** @param {Entry} entry */
  async function animate(entry) {
    const simulated = simulate({ scene: sceneOf(entry), ...MOTION, lang: lang() }).catch(() => null);
    const guides = (entry.scene.guides ?? []).flatMap(({ coordinate, value }) => [
      { expression: coordinate },
      { expression: value },
    ]);
    const typeset = guides.length
      ? api.typeset({ scene: entry.scene, expressions: guides, lang: lang() }).catch(() => null)
      : null;
    const [right, written] = await Promise.all([simulated, typeset]);
    if (get().entry?.group !== entry.group) return;
    const latex = (written?.expressions ?? []).map((one) => one.latex);
    set({ right, still: !right, guides: latex.flatMap((left, i) => (i % 2 ? [] : [`${left} = ${latex[i + 1]}`])) });
  }

  return {
    animate,
    /** The motion that the last checked answer describes. */
    async compare() {
      const { entry, draft } = get();
      const { checked } = draft;
      if (!entry || !checked) return;
      await attempt(store, "trouble", "moving", async () => {
        const answer = { syntax: checked.syntax, value: checked.value };
        const { scene } = await api.post("/checks/motion", {
          ...entry.reference,
          task: entry.task.id,
          answer,
          lang: lang(),
        });
        const answered = await simulate({ scene, ...MOTION, lang: lang() });
        if (get().entry?.key === entry.key) set({ answered });
      });
    },
    /** The motion of the scene, asked for once more. */
    again() {
      const { entry } = get();
      set({ still: false });
      if (entry) void animate(entry);
    },
    /** The motion of the answer is no longer wanted. */
    part: () => set({ answered: null }),
  };
}
