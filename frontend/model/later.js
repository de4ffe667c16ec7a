/** A part that is fetched once, when it is first wanted. */

/**
 * @template T
 * @param {() => Promise<T>} fetch @param {() => void} came
 */
export function createLater(fetch, came) {
  /** @type {T | null} */
  let part = null;
  /** @type {Promise<T> | null} */
  let coming = null;
  return {
    /** Null until it is there. */
    get part() {
      return part;
    },
    want() {
      coming ??= fetch().then((fetched) => {
        part = fetched;
        came();
        return fetched;
      });
      return coming;
    },
  };
}
