/** The scene that is being written: kept at once, checked when the hand rests, shown as soon as it is valid. */

import { problemsIn } from "../attempts.js";
import { newest } from "../latest.js";
import { createStore } from "../store.js";
import { shownFields } from "./schema.js";
import { tableOf } from "../own.js";

/** @typedef {import("../own.js").SceneDocument} SceneDocument */
/** @typedef {"waiting" | "valid" | "invalid" | "unreachable"} Verdict */
/**
 * @typedef {object} Writing
 * @property {SceneDocument} document
 * @property {string | null} text  JSON as typed, until the form changes it
 * @property {string} unread  why it cannot be read, else ""
 * @property {SceneDocument[]} earlier
 * @property {Verdict} verdict
 * @property {import("../types.js").Problem[]} problems
 * @property {Map<string, string>} formulas  LaTeX by the text it was made from
 * @property {string} notice  the key of a sentence, or what the server says
 * @property {boolean} kept  whether the browser keeps what is typed
 */

const REST = 300;
const MOST_EARLIER = 8;

/** The key of a formula: the same text means something else among other material coordinates. @param {unknown} text @param {string[]} material */
export const formulaKey = (text, material) => `${material.join(" ")}|${text}`;
/** @param {unknown} a @param {unknown} b */
const same = (a, b) => JSON.stringify(a) === JSON.stringify(b);
/** @param {SceneDocument} document */
export const jsonOf = (document) =>
  JSON.stringify(document, null, 2).replace(
    /\[\s+((?:"[^"\n]*"|-?[\d.e+-]+)(?:,\s+(?:"[^"\n]*"|-?[\d.e+-]+))*)\s+\]/g,
    (_, inside) => `[${inside.replace(/,\s+/g, ", ")}]`,
  );

/** JSON as typed, and the document in it; why it cannot be read, where it cannot. @param {string} text */
function parsed(text) {
  try {
    const document = tableOf(JSON.parse(text));
    return document ? { document, text, unread: "" } : { text, unread: "{ … }" };
  } catch (error) {
    return { text, unread: /** @type {Error} */ (error).message };
  }
}

/**
 * What the server makes of a document: whether it is valid, and its expressions as formulas.
 * @param {Pick<ReturnType<typeof createStore<Writing>>, "get" | "set">} store
 * @param {{api: import("../api.js").Api, lang: () => import("../types.js").Lang, show: (document: SceneDocument) => void}} around
 */
function createChecking({ get, set }, { api, lang, show }) {
  /** @type {SceneDocument | null} */
  let shown = null;

  /** @param {SceneDocument} document @param {AbortSignal} signal */
  async function typesetAll(document, signal) {
    const wanted = shownFields(document).filter(
      ({ type, value }) => type === "expression" && typeof value === "string" && value.trim(),
    );
    const texts = wanted
      .slice(0, 500)
      .map(({ value, material }) => ({ expression: String(value).slice(0, 4000), material: material.filter(Boolean) }));
    if (!texts.length) return;
    const answer = await api.typeset({ scene: document, expressions: texts, lang: lang() }, signal).catch(() => null);
    if (signal.aborted || !answer) return;
    set({
      formulas: new Map(
        answer.expressions.map(({ latex }, i) => [formulaKey(wanted[i].value, wanted[i].material), latex]),
      ),
    });
  }

  /** @param {AbortSignal} signal */
  return async function check(signal) {
    const { document } = get();
    const typeset = typesetAll(document, signal);
    try {
      const { valid, problems } = await api.validate(document, lang(), signal);
      if (signal.aborted) return;
      set({ verdict: valid ? "valid" : "invalid", problems });
      if (valid && document !== shown) show((shown = document));
    } catch (error) {
      if (signal.aborted) return;
      set({ verdict: "unreachable", problems: problemsIn(error) });
    }
    await typeset;
  };
}

/**
 * @param {{api: import("../api.js").Api, lang: () => import("../types.js").Lang, show: (document: SceneDocument) => void,
 *   address: (document: SceneDocument) => void, keep: (draft: import("../own.js").Draft) => boolean}} around
 * @param {import("../own.js").Draft} draft
 */
export function createEditor({ address, keep, ...around }, draft) {
  const store = createStore(
    /** @type {Writing} */ ({
      ...draft,
      unread: "",
      verdict: "waiting",
      problems: [],
      formulas: new Map(),
      notice: "",
      kept: true,
    }),
  );
  const { get, set } = store;
  const check = createChecking(store, around);
  let timer = /** @type {ReturnType<typeof setTimeout> | undefined} */ (undefined);
  const renew = newest();

  /** @param {Partial<Writing>} patch @param {number} rest */
  function take(patch, rest) {
    set({ verdict: "waiting", notice: "", ...patch });
    const { document, text, earlier } = get();
    set({ kept: keep({ document, text, earlier }) });
    address(document);
    clearTimeout(timer);
    const signal = renew();
    timer = setTimeout(() => void check(signal), rest);
  }

  if (draft.text !== null) set(parsed(draft.text));
  take({}, 0);
  return {
    get,
    subscribe: store.subscribe,
    /** @param {SceneDocument} document */
    edit: (document) => take({ document, text: null, unread: "" }, REST),
    /** JSON as typed. @param {string} text */
    type: (text) => take(parsed(text), REST),
    /** Back to the last JSON that could be read. */
    untype: () => take({ text: null, unread: "" }, 0),
    /** Another scene; the one there was is set aside. @param {SceneDocument} document */
    begin(document) {
      const before = get();
      if (same(before.document, document) && !before.unread) return;
      const earlier = [before.document, ...before.earlier.filter((one) => !same(one, before.document))].slice(
        0,
        MOST_EARLIER,
      );
      take({ document, text: null, unread: "", earlier, notice: "editor.set-aside" }, 0);
    },
    /** The scene that was set aside last. */
    undo() {
      const [document, ...rest] = get().earlier;
      if (document) take({ document, text: null, unread: "", earlier: [...rest, get().document] }, 0);
    },
    again: () => take({}, 0),
    /** @param {string} notice */
    tell: (notice) => set({ notice }),
  };
}

/** @typedef {ReturnType<typeof createEditor>} Editor */
