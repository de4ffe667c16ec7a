/** What goes on from frame to frame. */

/** @param {(seconds: number) => void} advance  told how long ago the frame before was */
export function everyFrame(advance) {
  let before = 0;
  /** @param {number} now */
  function tick(now) {
    advance((now - before) / 1000);
    before = now;
    requestAnimationFrame(tick);
  }
  requestAnimationFrame(tick);
}
