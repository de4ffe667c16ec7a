/** An answer as it is typed: a text for each part, in either syntax; as one text for the checker, and back to the place in a part. */

/** @typedef {NonNullable<import("../types.js").Contract["AnswerText"]["syntax"]>} Syntax */
/** @typedef {{start: string, between: string, end: string}} Frame */
/** @typedef {{form: string, components: number | null}} Asked */

/** @type {Record<string, Record<Syntax, Frame>>} */
const FRAMES = {
  vector: {
    plain: { start: "[", between: ", ", end: "]" },
    latex: { start: "\\begin{bmatrix} ", between: " \\\\ ", end: " \\end{bmatrix}" },
  },
  equations: { plain: { start: "", between: "\n", end: "" }, latex: { start: "", between: "\n", end: "" } },
};
FRAMES.set = FRAMES.equations;
const SINGLE = { start: "", between: "", end: "" };
/** A semicolon parts equations; in LaTeX it may be but a space. */
const SPACE = /\\;/g;

/** How many parts an answer has. @param {Asked} task @param {number} freedoms */
export const partsOf = ({ form, components }, freedoms) =>
  form === "vector" ? (components ?? 1) : form in FRAMES ? freedoms : 1;

/** A comma between numbers may be that of a decimal. */
const COMMA = /(?<!\d|\{),(?=\s*\S)|,(?![\d}])(?=\s*\S)/;
/** e_x, \\hat x, \\vec e_1: a sum of unit vectors. */
const UNIT_VECTOR = /\be_?[123xyz]\b|\be_\{|\\(?:hat|vec|mathbf)\b|\\[ij]math\b/;

/** Whether a text says of itself where its parts are. @param {string} text */
const isWhole = (text) =>
  /^\s*(\[|\(.*,|\\begin|\\left)/.test(text) ||
  /[;\n]/.test(text.replace(SPACE, "")) ||
  UNIT_VECTOR.test(text) ||
  COMMA.test(outside(text));

/** What stands outside of all brackets. @param {string} text */
function outside(text) {
  let depth = 0;
  return [...text]
    .filter((one) => {
      depth += Number("([{".includes(one));
      const kept = depth === 0;
      depth -= Number(")]}".includes(one));
      return kept;
    })
    .join("");
}

/** One text alone in the first part, brackets and all, is the whole answer. @param {readonly string[]} parts @param {string} form */
const whole = (parts, form) => form in FRAMES && isWhole(parts[0]) && parts.slice(1).every((part) => !part.trim());

/** Nothing is missing in it. @param {readonly string[]} parts @param {string} form */
export const isComplete = (parts, form) => (whole(parts, form) ? true : parts.every((part) => part.trim() !== ""));
/** @param {readonly string[]} parts */
export const isEmpty = (parts) => parts.every((part) => part.trim() === "");

/** @param {readonly string[]} parts @param {string} form @param {Syntax} syntax */
export function joined(parts, form, syntax) {
  const { start, between, end } = whole(parts, form) || parts.length === 1 ? SINGLE : FRAMES[form][syntax];
  return start + parts.map((part) => (syntax === "latex" ? part.replace(SPACE, "\\,") : part)).join(between) + end;
}

/**
 * Which part a place of the joined text belongs to, and where in it.
 * @param {readonly string[]} parts @param {string} form @param {Syntax} syntax @param {number} offset in code points
 */
export function placeIn(parts, form, syntax, offset) {
  const frame = whole(parts, form) || parts.length === 1 ? SINGLE : FRAMES[form][syntax];
  let begin = frame.start.length;
  for (const [index, part] of parts.entries()) {
    const size = [...part].length;
    if (offset <= begin + size || index === parts.length - 1)
      return { part: index, offset: Math.max(0, Math.min(size, offset - begin)) };
    begin += size + frame.between.length;
  }
  return { part: 0, offset: 0 };
}
