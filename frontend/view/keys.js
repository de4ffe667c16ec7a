/** The keyboard, as in a lecture: steps forward and back, full screen, black screen, overview. */

/** Where keys belong to the element itself. */
const FIELDS = "input, select, textarea, math-field, [contenteditable]";
/** Where "undo" belongs to the element itself. */
const TEXTS = "input:not([type=range], [type=checkbox], [type=radio]), textarea, math-field, [contenteditable]";
/** Where Space and Enter press the element itself. */
const PRESSED = "button, a, summary";

/**
 * @typedef {object} Keys
 * @property {(by: number) => void} go
 * @property {() => void} fullscreen
 * @property {(name: import("../model/types.js").Overlay) => void} overlay
 * @property {() => boolean} covered  something lies above the page
 * @property {() => void} uncover
 * @property {() => void} play
 * @property {() => void} substeps
 * @property {() => void} [lecture]
 * @property {() => void} [presenter]
 * @property {() => void} [add]  what is shown becomes a stop of the viewer's lecture
 * @property {() => void} [undo]  what was changed last, by Ctrl+Z
 * @property {() => void} [redo]  by Ctrl+Shift+Z or Ctrl+Y
 * @property {() => Record<string, () => void>} [more]  what keys mean at this moment besides
 * @property {() => boolean} [waiting]  what gives keys their meaning is still on its way
 */

/** What each key does. @param {Keys} keys @returns {Record<string, () => void>} */
export function table({ go, fullscreen, overlay, play, substeps, lecture, presenter, add }) {
  const next = () => go(1);
  const previous = () => go(-1);
  const none = () => {};
  return {
    ArrowRight: next,
    " ": next,
    n: next,
    PageDown: next,
    ArrowLeft: previous,
    p: previous,
    PageUp: previous,
    Home: () => go(-Infinity),
    End: () => go(Infinity),
    f: fullscreen,
    b: () => overlay("black"),
    ".": () => overlay("black"),
    Escape: () => overlay("overview"),
    o: () => overlay("overview"),
    "?": () => overlay("help"),
    g: () => overlay("jump"),
    k: play,
    e: substeps,
    l: lecture ?? none,
    s: presenter ?? none,
    a: add ?? none,
  };
}

/** @param {Pick<KeyboardEvent, "key" | "shiftKey">} event @param {Keys} keys */
function undoneBy({ key, shiftKey }, { undo, redo }) {
  const name = key.toLowerCase();
  if (name === "z") return shiftKey ? redo : undo;
  return name === "y" ? redo : undefined;
}

/**
 * Keys pressed while something is waited for are kept; what is returned has them pressed then.
 * @param {EventTarget} target @param {Keys} keys
 */
export function listen(target, keys) {
  const actions = table(keys);
  /** @type {Event[]} */
  const early = [];
  const press = (/** @type {Event} */ event) => {
    const { key, shiftKey, ctrlKey, metaKey, altKey, target: from } = /** @type {KeyboardEvent} */ (event);
    const element = from instanceof Element ? from : null;
    const undoing = (ctrlKey || metaKey) && !altKey && !element?.closest(TEXTS) && undoneBy({ key, shiftKey }, keys);
    if (undoing) {
      event.preventDefault();
      return undoing();
    }
    if (ctrlKey || metaKey || altKey || element?.closest(FIELDS)) return;
    if (keys.waiting?.()) return void early.push(event);
    if (key === " " && element?.closest(PRESSED)) return;
    const name = key.length === 1 ? key.toLowerCase() : key;
    const action = keys.more?.()[name] ?? actions[name];
    if (!action) return;
    // A dialog closes by itself on Escape; any of these keys ends the black screen.
    if (element?.closest("dialog")) return;
    event.preventDefault();
    if (keys.covered()) keys.uncover();
    else action();
  };
  target.addEventListener("keydown", press);
  return () => early.splice(0).forEach(press);
}
