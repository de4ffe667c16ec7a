/** Long tables, a page at a time: which rows, in which order. */

/** @typedef {import("./classroom.js").StudentTotals} Student */
/** @typedef {import("./classroom.js").Row} Row */
/** @typedef {"" | "late" | "beyond" | "unread" | "missing"} Only */
/** @typedef {{by: "student" | "points" | number, down: boolean, text: string, only: Only, page: number}} Order  a number is that of a task */
/** @typedef {{text: string, outcome: string, task: string, mistake: string, page: number}} Wanted */

export const STUDENTS = 50;
/** Answers are longer than a row. */
export const ANSWERS = 25;
/** @type {Only[]} */
export const ONLY = ["", "late", "beyond", "unread", "missing"];
/** @type {Order} */
export const USUAL = { by: "student", down: false, text: "", only: "", page: 0 };
/** @type {Wanted} */
export const ALL = { text: "", outcome: "", task: "", mistake: "", page: 0 };

/** @param {string} text @param {string[]} words */
const holds = (text, ...words) => {
  const wanted = text.trim().toLowerCase();
  return !wanted || words.some((word) => word.toLowerCase().includes(wanted));
};

/** @type {Record<Only, (student: Student) => boolean>} */
const KINDS = {
  "": () => true,
  late: ({ late }) => late > 0,
  beyond: ({ beyond }) => beyond > 0,
  unread: ({ answers }) => answers.some((answer) => answer?.outcome === "invalid" || answer?.outcome === "undecided"),
  missing: ({ answers }) => answers.includes(null),
};

/** The students as they are wanted, in their order. @param {readonly Student[]} students @param {Order} order @param {string} lang */
export function arranged(students, { by, down, text, only }, lang) {
  const names = new Intl.Collator(lang, { numeric: true });
  const value = (/** @type {Student} */ one) =>
    by === "points" ? one.points : by === "student" ? 0 : (one.answers[by]?.points ?? -1);
  const turned = down ? -1 : 1;
  return students
    .filter((one) => KINDS[only](one) && holds(text, one.student, one.id))
    .sort((a, b) => turned * (value(a) - value(b) || (by === "student" ? names.compare(a.student, b.student) : 0)));
}

/** The answers that are wanted, in the order of the table. @param {readonly Row[]} rows @param {Wanted} wanted */
export function chosen(rows, { text, outcome, task, mistake }) {
  return rows
    .filter(
      (row) =>
        (!outcome || row.outcome === outcome) &&
        (!task || keyOf(row) === task) &&
        (!mistake || row.mistake === mistake) &&
        holds(text, row.student, row.id, row.answer, row.file),
    )
    .sort((a, b) => a.index - b.index);
}

/** What names a task among those of several scenes. @param {{scene: string, task: string}} one */
export const keyOf = ({ scene, task }) => `${scene}/${task}`;

/** A page of a list; the last one if there are not so many. @template T @param {readonly T[]} list @param {number} wanted @param {number} size */
export function paged(list, wanted, size) {
  const pages = Math.max(1, Math.ceil(list.length / size));
  const page = Math.min(wanted, pages - 1);
  const first = page * size;
  return { rows: list.slice(first, first + size), page, pages, first, count: list.length };
}
