/** What a chart points at, as a motion to be simulated: a point of a map, or a method at the step where it fails. */

import { newest } from "../latest.js";
import { numberText } from "../numbers.js";
import { sampled, samplesFor } from "../sampling.js";

/** @typedef {import("./question.js").Question} Question */
/** @typedef {Partial<Pick<Question, "parameters" | "initial">> & {method?: string, step?: number, t_end?: number}} Wish */

const SECONDS = 20;
const RATE = 60;
/** @type {import("../types.js").Parts} */
const PARTS = ["coordinates", "rates", "positions", "loads", "energy"];

/** @param {Question} question @param {Wish} wish @param {import("../types.js").Contract["Scene"]} scene @param {import("../types.js").Lang} lang */
export function motionOf({ parameters, initial }, wish, scene, lang) {
  const { method, step, t_end = SECONDS } = wish;
  const stepped = method ? { method, step } : {};
  return {
    scene,
    parameters,
    initial,
    ...only(wish),
    t_end,
    samples: samplesFor(RATE * SECONDS),
    include: PARTS,
    lang,
    ...stepped,
  };
}

/** @param {Wish} wish */
const only = ({ parameters, initial }) => ({ ...(parameters ? { parameters } : {}), ...(initial ? { initial } : {}) });

/** The values of a point, as a line of text. @param {Wish} wish @param {string} lang */
export function written({ parameters = {}, initial = {} }, lang) {
  const starts = Object.entries(initial).map(([name, { value }]) => /** @type {const} */ ([name, value ?? 0]));
  return [...Object.entries(parameters), ...starts]
    .map(([name, value]) => `${name} = ${numberText(Number(value.toPrecision(4)), lang)}`)
    .join("; ");
}

/**
 * Simulates what is pointed at; what is pointed at next takes its place.
 * @param {Pick<import("../api.js").Api, "simulate">} api
 */
export function createWatch({ simulate }) {
  const renew = newest();
  const whole = sampled(simulate);
  return {
    /** What was pointed at is no longer wanted. */
    forget: () => void renew(),
    /** @param {ReturnType<typeof motionOf>} body @param {(trajectory: import("../types.js").Trajectory) => void} play @param {(error: unknown) => void} fail */
    async ask(body, play, fail) {
      const signal = renew();
      try {
        const trajectory = await whole(body, signal);
        if (!signal.aborted) play(trajectory);
      } catch (error) {
        if (!signal.aborted) fail(error);
      }
    },
  };
}
