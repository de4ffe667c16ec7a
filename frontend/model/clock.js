/** The one clock that drawing, cursor, slider and read-outs follow. */

/** Seconds of rest at the end before the motion starts again. */
const REST = 0.8;

export function createClock() {
  let time = 0;
  let end = 0;
  let speed = 1;
  let playing = false;
  /** @type {Set<(t: number) => void>} */
  const listeners = new Set();
  const shown = () => Math.min(time, end);
  const tell = () => listeners.forEach((listener) => listener(shown()));

  return {
    get time() {
      return shown();
    },
    get end() {
      return end;
    },
    get speed() {
      return speed;
    },
    get playing() {
      return playing;
    },
    /** @param {number} seconds */
    setEnd(seconds) {
      end = Math.max(0, seconds);
      if (time > end) time = 0;
      tell();
    },
    /** @param {number} factor */
    setSpeed(factor) {
      speed = factor;
    },
    /** @param {boolean} on */
    play(on) {
      if (on && time >= end) time = 0;
      playing = on && end > 0;
      tell();
    },
    /** @param {number} t */
    seek(t) {
      time = Math.max(0, Math.min(end, t));
      tell();
    },
    /** Lets `seconds` of the viewer's time pass. @param {number} seconds */
    advance(seconds) {
      if (!playing || end === 0) return;
      time += Math.min(seconds, 0.1) * speed;
      if (time > end + REST * speed) time = 0;
      tell();
    },
    /** @param {(t: number) => void} listener */
    subscribe(listener) {
      listeners.add(listener);
      return () => listeners.delete(listener);
    },
  };
}

/** @typedef {ReturnType<typeof createClock>} Clock */
