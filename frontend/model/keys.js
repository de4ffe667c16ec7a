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
  [["ArrowDown", "ArrowUp"], "help.parts"],
  [["t"], "help.pace"],
  [["d"], "help.beside"],
  [["w"], "help.why"],
  [["h"], "help.spot"],
  [["?"], "help.help"],
];

/** What stands on a key. @type {Record<string, string>} */
const LABELS = { ArrowRight: "→", ArrowLeft: "←", ArrowDown: "↓", ArrowUp: "↑", " ": "Space", Escape: "Esc" };

/** @param {string} key */
export const labelOf = (key) => LABELS[key] ?? (key.length === 1 ? key.toUpperCase() : key);
