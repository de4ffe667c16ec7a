/** Values other than the scene's own: changed by sliders and in the drawing, kept in the address, simulated at once. */

import { mover } from "./store.js";
import { changed, UNCHANGED, writeChanges } from "./values.js";

/** @param {import("./state.js").Store} store @param {() => void} simulate */
export function createAdjustments(store, simulate) {
  const { get, set } = store;
  const move = mover(store);
  /** @param {import("./types.js").Changes} changes */
  function change(changes) {
    set({ changes });
    move({ set: writeChanges(changes) });
    simulate();
  }
  return {
    change,
    /** @param {import("./values.js").Slider} slider @param {number} value */
    slide(slider, value) {
      const { scene, changes } = get();
      if (scene) change(changed(scene, changes, slider, value));
    },
    reset: () => change(UNCHANGED),
  };
}
