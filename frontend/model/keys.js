/** The keys of the page, and the entries of the catalog that say what each does. */

/** Keys by the names that events give them, in the order in which they are told. @type {[string[], string][]} */
export const KEYS = [
  [["ArrowRight", "n", " ", "PageDown"], "help.next"],
  [["ArrowLeft", "p", "PageUp"], "help.previous"],
  [["Home", "End"], "help.ends"],
  [["g"], "help.jump"],
  [["e"], "help.substeps"],
  [["k"], "help.play"],
  [["f"], "help.fullscreen"],
  [["b", "."], "help.black"],
  [["Escape", "o"], "help.overview"],
  [["l"], "help.lecture"],
  [["s"], "help.presenter"],
  [["a"], "help.add"],
  [["ArrowDown", "ArrowUp"], "help.parts"],
  [["t"], "help.pace"],
  [["d"], "help.beside"],
  [["w"], "help.why"],
  [["h"], "help.spot"],
  [["q"], "help.ask"],
  [["Ctrl+Z", "Ctrl+Y"], "help.undo"],
  [["Enter"], "help.terms"],
  [["?"], "help.help"],
];

const ARROWS = /** @type {Record<string, string>} */ ({
  ArrowRight: "→",
  ArrowLeft: "←",
  ArrowDown: "↓",
  ArrowUp: "↑",
});
const CALLED = /** @type {Record<string, string>} */ ({
  " ": "key.space",
  Escape: "key.escape",
  Enter: "key.enter",
  Home: "key.home",
  End: "key.end",
  PageUp: "key.page-up",
  PageDown: "key.page-down",
  "Ctrl+Z": "key.undo",
  "Ctrl+Y": "key.redo",
});

/** What stands on a key. @param {string} key @param {import("./catalog.js").Translate} t */
export const labelOf = (key, t) => ARROWS[key] ?? (key in CALLED ? t(CALLED[key]) : key.toUpperCase());
