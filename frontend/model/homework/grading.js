/** A table of answers becomes checks, and verdicts become results: one row for each answer, in order. */

import { referenceIn } from "./sheet.js";

/** @typedef {import("./sheet.js").Assignment} Assignment */
/** @typedef {import("./progress.js").Verdict} Verdict */
/** @typedef {Record<string, string>} Row */
/** @typedef {{reference: Record<string, unknown>, task: string, points: number | null}} Target */
/**
 * @typedef {object} Result
 * @property {string} student
 * @property {string} scene
 * @property {string} task
 * @property {string} title  of the task
 * @property {string} outcome
 * @property {string} misconception  its id, the kind of slip, or ""
 * @property {string} mistake  the same in words
 * @property {number} points
 * @property {number} of
 * @property {string} understood_as
 * @property {string} feedback
 * @property {string} answer
 */

export const COLUMNS = ["student", "scene", "task", "outcome", "misconception", "points", "of", "understood_as", "feedback", "answer"];
const NEEDED = ["task", "answer"];
export const SLIPS = ["sign", "missing", "half", "double"];
const MOST_LINES = 24;
const CARRIED = 64;

/** What keeps a table from being graded, the key of a sentence and a column's name. @param {import("./table.js").Table} table */
export function lackOf({ header, rows }) {
  const column = NEEDED.find((name) => !header.includes(name)) ?? "";
  return { column, notice: column ? "homework.class-column" : rows.length ? "" : "homework.class-empty" };
}

/**
 * Which task a row answers: by its number or id in the assignment, else by scene and id.
 * @param {Row} row @param {Assignment | null} assignment @param {string} scene  where the table names none
 * @returns {Target | null}
 */
export function targetOf(row, assignment, scene) {
  const name = row.task.trim();
  const seed = row.seed?.trim() || (assignment?.individual ? row.student?.trim() : "") || "";
  if (!assignment) return { reference: { scene: row.scene?.trim() || scene, ...(seed ? { seed } : {}) }, task: name, points: null };
  const index = /^\d+$/.test(name) ? Number(name) - 1 : assignment.tasks.findIndex(({ task }) => task === name);
  const entry = assignment.tasks[index];
  return entry ? { reference: { ...referenceIn(assignment, index, ""), ...(seed ? { seed } : {}) }, task: String(entry.task), points: entry.points ?? null } : null;
}

/** @param {Row} row */
const answerOf = ({ answer, syntax }) => ({ syntax: syntax?.trim().toLowerCase() || "plain", value: answer });

/** The order of a row within a working: the column `line`, if there is one. @param {Row} row */
const lineOf = ({ line }) => Number(line) || 0;

/**
 * The check of each row. Where the table has a column `line`, the rows of one student on one scene are a working, and
 * each is checked in the light of those before it.
 * @param {readonly Row[]} rows @param {readonly (Target | null)[]} targets
 */
export function checksOf(rows, targets) {
  const working = rows.some((row) => "line" in row);
  return rows.map((row, index) => {
    const target = targets[index];
    if (!target) return null;
    const before = working ? rows.flatMap((other, i) => (other.student === row.student && lineOf(other) < lineOf(row) && sameScene(targets[i], target) ? [i] : [])) : [];
    const previous = before.sort((a, b) => lineOf(rows[a]) - lineOf(rows[b])).slice(-MOST_LINES).map((i) => ({ task: targets[i]?.task ?? "", answer: answerOf(rows[i]) }));
    return { ...target.reference, task: target.task, answer: answerOf(row), ...(previous.length ? { previous } : {}) };
  });
}

/** @param {Target | null} a @param {Target} b */
const sameScene = (a, b) => a !== null && JSON.stringify(a.reference) === JSON.stringify(b.reference);

/** What went wrong, as a short name. @param {Verdict} verdict */
export const mistakeOf = ({ misconception, slip, outcome }) => misconception ?? (slip ? `slip:${slip}` : outcome === "correct" || outcome === "follow_through" ? "" : outcome);

/** @param {Pick<Verdict, "outcome" | "remark">} verdict @param {number} of @param {number} share  for what follows from a wrong line */
export const earned = ({ outcome, remark }, of, share) => (outcome === "correct" ? of : outcome === "follow_through" && remark !== "repeated" ? share * of : 0);

/**
 * A task earns its points once, however often a student answers it.
 * @param {readonly Result[]} results @returns {Result[]}
 */
export function onceEach(results) {
  /** @type {Map<string, number>} */
  const most = new Map();
  return results.map((result) => {
    const key = JSON.stringify([result.student, result.scene, result.task]);
    const before = result.student ? (most.get(key) ?? 0) : 0;
    most.set(key, Math.max(before, result.points));
    return { ...result, points: Math.max(0, result.points - before) };
  });
}

/**
 * By task, in the order of the table: how many of each outcome, and the mistakes, the most frequent first.
 * @param {readonly Result[]} results
 */
export function summaryOf(results) {
  /** @type {Map<string, Result[]>} */
  const tasks = new Map();
  for (const result of results) {
    const key = `${result.scene} ${result.task}`;
    tasks.set(key, [...(tasks.get(key) ?? []), result]);
  }
  return [...tasks.values()].map((own) => ({
    scene: own[0].scene, task: own[0].task, title: own[0].title, count: own.length,
    outcomes: tally(own, ({ outcome }) => outcome).map(({ name, all }) => ({ outcome: name, count: all.length })),
    mistakes: tally(own.filter(({ mistake }) => mistake), ({ mistake }) => mistake).sort((a, b) => b.all.length - a.all.length)
      .map(({ name, all }) => ({ mistake: name, count: all.length, students: all.map(({ student }) => student).filter(Boolean).slice(0, CARRIED) })),
  }));
}

/** @param {readonly Result[]} results @param {(result: Result) => string} of */
function tally(results, of) {
  return [...new Set(results.map(of))].map((name) => ({ name, all: results.filter((result) => of(result) === name) }));
}
