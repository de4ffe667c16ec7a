/** A call of the API that is being tried: its request as it is written, as a line for a shell and as an address; its answer. */

/** @typedef {import("./reference.js").Call} Call */
/** @typedef {{values: Record<string, string>, body: string}} Draft  what stands in the fields */
/** @typedef {{address: string, options: {method: string, headers?: Record<string, string>, body?: string}}} Sending */
/** @typedef {{status: number, milliseconds: number, bytes: number, text: string, cut: number}} Answer  cut: characters left out */

/** More of an answer is not shown. */
const LONGEST = 60_000;
/** A row of numbers, each on a line of its own. */
const NUMBERS = /\[(\s*(-?[\d.][\d.e+-]*|null),?)+\s*\]/g;

/** What the fields hold at first: an example. @param {Call} call @param {number} [example] @returns {Draft} */
export const draftOf = ({ inputs, examples }, example = 0) => ({
  values: Object.fromEntries(inputs.map(({ name, example: value }) => [name, value])),
  body: examples[example] ?? "",
});

/** @param {Call} call @param {Draft} draft @returns {string} */
function addressOf({ path, inputs }, { values }) {
  const filled = path.replaceAll(/\{(\w+)\}/g, (_, name) => encodeURIComponent(values[name] ?? ""));
  const query = inputs
    .filter(({ name, place }) => place === "query" && values[name] !== "")
    .map(({ name }) => `${name}=${encodeURIComponent(values[name])}`);
  return query.length ? `${filled}?${query.join("&")}` : filled;
}

/** @param {Call} call @param {Draft} draft @returns {Sending} */
export function sendingOf(call, draft) {
  const address = addressOf(call, draft);
  if (!call.type) return { address, options: { method: call.method } };
  return { address, options: { method: call.method, headers: { "content-type": call.type }, body: draft.body } };
}

/** The same as a line for a shell. @param {Call} call @param {Draft} draft */
export function curlOf(call, draft) {
  const address = `"$DELTAQ${addressOf(call, draft)}"`;
  if (!call.type) return `curl ${address}`;
  const body = compact(draft.body).replaceAll("'", "'\\''");
  return `curl ${address} -H 'content-type: ${call.type}' \\\n  --data-binary '${body}'`;
}

/** @param {string} text */
function compact(text) {
  try {
    return JSON.stringify(JSON.parse(text));
  } catch {
    return text;
  }
}

/** A draft as the end of an address: which call, and what differs from its example. @param {Call} call @param {Draft} draft */
export function fragmentOf(call, draft) {
  const example = draftOf(call);
  const changed = new URLSearchParams(
    Object.entries(draft.values).filter(([name, value]) => value !== example.values[name]),
  );
  if (draft.body !== example.body) changed.set("body", draft.body);
  return `#${call.id}${changed.size ? `?${changed}` : ""}`;
}

/** The call that an address names, or the first with an example, with its draft. @param {readonly Call[]} calls @param {string} fragment */
export function draftIn(calls, fragment) {
  const [id, query = ""] = fragment.replace(/^#/, "").split(/\?(.*)/s);
  const call = calls.find((one) => one.id === id) ?? calls.find((one) => one.examples.length) ?? calls[0];
  const given = new URLSearchParams(query);
  const { values, body } = draftOf(call);
  const written = Object.fromEntries(Object.entries(values).map(([name, value]) => [name, given.get(name) ?? value]));
  return { call, draft: { values: written, body: given.get("body") ?? body } };
}

/** JSON in lines, rows of numbers in one, anything else as it came; very long ones are cut. @param {string} text */
export function readable(text) {
  let whole = text;
  try {
    whole = JSON.stringify(JSON.parse(text), null, 2).replaceAll(NUMBERS, (row) => row.replaceAll(/\s+/g, " "));
  } catch {
    /* XML, Markdown, Python: lines are there */
  }
  return { text: whole.slice(0, LONGEST), cut: Math.max(0, whole.length - LONGEST) };
}

/**
 * Sends a request; null if nothing came back.
 * @param {typeof fetch} send @param {Sending} sending @param {AbortSignal} signal @param {() => number} now
 * @returns {Promise<Answer | null>}
 */
export async function ask(send, { address, options }, signal, now) {
  const begun = now();
  try {
    const response = await send(address, { ...options, signal });
    const text = await response.text();
    return {
      status: response.status,
      milliseconds: now() - begun,
      bytes: new TextEncoder().encode(text).length,
      ...readable(text),
    };
  } catch (error) {
    if (/** @type {Error} */ (error).name === "AbortError") throw error;
    return null;
  }
}
