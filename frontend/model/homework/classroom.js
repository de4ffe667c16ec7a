/** The answers of a class: checked a few at a time, however many there are; what cannot be checked says so and spoils no other. */

import { ApiError } from "../api.js";
import { createStore } from "../store.js";
import { checksOf, earned, lackOf, mistakeOf, onceEach, targetOf } from "./grading.js";
import { BEYOND, PLAIN, readTable } from "./table.js";

/** @typedef {import("./grading.js").Result} Result */
/** @typedef {import("./grading.js").Target} Target */
/** @typedef {import("./progress.js").Verdict} Verdict */
/** @typedef {{name: string, total: number, done: number, running: boolean, notice: string, column: string, style: import("./table.js").Style, results: Result[]}} Class */

const AT_ONCE = 12;

/** @type {Class} */
const EMPTY = { name: "", total: 0, done: 0, running: false, notice: "", column: "", style: PLAIN, results: [] };

/** @param {{api: Pick<import("./state.js").Api, "post">, state: () => Pick<import("./state.js").State, "asked" | "assignment" | "sheet" | "entry">, say: (key: string) => string, questions: (reference: object) => Promise<string | null>}} around  `say` finds a sentence, `questions` makes a file for STACK */
export function createClassroom({ api, state, say, questions }) {
  const store = createStore(EMPTY);
  const { get, set } = store;
  let turn = 0;
  const lang = () => state().asked.place.lang;

  /** The tasks of each scene in the table, by the name of the scene. @param {readonly (Target | null)[]} targets */
  async function tasksOf(targets) {
    const references = new Map(targets.flatMap((target) => (target ? [[keyOf(target), target]] : [])));
    const asked = [...references].map(async ([key, { reference: { seed: _, ...reference } }]) => /** @type {const} */ ([key, await api.post("/tasks", { ...reference, lang: lang() }).catch((error) => said(error))]));
    return new Map(await Promise.all(asked));
  }

  /** Verdicts in order; a refusal belongs to the one check that caused it. @param {object[]} checks @returns {Promise<(Verdict | string)[]>} */
  async function verdicts(checks) {
    try {
      return (await api.post("/checks/batch", { checks, lang: lang() })).verdicts;
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      if (checks.length === 1 || error.failure.status === 0) return checks.map(() => said(error));
      const halves = [checks.slice(0, checks.length >> 1), checks.slice(checks.length >> 1)];
      return [...(await verdicts(halves[0])), ...(await verdicts(halves[1]))];
    }
  }

  /** @param {string} name @param {Uint8Array} bytes */
  async function grade(name, bytes) {
    const mine = (turn += 1);
    const table = readTable(bytes);
    const { rows, style } = table;
    const { column, notice } = lackOf(table);
    set({ ...EMPTY, name, total: rows.length, column, notice, style, running: !notice });
    if (notice) return;
    const { assignment, sheet, entry } = state();
    const targets = rows.map((row) => (BEYOND in row ? null : targetOf(row, assignment, String(entry?.reference.scene ?? ""))));
    const known = await tasksOf(targets);
    const checks = checksOf(rows, targets.map((target) => (target && taskOf(target, known) ? target : null)));
    const share = sheet?.followThrough ?? 0.5;
    /** @type {Result[]} */
    const all = [];
    for (let start = 0; start < rows.length && mine === turn; start += AT_ONCE) {
      const indices = rows.map((_, i) => i).slice(start, start + AT_ONCE);
      const some = indices.filter((i) => checks[i]);
      const found = await verdicts(some.map((i) => /** @type {object} */ (checks[i])));
      if (mine !== turn) return;
      all.push(...indices.map((i) => resultOf(rows[i], targets[i], some.includes(i) ? found[some.indexOf(i)] : say(BEYOND in rows[i] ? "homework.class-cells" : "homework.class-unknown"), known, share)));
      set({ results: onceEach(all), done: all.length });
    }
    if (mine === turn) set({ running: false });
  }

  return {
    get,
    subscribe: store.subscribe,
    grade,
    /** The tasks of the scene on the page as questions for Moodle; null if the server made none. */
    async stack() {
      const { seed: _, ...reference } = state().entry?.reference ?? {};
      const file = await questions(reference);
      set({ notice: file ? "" : "homework.class-no-questions", column: "" });
      return file;
    },
    stop() {
      turn += 1;
      set({ running: false });
    },
  };
}

/** @param {Target} target */
const keyOf = ({ reference: { seed: _, ...reference } }) => JSON.stringify(reference);

/** @param {Target} target @param {Map<string, any>} known */
const taskOf = (target, known) => known.get(keyOf(target))?.tasks?.find((/** @type {any} */ one) => one.id === target.task);

/** @param {unknown} error */
function said(error) {
  if (!(error instanceof ApiError)) throw error;
  const { problems, detail, title } = error.failure;
  return problems[0]?.message || detail || title || "–";
}

/**
 * @param {import("./grading.js").Row} row @param {Target | null} target @param {Verdict | string} found  a sentence where there is no verdict
 * @param {Map<string, any>} known @param {number} share @returns {Result}
 */
function resultOf(row, target, found, known, share) {
  const scene = target && known.get(keyOf(target));
  const task = target && taskOf(target, known);
  const of = target?.points ?? task?.points ?? 0;
  const about = { student: row.student ?? "", scene: scene?.scene?.id ?? row.scene ?? "", task: target?.task ?? row.task, title: task?.title ?? target?.task ?? row.task, of, answer: row.answer };
  if (typeof found === "string") return { ...about, outcome: "invalid", misconception: "", mistake: "invalid", points: 0, understood_as: "", feedback: typeof scene === "string" ? scene : found };
  const misconception = mistakeOf(found);
  return {
    ...about, outcome: found.outcome, misconception: misconception === found.outcome ? "" : misconception, mistake: found.misconceptions[0]?.title ?? misconception,
    points: earned(found, of, share), understood_as: found.understood_as, feedback: found.feedback,
  };
}

/** @typedef {ReturnType<typeof createClassroom>} Classroom */
