/** The viewer's own scene: how it travels in an address, and how it is kept in the browser. */

/** @typedef {import("./types.js").Scene} Scene */
/** @typedef {Record<string, unknown>} SceneDocument  as typed: nothing in it can be relied upon */
/** @typedef {import("./types.js").Contract} Contract */
/** @typedef {{getItem: (key: string) => string | null, setItem: (key: string, value: string) => void}} Keeper */
/**
 * @typedef {object} Draft
 * @property {SceneDocument} document
 * @property {string | null} text  JSON as typed, where it is not simply that of the document
 * @property {SceneDocument[]} earlier  set aside, the latest first
 */

/** The scene of this id is the viewer's own. */
export const OWN = "own";
const KEY = "deltaq.scene.1";
/** An address must not blow up into more than this many characters. */
const LARGEST = 400_000;
const START = "#s=";

/** @param {Uint8Array} bytes @param {CompressionStream | DecompressionStream} stream */
async function* piped(bytes, stream) {
  const writer = stream.writable.getWriter();
  void writer.write(/** @type {BufferSource} */ (bytes)).catch(() => {});
  void writer.close().catch(() => {});
  const reader = stream.readable.getReader();
  for (let part = await reader.read(); !part.done; part = await reader.read())
    yield /** @type {Uint8Array} */ (part.value);
}

/** @param {AsyncIterable<Uint8Array>} parts @param {number} limit */
async function gathered(parts, limit) {
  let all = new Uint8Array(0);
  for await (const part of parts) {
    if (all.length + part.length > limit) throw new RangeError("too large");
    const longer = new Uint8Array(all.length + part.length);
    longer.set(all);
    longer.set(part, all.length);
    all = longer;
  }
  return all;
}

/** Bytes deflated (RFC 1951). @param {Uint8Array} bytes @param {number} limit  a RangeError beyond it */
export const deflated = (bytes, limit) => gathered(piped(bytes, new CompressionStream("deflate-raw")), limit);
/** And back. @param {Uint8Array} bytes @param {number} limit  a RangeError beyond it */
export const inflated = (bytes, limit) => gathered(piped(bytes, new DecompressionStream("deflate-raw")), limit);

/** The fragment of a document: deflated, base64url. @param {SceneDocument} document */
export async function fragmentOf(document) {
  const bytes = new TextEncoder().encode(JSON.stringify(document));
  const packed = await deflated(bytes, LARGEST);
  const text = Array.from(packed, (byte) => String.fromCharCode(byte)).join("");
  return START + btoa(text).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}

/**
 * The document of a fragment; null if there is none in it.
 * @param {string} fragment @returns {Promise<SceneDocument | null>}
 */
export async function documentIn(fragment) {
  if (!fragment.startsWith(START)) return null;
  try {
    const text = atob(fragment.slice(START.length).replaceAll("-", "+").replaceAll("_", "/"));
    const packed = Uint8Array.from(text, (letter) => letter.charCodeAt(0));
    const bytes = await inflated(packed, LARGEST);
    return tableOf(JSON.parse(new TextDecoder().decode(bytes)));
  } catch {
    return null;
  }
}

/** @param {unknown} value @returns {SceneDocument | null} */
export function tableOf(value) {
  return value && typeof value === "object" && !Array.isArray(value) ? /** @type {SceneDocument} */ (value) : null;
}

/** @param {Keeper} keeper @returns {Draft | null} */
export function readDraft(keeper) {
  try {
    const kept = tableOf(JSON.parse(keeper.getItem(KEY) ?? "null"));
    const document = tableOf(kept?.document);
    if (!kept || !document) return null;
    const earlier = Array.isArray(kept.earlier) ? kept.earlier.filter((one) => tableOf(one)) : [];
    return { document, text: typeof kept.text === "string" ? kept.text : null, earlier };
  } catch {
    return null;
  }
}

/** False where the browser keeps nothing. @param {Keeper} keeper @param {Draft} draft */
export function keepDraft(keeper, draft) {
  try {
    keeper.setItem(KEY, JSON.stringify(draft));
    return true;
  } catch {
    return false;
  }
}

/** @param {unknown} value @returns {Record<string, string>} */
const texts = (value) =>
  typeof value === "string" ? { en: value, de: value } : /** @type {Record<string, string>} */ (tableOf(value) ?? {});
/** @param {unknown} value @returns {SceneDocument[]} */
const rows = (value) => (Array.isArray(value) ? value.filter((row) => tableOf(row)) : []);

const GREEK =
  /^(alpha|beta|gamma|[dD]elta|epsilon|zeta|eta|(var)?theta|iota|kappa|[lL]ambda|mu|nu|[xX]i|omicron|(var)?pi|(var)?rho|(var)?sigma|tau|upsilon|(var)?phi|chi|[pP]si|[oO]mega|Gamma|Theta|Pi|Sigma|Phi|ell|varepsilon|varkappa)$/;

/** A word of a name in LaTeX. @param {string} word */
const letter = (word) =>
  word === "phi" || word === "epsilon"
    ? `\\var${word}`
    : GREEK.test(word)
      ? `\\${word}`
      : /^(.|\d+)$/.test(word)
        ? word
        : `\\mathrm{${word}}`;

/** LaTeX of a name, as the server writes it: phi → \\varphi, y0 → y_{0}, omega_max → \\omega_{\\mathrm{max}}. @param {string} name */
export function latexOfName(name) {
  const [head = "", ...indices] = name.match(/[A-Za-z]+|\d+/g) ?? [];
  return letter(head) + (indices.length ? `_{${indices.map(letter).join(",")}}` : "");
}

/** @param {SceneDocument} row */
const typeset = (row) => ({ ...row, latex: row.latex || latexOfName(String(row.name ?? "")) });

/**
 * A valid document with what it leaves to be understood, so that the page can show it.
 * @param {SceneDocument} given @returns {Scene}
 */
export function completed(given) {
  return /** @type {Scene} */ ({
    ...given,
    id: OWN,
    title: texts(given.title),
    summary: texts(given.summary),
    dimension: given.dimension ?? 2,
    coordinates: rows(given.coordinates).map((row) => ({ unit: "", value: 0, rate: 0, ...typeset(row) })),
    parameters: rows(given.parameters).map((row) => ({ unit: "", value: 1, ...typeset(row) })),
    points: rows(given.points),
    bodies: rows(given.bodies),
    loads: named(rows(given.loads)),
    guides: rows(given.guides),
    drawing: given.drawing ?? null,
  });
}

/** What is typed goes to the server as it is, which says what is wrong with it. @param {SceneDocument} given */
export const asTyped = (given) => /** @type {Contract["SceneDocument"]} */ (given);

/** A document as the server writes it: nothing in it is left to be understood. @param {Contract["SceneDocument"]} given */
export const asWritten = (given) => /** @type {Scene} */ (given);

/** Loads without a name are called by their kind, and counted if there are more. @param {SceneDocument[]} loads */
function named(loads) {
  return loads.map((load, i) => {
    const kind = String(load.kind ?? "").replaceAll("-", "_");
    const alike = loads.filter((other) => other.kind === load.kind).length;
    const count = loads.slice(0, i + 1).filter((other) => other.kind === load.kind).length;
    return { name: alike > 1 ? `${kind}-${count}` : kind, ...load };
  });
}
