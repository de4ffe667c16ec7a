/** The tasks on the page: those of a scene, or those of an assignment that was opened. */

import { asWritten } from "../own.js";

/** @typedef {import("../types.js").Scene} Scene */
/** @typedef {import("../types.js").Contract} Contract */
/** @typedef {Contract["TaskSymbol"]} TaskSymbol */
/** @typedef {Contract["TaskEntry"]} Task */
/** @typedef {Pick<Contract["TasksRequest"], "scene" | "guides" | "freeze" | "parameters" | "seed" | "vary">} Reference  what requests say of the scene */
/** @typedef {{id: string, key: string, group: string, reference: Reference, scene: Scene, symbols: TaskSymbol[], task: Task}} Entry  a task with its scene; `id` stands in addresses, `group` names the scene with its changes */
/** @typedef {{title: Record<string, string> | null, followThrough: number, simplified: number, code: string, entries: Entry[], recalled?: string | null}} Sheet  `code` is that of an assignment, `recalled` the misconception that an exercise brings back */
/** @typedef {Contract["AssignmentDocument"]} Assignment */

const CHANGES = /** @type {const} */ (["scene", "guides", "freeze", "parameters"]);

/** A short name for what is no name; the same content has the same one. @param {unknown} value */
function digest(value) {
  let hash = 5381;
  for (const letter of JSON.stringify(value)) hash = (Math.imul(hash, 33) ^ letter.charCodeAt(0)) >>> 0;
  return hash.toString(36);
}

/** @param {Reference} reference */
export function groupOf({ scene, seed, ...changes }) {
  const name = typeof scene === "string" ? scene : `own~${digest(scene)}`;
  return [name, ...(Object.keys(changes).length ? [digest(changes)] : []), ...(seed ? [String(seed)] : [])].join("@");
}

/** @param {Contract["Scene"]} scene  by its id, or as a document @param {string} seed @returns {Reference} */
export const referenceOf = (scene, seed) => (seed ? { scene, seed } : { scene });

/** @param {Reference} reference @param {Contract["TaskList"]} answer @returns {Sheet} */
export function sheetOfScene(reference, { scene: document, symbols, tasks }) {
  const [group, scene] = [groupOf(reference), asWritten(document)];
  return {
    title: null,
    followThrough: 0.5,
    simplified: 0.5,
    code: "",
    entries: tasks.map((task) => ({ id: task.id, key: `${group}/${task.id}`, group, reference, scene, symbols, task })),
  };
}

/**
 * @param {Assignment} assignment @param {string} seed @param {Contract["AssignmentAnswer"]} answer
 * @returns {Sheet}
 */
export function sheetOfAssignment(assignment, seed, answer) {
  const entries = answer.tasks.map(({ scene, symbols, task }, index) => {
    const reference = referenceIn(assignment, index, seed);
    const group = groupOf(reference);
    return {
      id: String(index + 1),
      key: `${group}/${task.id}`,
      group,
      reference,
      scene: asWritten(scene),
      symbols,
      task,
    };
  });
  const { title, follow_through: followThrough, simplified, code } = answer;
  return { title, followThrough, simplified, code, entries };
}

/** An exercise drawn at random: one task about a system that is in no menu. @param {string} group @param {Contract["PracticeAnswer"]} answer @returns {Sheet} */
export function sheetOfExercise(group, { scene: document, symbols, task, recalled }) {
  const [key, scene, reference] = [`${group}/${task.id}`, asWritten(document), referenceOf(document, "")];
  const entry = { id: task.id, key, group, reference, scene, symbols, task };
  return { title: null, followThrough: 0.5, simplified: 0.5, code: "", entries: [entry], recalled };
}

/** What requests say of the scene of an assignment's task. @param {Assignment} assignment @param {number} index @param {string} seed @returns {Reference} */
export function referenceIn(assignment, index, seed) {
  const given = assignment.tasks[index];
  const own = /** @type {Reference} */ (
    Object.fromEntries(CHANGES.filter((name) => given[name] != null).map((name) => [name, given[name]]))
  );
  if (!assignment.individual || !seed) return own;
  return assignment.vary ? { ...own, seed, vary: assignment.vary } : { ...own, seed };
}

/** Whether it is the library's scene as it is, so that its own page shows the same. @param {Reference} reference */
export const isPlain = ({ scene, guides, freeze, vary }) => typeof scene === "string" && !guides && !freeze && !vary;

/**
 * Points earned and to be had; a task whose solution was looked at before earns none.
 * @param {Sheet} sheet @param {(key: string) => import("./progress.js").Draft} draft
 */
export function pointsOf({ entries }, draft) {
  const earned = entries.filter(({ key }) => draft(key).solved && !draft(key).shown);
  const sum = (/** @type {Entry[]} */ some) => some.reduce((total, { task }) => total + task.points, 0);
  return {
    earned: sum(earned),
    of: sum(entries),
    solved: entries.filter(({ key }) => draft(key).solved).length,
    count: entries.length,
  };
}
