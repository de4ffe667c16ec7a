/** How long a lecture has lasted: it can be stopped, gone on with and begun again. Times are milliseconds. */

/** @typedef {{before: number, since: number | null}} Timer  time counted before, and when counting last began */

/** @type {Timer} */
export const STOPPED = { before: 0, since: null };

/** @param {Timer} timer @param {number} now */
export const elapsed = ({ before, since }, now) => before + (since === null ? 0 : now - since);

/** Begins or stops counting. @param {Timer} timer @param {number} now @returns {Timer} */
export const toggled = (timer, now) =>
  timer.since === null ? { ...timer, since: now } : { before: elapsed(timer, now), since: null };

/** "0:07", "12:34", "1:02:03". @param {number} milliseconds */
export function clockText(milliseconds) {
  const seconds = Math.floor(milliseconds / 1000);
  const [h, m, s] = [Math.floor(seconds / 3600), Math.floor(seconds / 60) % 60, seconds % 60];
  const two = (/** @type {number} */ n) => String(n).padStart(2, "0");
  return h ? `${h}:${two(m)}:${two(s)}` : `${m}:${two(s)}`;
}
