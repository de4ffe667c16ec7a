/** What goes on from frame to frame. */

/** Nothing goes on in a page that waits in a hall for its turn. @param {(seconds: number) => void} advance  told how long ago the frame before was */
export function everyFrame(advance) {
  let before = 0;
  /** @param {number} now */
  function tick(now) {
    if (document.documentElement.dataset.hall !== "away") advance((now - before) / 1000);
    before = now;
    requestAnimationFrame(tick);
  }
  requestAnimationFrame(tick);
}

/** When there is nothing else to do, and after so many milliseconds at the latest. @param {() => void} task @param {number} timeout */
export function whenIdle(task, timeout) {
  if (window.requestIdleCallback) window.requestIdleCallback(task, { timeout });
  else setTimeout(task, 30);
}

/** When the next frame has been drawn: a long task does not hold it up. A page that is not seen has none. @param {() => void} task */
export function afterFrame(task) {
  if (document.hidden) setTimeout(task);
  else requestAnimationFrame(() => setTimeout(task));
}
