/** A part that is fetched once, when it is first wanted. Where that fails, the failure is held until somebody tries again. */

/** @typedef {{readonly failed: boolean, again: () => Promise<unknown>}} Retried */

/**
 * @template T
 * @param {() => Promise<T>} fetch @param {() => void} changed  it is there, or it could not be had
 */
export function createLater(fetch, changed) {
  /** @type {T | null} */
  let part = null;
  /** @type {Promise<T | null> | null} */
  let coming = null;
  let failed = false;

  async function tried() {
    try {
      part = await fetch();
      failed = false;
    } catch (reason) {
      // What went wrong may be a mistake in the part itself, which its readers cannot mend.
      console.error(reason);
      coming = null;
      failed = true;
    }
    changed();
    return part;
  }
  const again = () => (coming ??= tried());
  return {
    /** Null until it is there. */
    get part() {
      return part;
    },
    /** It could not be had. */
    get failed() {
      return failed;
    },
    /** Null if it could not be had: what is wanted at each rendering is not asked for each time. @returns {Promise<T | null>} */
    want: () => (failed ? Promise.resolve(null) : again()),
    again,
  };
}
