/** A server that is busy says so, and is asked again a little later. */

import { ApiError } from "../api.js";

const BUSY = [429, 503];
const TRIES = 5;
const PAUSE = 1000;

/**
 * The same call, asked again while the server is busy.
 * @template {unknown[]} A @template R
 * @param {(...given: A) => Promise<R>} call @param {(ms: number) => Promise<unknown>} [wait] @returns {(...given: A) => Promise<R>}
 */
export function patient(call, wait = (ms) => new Promise((done) => setTimeout(done, ms))) {
  return async (...given) => {
    for (let attempt = 1; ; attempt += 1) {
      try {
        return await call(...given);
      } catch (error) {
        if (!(error instanceof ApiError) || !BUSY.includes(error.failure.status) || attempt === TRIES) throw error;
        await wait(PAUSE * attempt);
      }
    }
  };
}
