/** Films of a motion as the browser writes them. */

/** What browsers write, first what costs them least: what comes too late for a frame is left out. */
const FILMS = /** @type {const} */ ([
  ["video/webm;codecs=vp8", "webm"],
  ["video/webm", "webm"],
  ["video/mp4", "mp4"],
]);

/** Milliseconds between two pieces of a film, and until a browser that has written none will not write any. */
const PIECE = 100;
const PATIENCE = 20_000;
/** Bytes of a file that has no frame yet, at most. */
const HEAD = 1024;

/** How films are written here; null where the browser writes none. */
export const filmForm = () =>
  (typeof MediaRecorder === "function" && FILMS.find(([type]) => MediaRecorder.isTypeSupported(type))) || null;

/**
 * Starts a recorder and tells the seconds that it has recorded. A page that nobody sees has no frames: it waits.
 * @param {MediaRecorder} recorder
 */
export function createPace(recorder) {
  /** @type {Blob[]} */
  const parts = [];
  let broken = false;
  let [rested, since] = [0, 0];
  recorder.ondataavailable = ({ data }) => data.size && parts.push(data);
  recorder.onerror = () => (broken = true);
  const ended = new Promise((resolve) => (recorder.onstop = resolve));

  function look() {
    if (recorder.state === "recording" && document.hidden) {
      recorder.pause();
      since = performance.now();
    } else if (recorder.state === "paused" && !document.hidden) {
      rested += performance.now() - since;
      recorder.resume();
    }
  }

  document.addEventListener("visibilitychange", look);
  recorder.start(PIECE);
  const began = performance.now();
  const seconds = () => (performance.now() - began - rested) / 1000;
  return {
    seconds,
    /** A slow browser takes a while to its first frame. @param {() => void} paint  shows it a frame */
    async ready(paint) {
      await this.shown(paint, () => parts.reduce((sum, { size }) => sum + size, 0) >= HEAD);
    },
    /** Shows a frame until something is so. @param {() => void} paint @param {() => boolean} isSo */
    async shown(paint, isSo) {
      const since = performance.now();
      while (!isSo() && !this.broken && performance.now() - since < PATIENCE) {
        await new Promise(requestAnimationFrame);
        paint();
      }
    },
    /** The browser has given up. */
    get broken() {
      return broken || recorder.state === "inactive";
    },
    /** All that was written, and how many seconds it is long. A slow browser is late: its last frame is waited for. @param {() => void} paint  shows it */
    async end(paint) {
      const before = parts.length;
      await this.shown(paint, () => parts.length > before + 1);
      document.removeEventListener("visibilitychange", look);
      look();
      const length = seconds();
      const failed = this.broken;
      if (recorder.state !== "inactive") recorder.stop();
      if (!failed) await ended;
      return { parts: failed ? [] : parts, length };
    },
  };
}
