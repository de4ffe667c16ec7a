/** Values other than the scene's own: changed by sliders and in the drawing, kept in the address, simulated at once. */

import { mover } from "./store.js";
import { changed, heldAt, UNCHANGED, writeChanges } from "./values.js";

/** @param {import("./state.js").Store} store @param {() => void} simulate */
export function createAdjustments(store, simulate) {
  const { get, set } = store;
  const move = mover(store);
  /** @param {import("./types.js").Changes} changes */
  function change(changes) {
    set({ changes, held: null });
    move({ set: writeChanges(changes) });
    simulate();
  }
  return {
    change,
    /** @param {import("./values.js").Slider} slider @param {number} value */
    slide(slider, value) {
      const { scene, changes } = get();
      if (!scene) return;
      change(changed(scene, changes, slider, value));
      if (Number.isFinite(value) && heldAt(slider, value) !== value) set({ held: { key: slider.key, asked: value } });
    },
    reset: () => change(UNCHANGED),
  };
}
