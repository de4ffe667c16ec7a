/**
 * Shorthand of the blackboard, for formulas that are too long to be read from the last row otherwise: blocks of a matrix
 * by their names, one law or one term of a sum for all coordinates that it is the same for, s_α for sin α. What stands for
 * what is told in the formula itself.
 */

import { entriesWithin, inBlocks } from "./blocks.js";
import { cut, tokensOf, weight } from "./latex.js";
import { joins } from "./linebreak.js";
import { sizeOf } from "./measure.js";
import { equationsOf, isEquivalent, plain } from "./parts.js";
import { overReactions } from "./reactions.js";

/** @typedef {import("./parts.js").Part} Part */

const GAP = " \\\\[0.4em] ";
/** A coordinate as it stands in a formula: varied or differentiated, with its index, squared. */
const COORDINATE =
  /^(\\delta |\\mathrm\{d\})?(?:(\\d?dot)\{(\\?[a-zA-Z]+)\}|(\\?[a-zA-Z]+))((?:_(?:\w|\{\w+\}))?)(\^\{\d\})?$/;
const OF_COORDINATE = /(?:^| )q-(\d+)(?: |$)/;
/** What coordinates are called that a law is the same for, the first and the second. */
const ANY = ["i", "k"];
const COLUMNS =
  /^(\\begin\{bmatrix\}(?:(?!\\begin\{bmatrix\})[\s\S])*\\end\{bmatrix\})\s*=\s*(\\begin\{bmatrix\}(?:(?!\\begin\{bmatrix\})[\s\S])*\\end\{bmatrix\})$/;
/** Functions that have a short form, from so many on; arguments up to so many letters stand below it. */
const FUNCTIONS = { "\\sin": "s", "\\cos": "c" };
const OFTEN = 3;
const NARROW = 9;
/** What a left side is said to depend on. */
const ARGUMENTS = /\((?:\\htmlClass\{q-\d+\}\{[^{}]*(?:\{\w+\})?\}(?:,\s*)?){2,}\)$/;
/** Terms of a sum that are alike, and symbols that are counted through, from so many on. */
const MANY = 3;
/** Em: a line of a slide has about so many, with equations so far apart and so high. */
const [LINE, APART, HIGH] = [26, 2, 2.6];

/**
 * What has classes, made into something else from the outside in.
 * @param {string} latex @param {(names: string, content: string) => string | null} make  null: the same with other content
 * @returns {string}
 */
function withClasses(latex, make) {
  const begin = latex.indexOf("\\htmlClass{");
  if (begin < 0) return latex;
  const [names, next] = groupAt(latex, begin + "\\htmlClass".length);
  const [content, end] = groupAt(latex, next);
  const made = make(names, content) ?? `\\htmlClass{${names}}{${withClasses(content, make)}}`;
  return latex.slice(0, begin) + made + withClasses(latex.slice(end), make);
}

/** What is in the braces that open at a place, and where they have ended. @param {string} latex @param {number} at @returns {[string, number]} */
function groupAt(latex, at) {
  let [depth, end] = [0, at];
  do {
    if (latex[end] === "{") depth += 1;
    if (latex[end] === "}") depth -= 1;
    end += 1;
  } while (depth > 0 && end < latex.length);
  return [latex.slice(at + 1, end - 1), end];
}

/** Equal columns as equations beside each other, where that is less high. @param {readonly Part[]} parts */
function byRows(parts) {
  let split = false;
  return parts.flatMap((part) => {
    if (split && isEquivalent(part)) return [{ ...part, apart: true }];
    const [, one, other] = part.right.match(COLUMNS) ?? [];
    if (!one || part.left) return [part];
    const [left, right] = [one, other].map(entriesWithin);
    if (left.length !== right.length || left[0].length > 1 || right[0].length > 1) return [part];
    const rows = left.map(([entry], i) => ({ left: "", right: `${entry} = ${right[i][0]}`, gap: GAP }));
    const width = onceForAll(overReactions(rows, GAP)).reduce((sum, row) => sum + sizeOf(row.right).width + APART, 0);
    const { height, depth } = sizeOf(part.right);
    if (HIGH * Math.ceil(width / LINE) >= height + depth) return [part];
    split = true;
    return rows;
  });
}

/**
 * An equation with its coordinates, at most two, called qᵢ and qₖ; null where it has others, or something else of them.
 * @param {readonly Part[]} equation
 */
