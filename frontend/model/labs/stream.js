/** Server-sent events in the body of a response; of an experiment: where it stands in the queue, its parts as they are measured, then its result. */

import { ApiError, failureOf } from "../api.js";
import { tableOf } from "../own.js";

/** @typedef {{done: number, total: number, charts: Chart[]}} Part */
/** @typedef {{place: number, seconds: number}} Queued  place 1 is the next, 0 has begun; seconds until it should begin */
/** @typedef {{kernels: number, of: number}} Preparing  how many of all numerical kernels are compiled */
/** @typedef {Queued | Preparing} Waiting  for what an experiment waits */
/** @typedef {import("./chart.js").Chart} Chart */
/** @typedef {import("./results.js").Result} Result */
/** Events by their kinds, and what each kind says. @template T @typedef {{[K in keyof T]: {kind: K, data: T[K]}}[keyof T]} Events */
/** @typedef {Events<{preparing: Preparing, waiting: Queued, part: Part, result: Result}>} Measuring  what is heard of an experiment */
/** @typedef {{kind: string, data: unknown}} StreamEvent */

export const EVENTS = "text/event-stream";

/**
 * Cuts text into events; what is not complete yet waits for the next piece. Comments, which keep a connection alive, are none.
 * @returns {(piece: string) => StreamEvent[]}
 */
export function eventReader() {
  let rest = "";
  return (piece) => {
    const blocks = (rest + piece).split("\n\n");
    rest = blocks.pop() ?? "";
    return blocks.filter((block) => /^data:/m.test(block)).map(eventOf);
  };
}

/** @param {string} block @returns {StreamEvent} */
function eventOf(block) {
  const lines = block.split("\n");
  const of = (/** @type {string} */ field) =>
    lines
      .filter((line) => line.startsWith(`${field}: `))
      .map((line) => line.slice(field.length + 2))
      .join("\n");
  return { kind: of("event"), data: JSON.parse(of("data") || "null") };
}

/**
 * Runs an experiment, or with `anew` runs again what was measured before; `hear` gets its parts, and `wait` what it
 * waits for before it begins. An ApiError where it is refused or breaks off.
 * @param {typeof fetch} send @param {string} name @param {object} body
 * @param {(part: Part) => void} hear @param {AbortSignal} signal @param {boolean} [anew] @param {(waiting: Waiting) => void} [wait]
 * @returns {Promise<Result>}
 */
export async function experiment(send, name, body, hear, signal, anew = false, wait = () => {}) {
  const response = await ask(
    send,
    `/experiments/${name}`,
    body,
    { accept: EVENTS, ...(anew ? { "cache-control": "no-cache" } : {}) },
    signal,
  );
  /** @type {AsyncGenerator<Measuring[], void>} */
  const stream = eventsOf(response);
  for await (const events of stream) {
    for (const { kind, data } of events) {
      if (kind === "preparing" || kind === "waiting") wait(data);
      if (kind === "part") hear(data);
      if (kind === "result") return data;
    }
  }
  throw new ApiError(failureOf(0, null));
}

/**
 * The events of a stream, as many at a time as have come together, until it ends. An ApiError for a `problem`.
 * Which events there are, the call says to whose answer one listens.
 * @template {StreamEvent} E @param {Response} response @returns {AsyncGenerator<E[], void>}
 */
export async function* eventsOf(response) {
  const reader = response.body?.pipeThrough(new TextDecoderStream()).getReader();
  const read = eventReader();
  for (;;) {
    const { done, value } = (await reader?.read().catch(brokenOff)) ?? { done: true, value: "" };
    if (done) return;
    const events = read(value);
    const problem = events.findIndex(({ kind }) => kind === "problem");
    yield /** @type {E[]} */ (problem < 0 ? events : events.slice(0, problem));
    if (problem >= 0) throw new ApiError(failureOf(statusIn(events[problem].data), events[problem].data));
  }
}

/** @param {unknown} problem */
const statusIn = (problem) => Number(tableOf(problem)?.status) || 0;

/** A connection that is lost is a server that cannot be reached; who has gone himself knows that. @param {unknown} error @returns {never} */
function brokenOff(error) {
  throw error instanceof Error && error.name === "AbortError" ? error : new ApiError(failureOf(0, null));
}

/**
 * The result as a file: text/html or text/csv.
 * @param {typeof fetch} send @param {string} name @param {object} body @param {string} accept
 */
export const file = async (send, name, body, accept) =>
  (await ask(send, `/experiments/${name}`, body, { accept })).blob();

/** The head of an answer, if it is none of a failure. @param {typeof fetch} send @param {string} path @param {object} body @param {Record<string, string>} wanted  headers @param {AbortSignal} [signal] */
export async function ask(send, path, body, wanted, signal) {
  const headers = { "content-type": "application/json", ...wanted };
  const response = await send(`/api/v1${path}`, { method: "POST", headers, body: JSON.stringify(body), signal }).catch(
    brokenOff,
  );
  if (!response.ok) throw new ApiError(failureOf(response.status, await response.json().catch(() => null)));
  return response;
}
