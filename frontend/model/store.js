/** One state, changed by patches, watched by listeners once per turn. */

/**
 * @template {object} S
 * @param {S} initial
 * @param {(task: () => void) => void} [later] when listeners hear of changes
 */
export function createStore(initial, later = queueMicrotask) {
  let state = initial;
  let waiting = false;
  /** @type {Set<(state: S) => void>} */
  const listeners = new Set();

  function tell() {
    waiting = false;
    for (const listener of listeners) listener(state);
  }

  return {
    get: () => state,
    /** @param {Partial<S>} patch */
    set(patch) {
      const changed = Object.keys(patch).some(
        (key) => !Object.is(state[/** @type {keyof S} */ (key)], patch[/** @type {keyof S} */ (key)]),
      );
      if (!changed) return;
      state = { ...state, ...patch };
      if (!waiting) {
        waiting = true;
        later(tell);
      }
    },
    /** @param {(state: S) => void} listener */
    subscribe(listener) {
      listeners.add(listener);
      return () => listeners.delete(listener);
    },
  };
}

/**
 * What changes parts of the place that a store holds.
 * @template {{place: import("./types.js").Place}} S
 * @param {{get: () => S, set: (patch: Partial<S>) => void}} store
 */
export const mover =
  ({ get, set }) =>
  (/** @type {Partial<import("./types.js").Place>} */ patch) =>
    set(/** @type {Partial<S>} */ ({ place: { ...get().place, ...patch } }));
