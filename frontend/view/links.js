/** Links that the page follows by itself. */

/** Goes on the page where a click would leave it; with a key held, the browser opens the address elsewhere. @param {Event} event @param {() => void} go */
export function follow(event, go) {
  const { ctrlKey, metaKey, shiftKey } = /** @type {MouseEvent} */ (event);
  if (ctrlKey || metaKey || shiftKey) return;
  event.preventDefault();
  go();
}
