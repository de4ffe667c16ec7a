/** Tasks that may fail: why is kept with the part of the page that they were for. */

import { ApiError } from "./api.js";

/** What the server found wrong; nothing, where it could not be asked. @param {unknown} error */
export const problemsIn = (error) => (error instanceof ApiError ? error.failure.problems : []);

/** @param {import("./state.js").Store} store @returns {import("./state.js").Attempt} */
export function createAttempts({ get, set }) {
  /** @param {keyof import("./state.js").State["failures"]} part @param {import("./types.js").Failure | null} failure */
  const fail = (part, failure) => set({ failures: { ...get().failures, [part]: failure } });
  return async (part, task) => {
    try {
      await task();
      fail(part, null);
    } catch (error) {
      if (error instanceof ApiError) fail(part, error.failure);
      else if (/** @type {Error} */ (error).name !== "AbortError") throw error;
    }
  };
}
