/** Letters of formulas: how much room they take in KaTeX's fonts, rounded, and the gaps between them (Knuth, The TeXbook, chapter 18). */

/** @typedef {{width: number, height: number, depth: number}} Box  in em; height above and depth below the baseline */
/** @typedef {Box & {kind: string}} Atom  kind: what it is to its neighbours, which decides on the gap between them */
/** @typedef {{scale: number, display: boolean}} Style  scale: 1, in scripts 0.7, in scripts of scripts 0.5 */
/** @typedef {[RegExp, number][]} Sizes */

/** @type {Sizes} */
const WIDTHS = [
  [/^[jlt|.!:';,]$/, 0.33],
  [/^[mw]$/, 0.84],
  [/^[MW]$/, 1.03],
  [/^[A-Z]$/, 0.77],
  [/^[0-9/]$/, 0.5],
  [/^[()[\]]$/, 0.39],
  [/^[a-z]$/, 0.5],
  [/^([=+\-<>]|\\(approx|neq|le|ge|equiv|pm|Omega|Phi|Psi|Delta))$/, 0.78],
  [/^\\(ell|iota)$/, 0.42],
  [/^\\cdot$/, 0.28],
  [/^\\nolimits$/, 0],
  [/^\\(sin|tan)$/, 1.24],
  [/^\\sum$/, 1.44],
  [/^\\int$/, 1],
  [/^\\(cos|det|exp|log)$/, 1.34],
  [/^\\arc(sin|cos|tan)$/, 2.7],
  [/^\\(Rightarrow|to)$/, 1],
  [/^\\Longleftrightarrow$/, 1.86],
];
/** @type {Sizes} */
const HEIGHTS = [[/^([acegm-su-z]|\\(alpha|gamma|kappa|mu|nu|omega|pi|rho|sigma|tau|var(epsilon|phi)))$/, 0.43]];
/** @type {Sizes} */
const DEPTHS = [
  [/^([fgjpqy]|\\(beta|chi|gamma|mu|phi|psi|rho|varphi|xi|zeta))$/, 0.2],
  [/^[()[\]|]$/, 0.25],
];
/** @type {[RegExp, string][]} */
const KINDS = [
  [/^([=<>]|\\(approx|neq|le|ge|equiv|to|Rightarrow|Longleftrightarrow))$/, "rel"],
  [/^([+-]|\\(cdot|pm|times))$/, "bin"],
  [/^[([]$/, "open"],
  [/^[)\]]$/, "close"],
  [/^[,;]$/, "punct"],
  [/^\\(sin|cos|tan|det|exp|log|int|sum|arc(sin|cos|tan))$/, "op"],
];
/** What is large in a line of its own: above and below the line of writing there, and within a line. */
const LARGE = /** @type {Record<string, Record<"own" | "within", {height: number, depth: number}>>} */ ({
  "\\int": { own: { height: 1.36, depth: 0.86 }, within: { height: 0.81, depth: 0.31 } },
  "\\sum": { own: { height: 1.05, depth: 0.55 }, within: { height: 0.75, depth: 0.25 } },
});
export const NOTHING = { width: 0, height: 0, depth: 0 };

/** @template T @param {[RegExp, T][]} table @param {string} token @param {T} other */
const lookedUp = (table, token, other) => table.find(([pattern]) => pattern.test(token))?.[1] ?? other;

/** @param {Atom} before @param {Atom} after @param {Style} style */
function gapBetween(before, after, { scale }) {
  const kinds = [before.kind, after.kind];
  const thin =
    (kinds.includes("op") && after.kind !== "open") ||
    before.kind === "punct" ||
    (kinds.includes("inner") && after.kind !== "punct");
  if (kinds.includes("gap") || before.kind === "open" || after.kind === "close") return 0;
  if (scale < 1) return kinds.includes("op") && thin ? scale / 6 : 0;
  if (kinds.includes("rel")) return before.kind === after.kind ? 0 : 5 / 18;
  if (kinds.includes("bin")) return 2 / 9;
  return thin ? 1 / 6 : 0;
}

/** Atoms side by side; a sign that joins nothing is a letter. @param {Atom[]} atoms @param {Style} style @returns {Box} */
export function beside(atoms, style) {
  let [box, before] = [NOTHING, /** @type {Atom | null} */ (null)];
  for (const atom of atoms) {
    const alone = atom.kind === "bin" && (!before || /^(bin|rel|open|punct|op)$/.test(before.kind));
    const here = alone ? { ...atom, kind: "ord" } : atom;
    box = {
      width: box.width + atom.width + (before ? gapBetween(before, here, style) : 0),
      height: Math.max(box.height, atom.height),
      depth: Math.max(box.depth, atom.depth),
    };
    before = here;
  }
  return box;
}

/** @param {string} token @param {Style} style @returns {Atom} */
export function letter(token, { scale, display }) {
  const large = LARGE[token]?.[display ? "own" : "within"];
  const box = {
    width: lookedUp(WIDTHS, token, 0.6),
    height: large?.height ?? lookedUp(HEIGHTS, token, 0.69),
    depth: large?.depth ?? lookedUp(DEPTHS, token, 0),
  };
  return {
    width: scale * box.width,
    height: scale * box.height,
    depth: scale * box.depth,
    kind: lookedUp(KINDS, token, "ord"),
  };
}
