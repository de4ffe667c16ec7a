/** Of many wishes the latest: one request at a time while a slider is dragged, or each in the place of the one before. */

/**
 * Requests while a slider is dragged: one at a time, at most one per `pause`, and always the latest wish.
 * @template W
 * @param {(wish: W, signal: AbortSignal) => Promise<void>} work
 * @param {number} pause milliseconds between two starts
 * @param {{now: () => number, wait: (ms: number) => Promise<void>}} [time]
 */
export function latestOnly(
  work,
  pause,
  time = { now: () => Date.now(), wait: (ms) => new Promise((done) => setTimeout(done, ms)) },
) {
  /** @type {{wish: W} | null} */
  let next = null;
  let running = false;
  let started = -Infinity;
  let control = new AbortController();

  async function run() {
    running = true;
    try {
      while (next) {
        await time.wait(Math.max(0, started + pause - time.now()));
        const { wish } = next ?? {};
        if (wish === undefined) break;
        next = null;
        started = time.now();
        await work(wish, control.signal);
      }
    } finally {
      running = false;
    }
  }

  return {
    /** Ends when nothing waits any more; what waits already is taken care of. @param {W} wish */
    async ask(wish) {
      next = { wish };
      if (!running) await run();
    },
    /** As `ask`, unless something newer waits. @param {W} wish */
    offer(wish) {
      next ??= { wish };
    },
    /** Drops what is waiting and aborts what is under way. */
    cancel() {
      next = null;
      control.abort();
      control = new AbortController();
    },
  };
}

/** Signals of which only the last one stands: each new one aborts the one before. @returns {() => AbortSignal} */
export function newest() {
  let control = new AbortController();
  return () => {
    control.abort();
    control = new AbortController();
    return control.signal;
  };
}
