/**
 * The answers of a class: the file goes to the server, which marks it; its rows and totals are shown as they come. What
 * counts and what follows from what is decided there alone.
 */

import { ApiError } from "../api.js";
import { EVENTS, ask, eventsOf } from "../labs/stream.js";
import { createStore } from "../store.js";
import { gathered } from "./handin.js";
import { patient } from "./patience.js";
import { ALL, USUAL } from "./roster.js";

/** @typedef {import("../types.js").Contract} Contract */
/** @typedef {Contract["GradedRow"]} Row  an answer, marked */
/** @typedef {Row["outcome"]} Outcome */
/** @typedef {Contract["TaskTotals"]} TaskTotals */
/** @typedef {Contract["StudentTotals"]} StudentTotals */
/** @typedef {Pick<Contract["TableAnswer"], "points" | "of" | "tasks" | "students" | "mistakes">} Totals */
/** @typedef {Contract["RefusedFile"]} Refused */
/**
 * What is heard while a table is marked.
 * @typedef {{begun: {rows: number}, refused: {files: Refused[]}, row: Row, totals: Totals, waiting: {seconds: number}, result: Contract["TableAnswer"]}} Heard
 * @typedef {import("../labs/stream.js").Events<Heard>} TableEvent
 */
/**
 * @typedef {object} Class
 * @property {string} name  of the file
 * @property {boolean} running
 * @property {number} waiting  seconds until the server goes on
 * @property {number} total  how many answers there are
 * @property {Row[]} rows  those that are marked, in the order in which they were
 * @property {Totals} totals
 * @property {Refused[]} refused  files that could not be taken, and why
 * @property {string | null} csv  the table of results, once all is marked
 * @property {{moodle: string, canvas: string}} platforms  the points as these import them; empty without an assignment
 * @property {import("../types.js").Failure | null} failure
 * @property {string} notice  the key of a sentence
 * @property {boolean} looked  whether the list of all answers is open
 * @property {import("./roster.js").Order} order  of the students
 * @property {import("./roster.js").Wanted} wanted  answers
 */

/** @type {Class} */
const EMPTY = {
  name: "",
  running: false,
  waiting: 0,
  total: 0,
  rows: [],
  totals: { points: 0, of: 0, tasks: [], students: [], mistakes: [] },
  refused: [],
  csv: null,
  platforms: { moodle: "", canvas: "" },
  failure: null,
  notice: "",
  looked: false,
  order: USUAL,
  wanted: ALL,
};
/** Bytes of a piece; a multiple of three, so that only the last one is filled up. */
const PIECE = 6000;

/** The bytes of a file in base64 (RFC 4648 §4), in pieces that the server takes: a single text may not be long. @param {Uint8Array} bytes */
export const base64 = (bytes) =>
  Array.from({ length: Math.max(1, Math.ceil(bytes.length / PIECE)) }, (_, n) =>
    btoa(String.fromCharCode(...bytes.subarray(n * PIECE, (n + 1) * PIECE))),
  );

/** What is known of a class after some more events. @param {Class} known @param {readonly TableEvent[]} events @returns {Class} */
export function heard(known, events) {
  const [result] = of(events, "result");
  const { points, of: most, tasks, students, mistakes } = result ?? of(events, "totals").at(-1) ?? known.totals;
  const last = events.at(-1);
  return {
    ...known,
    totals: { points, of: most, tasks, students, mistakes: mistakes ?? [] },
    refused: [...known.refused, ...of(events, "refused").flatMap(({ files }) => files)],
    csv: result?.csv ?? known.csv,
    platforms: result ? { moodle: result.moodle ?? "", canvas: result.canvas ?? "" } : known.platforms,
    total: of(events, "begun")[0]?.rows ?? known.total,
    rows: [...known.rows, ...of(events, "row")],
    waiting: last ? (last.kind === "waiting" ? last.data.seconds : 0) : known.waiting,
  };
}

/** What the events of a kind say. @template {keyof Heard} K @param {readonly TableEvent[]} events @param {K} kind */
const of = (events, kind) => events.flatMap((one) => (one.kind === kind ? [/** @type {Heard[K]} */ (one.data)] : []));

