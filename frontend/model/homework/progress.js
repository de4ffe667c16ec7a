/** What a student has written, kept in the browser at every keystroke: one record for each task. */

import { tableOf } from "../own.js";

/** @typedef {import("./answer.js").Syntax} Syntax */
/** @typedef {{getItem: (key: string) => string | null, setItem: (key: string, value: string) => void, key: (index: number) => string | null, readonly length: number}} Keeper */
/** @typedef {import("../types.js").Contract["VerdictProblem"]} AnswerProblem */
/** @typedef {import("../types.js").Contract["VerdictAnswer"]} Verdict */
/** @typedef {import("../types.js").Contract["PossibleReading"]} PossibleReading */
/** @typedef {{verdict: Verdict, syntax: Syntax, value: string, lang: string}} Checked  the last verdict and what it is about */
/**
 * @typedef {object} Draft
 * @property {Syntax} syntax
 * @property {Record<Syntax, string[]>} texts  a text for each part; both syntaxes are kept
 * @property {{from: Syntax, texts: string[]} | null} converted  the text that was made from the other syntax
 * @property {Checked | null} checked
 * @property {number} tries
 * @property {number} hints  how many are open
 * @property {boolean} solved
 * @property {boolean} shown  whether the solution was looked at before
 */
/** @typedef {{task: string, syntax: Syntax, value: string}} Line */

const PREFIX = "deltaq.homework.1/";
const FORMAT = "deltaq-homework-1";
const LARGEST = 2_000_000;

/** @type {Draft} */
export const BLANK = {
  syntax: "latex",
  texts: { plain: [], latex: [] },
  converted: null,
  checked: null,
  tries: 0,
  hints: 0,
  solved: false,
  shown: false,
};

/** @param {unknown} value @returns {string[]} */
const texts = (value) => (Array.isArray(value) ? value.filter((one) => typeof one === "string") : []);
/** @param {unknown} value @returns {Syntax} */
const syntaxOf = (value) => (value === "plain" ? "plain" : "latex");

/** A draft out of anything that was kept; what is missing or broken is as in a blank one. @param {unknown} value @returns {Draft} */
export function draftOf(value) {
  const kept = tableOf(value) ?? {};
  const [checked, written, converted] = [kept.checked, kept.texts, kept.converted].map(tableOf);
  const number = (/** @type {unknown} */ n) => (Number.isInteger(n) ? Math.max(0, Number(n)) : 0);
  return {
    syntax: syntaxOf(kept.syntax),
    texts: { plain: texts(written?.plain), latex: texts(written?.latex) },
    converted: converted && { from: syntaxOf(converted.from), texts: texts(converted.texts) },
    checked: checked && typeof tableOf(checked.verdict)?.outcome === "string" ? /** @type {Checked} */ (checked) : null,
    tries: number(kept.tries),
    hints: Math.min(3, number(kept.hints)),
    solved: kept.solved === true,
    shown: kept.shown === true,
  };
}

/** @param {unknown} value @returns {Line[]} */
export const linesOf = (value) =>
  Array.isArray(value)
    ? value.flatMap((line) => {
        const { task, syntax, value } = tableOf(line) ?? {};
        return typeof value === "string" && typeof task === "string" ? [{ task, syntax: syntaxOf(syntax), value }] : [];
      })
    : [];

/**
 * What is written to exercises without end lasts as long as the window; all else is kept, and is what there is to save.
 * @param {Keeper} lasting @param {Keeper} window @returns {Keeper}
 */
export const apart = (lasting, window) => {
  const of = (/** @type {string} */ key) => (key.startsWith(`${PREFIX}practice~`) ? window : lasting);
  return {
    get length() {
      return lasting.length;
    },
    key: (index) => lasting.key(index),
    getItem: (key) => of(key).getItem(key),
    setItem: (key, value) => of(key).setItem(key, value),
  };
};

/** @param {Keeper} keeper */
export function createProgress(keeper) {
  /** @param {string} key @returns {unknown} */
  function read(key) {
    try {
      return JSON.parse(keeper.getItem(PREFIX + key) ?? "null");
    } catch {
      return null;
    }
  }

  /** False where the browser keeps nothing. @param {string} key @param {unknown} value */
  function write(key, value) {
    try {
      keeper.setItem(PREFIX + key, JSON.stringify(value));
      return true;
    } catch {
      return false;
    }
  }

  function keys() {
    try {
      return Array.from({ length: keeper.length }, (_, i) => keeper.key(i) ?? "")
        .filter((key) => key.startsWith(PREFIX))
        .map((key) => key.slice(PREFIX.length))
        .sort();
    } catch {
      return [];
    }
  }

  return {
    /** @param {string} key */
    draft: (key) => draftOf(read(key)),
    /** @param {string} key */
    lines: (key) => linesOf(read(key)),
    /** Who hands in. @param {string} key @returns {{name: string, id: string}} */
    who(key) {
      const { name, id } = tableOf(read(key)) ?? {};
      return { name: typeof name === "string" ? name : "", id: typeof id === "string" ? id : "" };
    },
    write,
    /** All records as a file's text. */
    exported: () =>
      JSON.stringify({ format: FORMAT, records: Object.fromEntries(keys().map((key) => [key, read(key)])) }, null, 1),
    /** Takes a file's records over those of the same name; how many, or null if the file is none. @param {string} text @returns {number | null} */
    imported(text) {
      if (text.length > LARGEST) return null;
      try {
        const file = tableOf(JSON.parse(text));
        const records = file?.format === FORMAT ? tableOf(file.records) : null;
        return records && Object.entries(records).filter(([key, value]) => write(key, value)).length;
      } catch {
        return null;
      }
    },
  };
}

/** @typedef {ReturnType<typeof createProgress>} Progress */