function general(equation) {
  /** @type {string[]} */
  const found = [];
  /** @type {string[]} */
  const symbols = [];
  let fits = !equation.some(isEquivalent);
  const make = (/** @type {string} */ names, /** @type {string} */ content) => {
    const [, number] = names.match(OF_COORDINATE) ?? [];
    if (!number) return null;
    const [, varied = "", dots, dotted, alone, index, power = ""] = content.match(COORDINATE) ?? [];
    if (!found.includes(number)) {
      found.push(number);
      symbols.push(`\\htmlClass{q-${number}}{${dotted ?? alone}${index}}`);
    }
    const place = found.indexOf(number);
    fits &&= place < ANY.length && (dotted ?? alone) !== undefined;
    return `${varied}${dots ?? ""}{q}_{${ANY[place]}}${power}`;
  };
  const parts = equation.map((part) => ({
    ...part,
    left: withClasses(part.left, make),
    right: withClasses(part.right, make),
  }));
  return fits && found.length
    ? { parts, symbols, key: parts.map(({ left, right }) => plain(left + right)).join("\n") }
    : null;
}

/** Where terms have come from is another thing for each coordinate. @param {Part} part @returns {Part} */
const withoutOrigins = ({ left, right, gap }) => {
  const freed = (/** @type {string} */ latex) => latex.replace(/ ?\bt(?:-\d+)+/g, "").replaceAll("\\htmlClass{}", "");
  return { left: freed(left), right: freed(right), gap };
};

/**
 * For which coordinates something holds; null where these are pairs, and not all that there are.
 * @param {readonly (readonly string[])[]} of  the coordinates of each instance @returns {Part | null}
 */
function remark(of) {
  const all = [...new Set(of.flat())];
  const pairs = of[0].length > 1;
  if (pairs && of.length !== (all.length * (all.length - 1)) / 2) return null;
  return { left: "", right: `\\quad (q_i${pairs ? ",\\, q_k" : ""} = ${listed(all)})`, gap: GAP };
}

/** Symbols that are counted through, from so many on, by the first and the last of them. @param {readonly string[]} symbols */
function listed(symbols) {
  const counted = symbols.map((symbol) => plain(symbol).match(/^(.*?) _ (\d+)$/) ?? []);
  const runs = counted.every(
    ([, letter, index], i) => letter === counted[0][1] && Number(index) === i + Number(counted[0][2]),
  );
  const shown = runs && symbols.length > MANY ? [symbols[0], "\\dots", symbols[symbols.length - 1]] : symbols;
  return shown.join(",\\, ");
}

/** Equations that are alike but for their coordinates, written once. @param {readonly Part[]} parts @returns {Part[]} */
function onceForAll(parts) {
  const equations = equationsOf([...parts]).map((equation) => ({ equation, form: general(equation) }));
  return equations.flatMap((one) => {
    const alike = one.form ? equations.filter(({ form }) => form?.key === one.form?.key) : [];
    const told = alike.length > 1 ? remark(alike.map(({ form }) => form?.symbols ?? [])) : null;
    if (!one.form || !told) return one.equation;
    return alike[0] === one ? [...one.form.parts.map(withoutOrigins), told] : [];
  });
}

/** Terms of a sum that are alike but for their coordinates, as a sum over these. @param {readonly Part[]} parts @returns {Part[]} */
function overAll(parts) {
  return parts.flatMap((part) => {
    /** @type {string[][] | null} */
    let found = null;
    const shorter = (/** @type {string} */ side) => {
      const sum = summed(side);
      if (!sum || (found && String(found) !== String(sum.of))) return side;
      found = sum.of;
      return sum.text;
    };
    const made = { ...part, left: shorter(part.left), right: shorter(part.right) };
    const told = found ? remark(found) : null;
    return told ? [made, { ...told, gap: part.gap || GAP }] : [made];
  });
}

/** One side of an equation whose sum has a run of terms that are alike. @param {string} side */
function summed(side) {
  const pieces = cut(side, joins).map((text) => {
    const [, relation, sign, term] = /** @type {RegExpMatchArray} */ (text.match(/^(\s*=?\s*)([+-]?)([\s\S]*)$/));
    const form = general([{ left: "", right: term, gap: "" }]);
    return { text, relation, sign, form, key: form ? `${sign || "+"} ${form.key}` : "" };
  });
  const first = pieces.findIndex(
    ({ key }, i) => key && pieces.slice(i, i + MANY).filter((next) => next.key === key).length === MANY,
  );
  if (first < 0) return null;
  const { relation, sign, form, key } = pieces[first];
  const rest = pieces.slice(first);
  const ends = rest.findIndex((piece) => piece.key !== key);
  const alike = ends < 0 ? rest : rest.slice(0, ends);
  const of = alike.map((piece) => piece.form?.symbols ?? []);
  if (of[0].length > 1 || !form) return null;
  const begin = pieces.slice(0, first).map(({ text }) => text);
  const end = rest.slice(alike.length).map(({ text }) => text);
  const sum = `${relation}${sign} \\sum\\nolimits_{i} ${withoutOrigins(form.parts[0]).right}`;
  return { text: [...begin, sum, ...end].join(""), of };
}

