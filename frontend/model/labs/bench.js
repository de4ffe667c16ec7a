/** The bench: one experiment at a time, begun, watched and stopped. */

import { ApiError } from "../api.js";
import { newest } from "../latest.js";
import { createStore } from "../store.js";
import { KNOWN } from "./experiments.js";
import { inLab, onScene, requestOf } from "./question.js";

/** @typedef {import("./question.js").Question} Question */
/** @typedef {import("./chart.js").Chart} Chart */
/** @typedef {import("./stream.js").Part} Part */
/** @typedef {import("./stream.js").Result} Result */
/** @typedef {import("./stream.js").Waiting} Waiting */
/**
 * @typedef {object} Bench
 * @property {Question} question
 * @property {import("../types.js").Scene | null} scene
 * @property {boolean} running
 * @property {Waiting | null} waiting  for what, until it begins
 * @property {number} progress 0 to 1
 * @property {Chart[]} charts
 * @property {Result | null} result
 * @property {import("../types.js").Failure | null} failure
 * @property {string} stopped  why there are charts but no result
 */

/** @type {Omit<Bench, "question" | "scene">} */
const EMPTY = { running: false, waiting: null, progress: 0, charts: [], result: null, failure: null, stopped: "" };

/**
 * @param {{run: (name: string, body: object, hear: (part: Part) => void, signal: AbortSignal, anew: boolean, wait: (waiting: Waiting) => void) => Promise<Result>,
 *   scene: (id: string) => Promise<import("../types.js").Scene>, document: (id: string) => string | object, lang: () => import("../types.js").Lang,
 *   known?: import("./experiments.js").Experiments}} around
 * @param {Question} question
 */
export function createBench({ run, scene, document, lang, known = KNOWN }, question) {
  const store = createStore(/** @type {Bench} */ ({ question, scene: null, ...EMPTY }));
  const { get, set } = store;
  const renew = newest();
  let answered = "";

  /** @param {unknown} error */
  const failureIn = (error) =>
    error instanceof ApiError ? error.failure : { title: "", detail: String(error), problems: [], status: 500 };

  function stop() {
    renew();
    if (get().running) set({ running: false, waiting: null, stopped: "stopped" });
  }

  /** @param {Partial<Bench>} cleared  what is shown until something comes @param {boolean} renews  whether what has just been measured is measured anew */
  async function ask(cleared, renews) {
    stop();
    const signal = renew();
    const { question, result: before } = get();
    set({ ...cleared, running: true });
    const body = requestOf(question, document(question.scene), lang(), known);
    const asked = JSON.stringify([question.lab, body]);
    const hear = (/** @type {Part} */ { done, total, charts }) =>
      signal.aborted || set({ waiting: null, progress: done / total, charts });
    const wait = (/** @type {Waiting} */ waiting) => signal.aborted || set({ waiting });
    try {
      const result = await run(question.lab, body, hear, signal, renews && before !== null && asked === answered, wait);
      if (signal.aborted) return;
      answered = asked;
      set({ running: false, waiting: null, progress: 1, result, charts: result.charts });
    } catch (error) {
      if (!signal.aborted) set({ running: false, waiting: null, failure: failureIn(error) });
    }
  }

  /** Measures; what has just been measured is measured anew, and what anybody measured before is there at once. */
  const start = () => ask(EMPTY, true);

  /** Charts carry their texts: in another language they are asked for again, and nothing is measured for it. */
  const retell = async () => (get().result || get().running ? ask({ stopped: "" }, false) : undefined);

  async function load() {
    const { scene: id } = get().question;
    set({ scene: null });
    try {
      const found = await scene(id);
      if (get().question.scene === id) set({ scene: found });
    } catch (error) {
      if (get().question.scene === id) set({ failure: failureIn(error) });
    }
  }

  /** @param {Partial<Question>} patch */
  function edit(patch) {
    set({ question: { ...get().question, ...patch } });
  }

  return {
    get,
    subscribe: store.subscribe,
    edit,
    start,
    retell,
    stop,
    load,
    /** A file of what was measured could not be had. @param {unknown} error */
    fail: (error) => set({ failure: failureIn(error) }),
    /** Another lab, on the same scene; where there is none, on the one that shows it best. @param {string} lab */
    open(lab) {
      stop();
      const before = get().question;
      const question = inLab(before, lab, known);
      set({ ...EMPTY, question });
      if (question.scene !== before.scene || !get().scene) void load();
    },
    /** Another scene: what was said of the one before goes. @param {string} scene */
    choose(scene) {
      stop();
      set({ ...EMPTY, question: onScene(get().question, scene) });
      void load();
    },
  };
}

/** @typedef {ReturnType<typeof createBench>} Benches */
