/** Server-sent events in the body of a response: where an experiment stands in the queue, its parts as they are measured, then its result. */

import { ApiError, failureOf } from "../api.js";

/** @typedef {{done: number, total: number, charts: Chart[]}} Part */
/** @typedef {{place: number, seconds: number}} Waiting  place 1 is the next, 0 has begun; seconds until it should begin */
/** @typedef {{id: string, title: string, subject: string, caption: string, data: any[], layout: Record<string, any>}} Chart */
/** @typedef {{experiment: string, charts: Chart[], [key: string]: any}} Result */
/** @typedef {{kind: string, data: any}} StreamEvent */

/**
 * Cuts text into events; what is not complete yet waits for the next piece.
 * @returns {(piece: string) => StreamEvent[]}
 */
export function eventReader() {
  let rest = "";
  return (piece) => {
    const blocks = (rest + piece).split("\n\n");
    rest = blocks.pop() ?? "";
    return blocks.filter(Boolean).map(eventOf);
  };
}

/** @param {string} block @returns {StreamEvent} */
function eventOf(block) {
  const lines = block.split("\n");
  const of = (/** @type {string} */ field) => lines.filter((line) => line.startsWith(`${field}: `)).map((line) => line.slice(field.length + 2)).join("\n");
  return { kind: of("event"), data: JSON.parse(of("data") || "null") };
}

/**
 * Runs an experiment, or with `anew` runs again what was measured before; `hear` gets its parts, and `wait` its place
 * before it begins. An ApiError where it is refused or breaks off.
 * @param {typeof fetch} send @param {string} name @param {object} body
 * @param {(part: Part) => void} hear @param {AbortSignal} signal @param {boolean} [anew] @param {(waiting: Waiting) => void} [wait]
 * @returns {Promise<Result>}
 */
export async function experiment(send, name, body, hear, signal, anew = false, wait = () => {}) {
  const response = await ask(send, name, body, { accept: "text/event-stream", ...(anew ? { "cache-control": "no-cache" } : {}) }, signal);
  const reader = response.body?.pipeThrough(new TextDecoderStream()).getReader();
  const read = eventReader();
  for (;;) {
    const { done, value } = (await reader?.read()) ?? { done: true, value: "" };
    if (done) throw new ApiError(failureOf(0, null));
    for (const { kind, data } of read(value)) {
      if (kind === "waiting") wait(data);
      if (kind === "part") hear(data);
      if (kind === "problem") throw new ApiError(failureOf(data.status, data));
      if (kind === "result") return data;
    }
  }
}

/**
 * The result as a file: text/html or text/csv.
 * @param {typeof fetch} send @param {string} name @param {object} body @param {string} accept
 */
export const file = async (send, name, body, accept) => (await ask(send, name, body, { accept })).blob();

/** @param {typeof fetch} send @param {string} name @param {object} body @param {Record<string, string>} wanted  headers @param {AbortSignal} [signal] */
async function ask(send, name, body, wanted, signal) {
  const headers = { "content-type": "application/json", ...wanted };
  const response = await send(`/api/v1/experiments/${name}`, { method: "POST", headers, body: JSON.stringify(body), signal }).catch((error) => {
    if (error?.name === "AbortError") throw error;
    throw new ApiError(failureOf(0, null));
  });
  if (!response.ok) throw new ApiError(failureOf(response.status, await response.json().catch(() => null)));
  return response;
}
