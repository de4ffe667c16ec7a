/** The right answer to a task, with the step of the derivation that shows it. */

import { attempt } from "./attempt.js";

/** @typedef {import("../types.js").Chapter} Chapter */

/** The first of the named steps that the derivation has, else the last one of their chapter. @param {Chapter[]} chapters @param {import("./sheet.js").Task["solution"]} wanted */
export function stepOf(chapters, { chapter, steps }) {
  const all = chapters.flatMap((one) => one.steps);
  const shown = steps.map((id) => all.find((one) => one.id === id)).find(Boolean);
  return shown ?? chapters.find(({ id }) => id === chapter)?.steps.at(-1) ?? null;
}

/**
 * @param {import("./state.js").Store} store @param {import("./state.js").Api} api
 * @param {import("./answering.js").Answering} answering
 */
export function createSolution(store, api, answering) {
  const { get, set } = store;
  return async function solve() {
    const { entry } = get();
    if (!entry) return;
    const { lang } = get().asked.place;
    const { seed: _, vary, ...common } = entry.reference;
    const scene = vary ? { scene: entry.scene } : common;
    await attempt(store, "trouble", "solving", async () => {
      const [answer, derivation] = await Promise.all([
        api.post("/tasks/solution", { ...entry.reference, task: entry.task.id, lang }),
        api.derive({ ...scene, lang }).catch(() => null),
      ]);
      if (get().entry?.key !== entry.key) return;
      set({
        solution: {
          plain: answer.plain,
          latex: answer.latex,
          step: stepOf(derivation?.chapters ?? [], entry.task.solution),
        },
      });
      answering.keep(entry, (draft) => ({ shown: draft.shown || !draft.solved }));
    });
  };
}
