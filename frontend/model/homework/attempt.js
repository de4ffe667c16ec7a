/** Requests that may fail: what goes wrong is kept to be shown, and nothing that was typed depends on it. */

import { ApiError } from "../api.js";

/** @typedef {import("./state.js").State} State */

/**
 * @param {import("./state.js").Store} store @param {"failure" | "trouble"} place @param {State["busy"]} busy
 * @param {() => Promise<void>} task
 */
export async function attempt({ get, set }, place, busy, task) {
  const about = get().entry?.key;
  // What came of one task is not said of another one that is on the page by now.
  const concerns = () => !busy || get().entry?.key === about;
  set({ busy, [place]: null });
  try {
    await task();
  } catch (error) {
    if (error instanceof ApiError) {
      if (concerns()) set({ [place]: error.failure });
    } else if (/** @type {Error} */ (error).name !== "AbortError") throw error;
  }
  if (concerns() && get().busy === busy) set({ busy: "" });
}