/** @param {{send: typeof fetch, state: () => Pick<import("./state.js").State, "asked" | "assignment" | "entry">, questions: (reference: Contract["StackRequest"]) => Promise<string | null>}} around  `questions` makes a file for STACK */
export function createClassroom({ send, state, questions }) {
  const store = createStore(EMPTY);
  const { get, set } = store;
  const begin = patient((/** @type {Contract["TableRequest"]} */ body, /** @type {AbortSignal} */ signal) =>
    ask(send, "/checks/table", body, { accept: EVENTS }, signal),
  );
  let marking = new AbortController();
  let again = () => {};

  /** @param {Uint8Array} bytes @returns {Contract["TableRequest"]} */
  function question(bytes) {
    const { asked, assignment, entry } = state();
    const around = assignment ? { assignment } : entry ? { scene: entry.reference.scene } : {};
    return { table: base64(bytes), encoding: "base64", ...around, lang: asked.place.lang };
  }

  /** @param {string} name @param {Uint8Array} bytes @param {Refused[]} [refused]  what could not even be sent */
  async function grade(name, bytes, refused = []) {
    marking.abort();
    const { signal } = (marking = new AbortController());
    again = () => void grade(name, bytes, refused);
    set({ ...EMPTY, name, refused, running: true, looked: get().looked });
    const failure = await marked(question(bytes), signal).catch((error) => failureIn(error, signal));
    if (!signal.aborted) set({ running: false, waiting: 0, failure });
  }

  /** @param {Contract["TableRequest"]} body @param {AbortSignal} signal */
  async function marked(body, signal) {
    /** @type {AsyncGenerator<TableEvent[], void>} */
    const stream = eventsOf(await begin(body, signal));
    for await (const events of stream) {
      if (signal.aborted) return null;
      set(heard(get(), events));
    }
    return get().csv === null ? { title: "", detail: "", problems: [], status: 0 } : null;
  }

  return {
    get,
    subscribe: store.subscribe,
    grade,
    /** A table; or what students handed in, as files or archives. @param {readonly import("./handin.js").Dropped[]} files @param {{named: string, broken: string}} told  what many files are called, and what is said of an archive that cannot be read */
    async take(files, told) {
      const [first] = files;
      if (!first) return;
      if (files.length === 1 && isTable(first.name))
        return grade(first.name, new Uint8Array(await first.slice(0, first.size).arrayBuffer()));
      const { bytes, broken } = await gathered(files);
      const refused = broken.map((file) => ({ file, why: told.broken }));
      return grade(files.length === 1 ? first.name : told.named, bytes, refused);
    },
    again: () => again(),
    /** @param {boolean} looked */
    look: (looked) => set({ looked }),
    /** @param {Partial<Class["order"]>} patch */
    arrange: (patch) => set({ order: { ...get().order, page: 0, ...patch } }),
    /** @param {Partial<Class["wanted"]>} patch */
    want: (patch) => set({ wanted: { ...get().wanted, page: 0, ...patch }, looked: true }),
    /** The tasks of the scene on the page as questions for Moodle; null if the server made none. */
    async stack() {
      const { entry } = state();
      if (!entry) return null;
      const { seed: _, vary: __, ...reference } = entry.reference;
      const file = await questions(reference);
      set({ notice: file ? "" : "homework.class-no-questions" });
      return file;
    },
    /** The server gives up what is not marked yet. */
    stop() {
      marking.abort();
      set({ running: false, waiting: 0 });
    },
  };
}

/** Whether a file is a table by its name. @param {string} name */
const isTable = (name) => /\.(csv|tsv|txt)$/i.test(name);

/** What can be shown of an error; one that comes of stopping is none. @param {unknown} error @param {AbortSignal} signal */
function failureIn(error, signal) {
  if (error instanceof ApiError) return error.failure;
  if (signal.aborted) return null;
  throw error;
}

/** @typedef {ReturnType<typeof createClassroom>} Classroom */