/** A remark is not repeated. @param {readonly Part[]} parts @returns {Part[]} */
function saidOnce(parts) {
  let last = "";
  return parts.filter(({ left, right }) => {
    if (left || !right.startsWith("\\quad (q_i")) return true;
    const again = right === last;
    last = right;
    return !again;
  });
}

/** The argument of a function, behind it: in its brackets or without, and what follows it. @param {readonly string[]} tokens */
function argumentOf(tokens) {
  const starts = Math.max(
    0,
    tokens.findIndex((token) => token.trim()),
  );
  const end = argumentEnd(tokens, starts);
  const argument = tokens
    .slice(starts, end)
    .join("")
    .replace(/^(?:\\left)?\(([\s\S]*?)(?:\\right)?\)$/, "$1");
  return { argument, rest: tokens.slice(end).join("") };
}

/** @param {readonly string[]} tokens @param {number} at @returns {number} */
function argumentEnd(tokens, at) {
  if (tokens[at] === "\\htmlClass") return closed(tokens, closed(tokens, at + 1));
  const end = closed(tokens, at);
  return tokens[end] === "_" ? closed(tokens, end + 1) : end;
}

/** Where what opens at a place has been closed, or the next place. @param {readonly string[]} tokens @param {number} at */
function closed(tokens, at) {
  let [depth, end] = [0, at];
  do {
    if (/^(?:[{([]|\\left)/.test(tokens[end])) depth += 1;
    if (/^(?:[})\]]|\\right)/.test(tokens[end])) depth -= 1;
    end += 1;
  } while (depth > 0 && end < tokens.length);
  return end;
}

/** sin and cos by one letter, with what they are of below it. @param {string} latex @param {Set<string>} used @returns {string} */
function inLetters(latex, used) {
  const at = latex.search(/\\(?:sin|cos)(?![a-zA-Z])/);
  if (at < 0) return latex;
  const name = /** @type {keyof typeof FUNCTIONS} */ (latex.slice(at, at + 4));
  const [, power = "", behind] = /** @type {RegExpMatchArray} */ (latex.slice(at + 4).match(/^(\^\{\d\})?([\s\S]*)$/));
  const { argument, rest } = argumentOf(tokensOf(behind));
  const short = weight(argument) <= NARROW && !/\\(?:sin|cos|frac|d?dot)/.test(argument) && argument.trim() !== "";
  if (short) used.add(name);
  const written = short ? `\\mathrm{${FUNCTIONS[name]}}_{${argument}}${power}` : latex.slice(at, at + 4) + power;
  return `${latex.slice(0, at)}${written}${inLetters(short ? rest : behind, used)}`;
}

/** @param {readonly Part[]} parts @returns {Part[]} */
function withLetters(parts) {
  const often = parts.reduce(
    (sum, { left, right }) => sum + (`${left} ${right}`.match(/\\(?:sin|cos)(?![a-zA-Z])/g) ?? []).length,
    0,
  );
  if (often < OFTEN) return [...parts];
  /** @type {Set<string>} */
  const used = new Set();
  const made = parts.map(({ left, right, gap, apart }) => ({
    apart,
    left: inLetters(left, used),
    right: inLetters(right, used),
    gap: gap || GAP,
  }));
  const told = Object.entries(FUNCTIONS).filter(([name]) => used.has(name));
  if (!told.length) return [...parts];
  const said = told.map(([name, letter]) => `\\mathrm{${letter}}_{\\alpha} = ${name}\\alpha`);
  return [...made, { left: "", right: said.join(",\\; "), gap: "" }];
}

/** The rows of a formula in shorthand: with all of it, and without letters for functions, which have to be explained. @param {readonly Part[]} parts @returns {Part[][]} */
export function abbreviated(parts) {
  const bare = parts.map((part) => ({ ...part, left: part.left.replace(ARGUMENTS, "") }));
  const shorter = saidOnce(overAll(onceForAll(overReactions(byRows(inBlocks(bare)), GAP))));
  return [withLetters(shorter), shorter];
}
