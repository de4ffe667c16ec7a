/** The question that is being asked, and what the server answers when the hand rests: the steps, then the quotients. */

import { problemsIn } from "../attempts.js";
import { newest } from "../latest.js";
import { createStore } from "../store.js";
import { namesIn, quotientRequestOf, requestOf } from "./question.js";

/** @typedef {import("./question.js").Question} Question */
/** @typedef {import("../types.js").Problem} Problem */
/** @typedef {import("../types.js").Contract["Quotient"]} Quotient */
/**
 * @typedef {object} Asking
 * @property {Question} question
 * @property {"waiting" | "answered" | "refused" | "unreachable"} verdict
 * @property {import("../types.js").Variation | null} answer  to the last question that had one
 * @property {Problem[]} problems
 * @property {Quotient | null} quotient
 * @property {Problem[]} numericProblems
 * @property {number} size  which h is shown
 */

const REST = 300;

/**
 * @param {Pick<import("../api.js").Api, "vary"> & {lang: () => import("../types.js").Lang}} around
 * @param {Question} question @param {number} size
 */
export function createLab({ vary, lang }, question, size) {
  /** @type {Asking} */
  const start = { question, verdict: "waiting", answer: null, problems: [], quotient: null, numericProblems: [], size };
  const store = createStore(start);
  const { get, set } = store;
  let timer = /** @type {ReturnType<typeof setTimeout> | undefined} */ (undefined);
  const renew = newest();

  /** @param {Partial<Asking>} patch @param {number} rest */
  function take(patch, rest) {
    set({ verdict: "waiting", ...patch });
    clearTimeout(timer);
    const signal = renew();
    timer = setTimeout(() => void ask(signal), rest);
  }

  /** @param {AbortSignal} signal */
  async function ask(signal) {
    const asked = get().question;
    try {
      const answer = await vary(requestOf(asked, lang()), signal);
      if (signal.aborted) return;
      set({ verdict: "answered", answer, problems: [] });
      if (Array.isArray(answer.result.first_variation.plain)) set({ quotient: null, numericProblems: [] });
      else await measure(asked, signal);
    } catch (error) {
      if (signal.aborted) return;
      const problems = problemsIn(error);
      set({ verdict: problems.length ? "refused" : "unreachable", problems });
    }
  }

  /** @param {Question} asked @param {AbortSignal} signal */
  async function measure(asked, signal) {
    try {
      const { quotient } = await vary(quotientRequestOf(asked, lang()), signal);
      if (!signal.aborted) set({ quotient: quotient ?? null, numericProblems: [] });
    } catch (error) {
      if (!signal.aborted) set({ quotient: null, numericProblems: problemsIn(error) });
    }
  }

  return {
    get,
    subscribe: store.subscribe,
    /** @param {Partial<Question>} patch */
    edit: (patch) => take({ question: { ...get().question, ...patch } }, REST),
    /** Another question: what belonged to the one before goes. @param {Question} question */
    begin: (question) => take({ question, problems: [], quotient: null, numericProblems: [] }, 0),
    /** A name nobody knows becomes a function or a parameter. @param {"functions" | "parameters"} list @param {string} name */
    declare(list, name) {
      const { question } = get();
      take({ question: { ...question, [list]: [...namesIn(question[list]), name].join(", ") } }, 0);
    },
    again: () => take({}, 0),
    /** @param {number} size */
    show: (size) => set({ size }),
  };
}

/** @typedef {ReturnType<typeof createLab>} Lab */
