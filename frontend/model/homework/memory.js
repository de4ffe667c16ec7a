/** What practice remembers in the browser: the level, what went wrong, and when it comes back by FSRS. Nothing leaves it. */

import { createEmptyCard, fsrs, Rating, State } from "ts-fsrs";
import { tableOf } from "../own.js";
import { LEVELS } from "./place.js";

/** @typedef {import("ts-fsrs").Card} Card */
/** @typedef {{id: string, kind: string, level: number, card: Card}} Lesson  a misconception, and the kind of task and the level in which it was last seen */
/** @typedef {import("./place.js").Drill} Drill */
/**
 * @typedef {object} Open  the exercise at hand
 * @property {Drill} drill
 * @property {string[]} named  the misconceptions that it was got wrong by
 * @property {boolean} done  whether it was solved, or its solution shown: each counts once
 */
/**
 * @typedef {object} Memory
 * @property {string} series  the seed of this browser's exercises
 * @property {number} count  how many there have been
 * @property {number} level
 * @property {number} solved  on this level
 * @property {Lesson[]} lessons
 * @property {Open | null} open
 */

export const KEY = "deltaq.practice.1";
/** Exercises of a level that lead to the next one. */
export const ENOUGH = 3;
/** No more than there are misconceptions by far. */
const MOST_LESSONS = 200;
const LONGEST = 64;
const scheduler = fsrs({ enable_fuzz: false });

/** @param {() => number} random @returns {Memory} */
export const blank = (random) => ({
  series: random().toString(36).slice(2, 10) || "0",
  ...{ count: 0, level: 1, solved: 0, lessons: [], open: null },
});

/** What was kept, as far as it can be read; what is broken is as if it had never been. @param {string | null} text @param {() => number} random @returns {Memory} */
export function readMemory(text, random) {
  const kept = parsed(text);
  const fresh = blank(random);
  if (kept?.format !== 1) return fresh;
  const lessons = (Array.isArray(kept.lessons) ? kept.lessons : []).flatMap(lessonOf);
  const level = levelOf(kept.level);
  return {
    series: name(kept.series) || fresh.series,
    count: whole(kept.count),
    level,
    solved: Math.min(ENOUGH - 1, whole(kept.solved)),
    lessons: lessons.filter((one, i) => lessons.findIndex(({ id }) => id === one.id) === i).slice(0, MOST_LESSONS),
    open: openOf(kept.open),
  };
}

/** @param {Memory} memory */
export const written = (memory) => JSON.stringify({ format: 1, ...memory });

/** @param {string | null} text */
function parsed(text) {
  try {
    return tableOf(JSON.parse(text ?? "null"));
  } catch {
    return null;
  }
}

/** @param {unknown} value */
const name = (value) => (typeof value === "string" && /^[\w:-]{1,64}$/.test(value) ? value.slice(0, LONGEST) : "");
/** @param {unknown} value */
const whole = (value) => (Number.isSafeInteger(value) && Number(value) > 0 ? Number(value) : 0);
/** @param {unknown} value */
const size = (value) => typeof value === "number" && Number.isFinite(value) && value >= 0;
/** @param {unknown} value */
const levelOf = (value) => LEVELS.find((one) => one === value) ?? 1;

/** @param {unknown} value @returns {Lesson[]} */
function lessonOf(value) {
  const table = tableOf(value);
  const card = cardOf(table?.card);
  const id = name(table?.id);
  return id && card ? [{ id, kind: name(table?.kind), level: levelOf(table?.level), card }] : [];
}

const STATES = [State.New, State.Learning, State.Review, State.Relearning].map(Number);
const NUMBERS = ["stability", "difficulty", "elapsed_days", "scheduled_days", "learning_steps", "reps", "lapses"];

/** @param {unknown} value @returns {Card | null} */
function cardOf(value) {
  const table = tableOf(value);
  if (!table || !NUMBERS.every((key) => size(table[key])) || !STATES.some((one) => one === table.state)) return null;
  const [due, last] = [table.due, table.last_review].map(dateOf);
  if (!due || (table.state !== State.New && !last)) return null;
  const numbers = Object.fromEntries([...NUMBERS, "state"].map((key) => [key, table[key]]));
  return /** @type {Card} */ ({ ...numbers, due, ...(last ? { last_review: last } : {}) });
}

/** @param {unknown} value */
function dateOf(value) {
  const date = new Date(typeof value === "string" ? value : NaN);
  return Number.isNaN(date.getTime()) ? null : date;
}

/** @param {unknown} value @returns {Open | null} */
function openOf(value) {
  const table = tableOf(value);
  const drill = tableOf(table?.drill);
  const [series, number] = [name(drill?.series), whole(drill?.number)];
  if (!table || !drill || !series || !number) return null;
  const named = (Array.isArray(table.named) ? table.named : []).map(name).filter(Boolean);
  const { level, recall, kind } = drill;
  return {
    drill: { series, number, level: levelOf(level), recall: name(recall), kind: name(kind) },
    named,
    done: table.done === true,
  };
}

/** What is due, the longest first. @param {Memory} memory @param {Date} now */
export const due = ({ lessons }, now) =>
  lessons.filter(({ card }) => card.due <= now).sort((a, b) => a.card.due.getTime() - b.card.due.getTime());

/** All that comes back, the soonest first. @param {Memory} memory */
export const ahead = ({ lessons }) => [...lessons].sort((a, b) => a.card.due.getTime() - b.card.due.getTime());

/**
 * The next exercise: what is due comes first, on a new system. A misconception that was to come back and was passed
 * over unanswered counts as not known.
 * @param {Memory} memory @param {Date} now @returns {Memory}
 */
export function onward(memory, now) {
  const { open } = memory;
  const passed = open && !open.done && open.drill.recall && !open.named.includes(open.drill.recall);
  const left = passed ? rated(memory, open.drill.recall, Rating.Again, now) : memory;
  const [lesson] = due(left, now);
  const drill = {
    series: left.series,
    number: left.count + 1,
    level: lesson ? Math.min(lesson.level, left.level) : left.level,
    recall: lesson?.id ?? "",
    kind: lesson?.kind ?? "",
  };
  return { ...left, count: drill.number, open: { drill, named: [], done: false } };
}

/**
 * The exercise that an address names, perhaps another one than the last; one that is `over` does not count again.
 * @param {Memory} memory @param {Drill} drill @param {boolean} over @returns {Memory}
 */
export const opened = (memory, drill, over) =>
  memory.open && isSame(memory.open.drill, drill)
    ? memory
    : { ...memory, count: Math.max(memory.count, drill.number), open: { drill, named: [], done: over } };

/** @param {Drill} a @param {Drill} b */
const isSame = (a, b) => a.series === b.series && a.number === b.number && a.level === b.level;

/**
 * A wrong answer that names a misconception: it is a lesson from now on, or one that was not known. Once an exercise.
 * @param {Memory} memory @param {string} id @param {string} kind of task @param {number} level @param {Date} now @returns {Memory}
 */
export function wrong(memory, id, kind, level, now) {
  const { open } = memory;
  if (!open || open.named.includes(id)) return memory;
  const known = memory.lessons.find((one) => one.id === id) ?? { id, kind, level, card: createEmptyCard(now) };
  const others = memory.lessons.filter((one) => one.id !== id);
  const next = {
    ...memory,
    lessons: [...others, { ...known, kind, level }],
    open: { ...open, named: [...open.named, id] },
  };
  return rated(next, id, Rating.Again, now);
}

/**
 * A right answer. Three of a level lead to the next one. What came back is known well where the first answer was right
 * without a hint, else with difficulty; where it was made again, that stands.
 * @param {Memory} memory @param {{tries: number, hints: number}} how @param {Date} now @returns {Memory}
 */
export function solved(memory, { tries, hints }, now) {
  const { open } = memory;
  if (!open || open.done) return memory;
  const { recall, level } = open.drill;
  const done = { ...memory, open: { ...open, done: true } };
  const easily = tries <= 1 && hints === 0;
  const known =
    recall && !open.named.includes(recall) ? rated(done, recall, easily ? Rating.Good : Rating.Hard, now) : done;
  return level < memory.level ? known : risen(known);
}

/** The solution was looked at: the exercise does not count, and what was to come back is not known. @param {Memory} memory @param {Date} now @returns {Memory} */
export function shown(memory, now) {
  const { open } = memory;
  if (!open || open.done) return memory;
  const { recall } = open.drill;
  const done = { ...memory, open: { ...open, done: true } };
  return recall && !open.named.includes(recall) ? rated(done, recall, Rating.Again, now) : done;
}

/** No system could be found that a misconception can be made on: it cannot come back. @param {Memory} memory @returns {Memory} */
export function dropped(memory) {
  const { open } = memory;
  if (!open?.drill.recall) return memory;
  const lessons = memory.lessons.filter(({ id }) => id !== open.drill.recall);
  return { ...memory, lessons, open: { ...open, drill: { ...open.drill, recall: "" } } };
}

/** @param {Memory} memory @returns {Memory} */
function risen(memory) {
  const rises = memory.solved + 1 >= ENOUGH && memory.level < LEVELS.length;
  return rises
    ? { ...memory, level: memory.level + 1, solved: 0 }
    : { ...memory, solved: Math.min(ENOUGH - 1, memory.solved + 1) };
}

/** @param {Memory} memory @param {number} level @returns {Memory} */
export const atLevel = (memory, level) => ({ ...memory, level, solved: 0 });

/** @param {Memory} memory @param {string} id @param {import("ts-fsrs").Grade} rating @param {Date} now @returns {Memory} */
function rated(memory, id, rating, now) {
  const lessons = memory.lessons.map((one) =>
    one.id === id ? { ...one, card: scheduler.next(one.card, now, rating).card } : one,
  );
  return { ...memory, lessons };
}
