/** From the formula field to the text field and back: the text of each stays, and is made anew only where it must be. */

import { isEmpty } from "./answer.js";
import { isTranslated, partsIn, sameTexts } from "./answering.js";

/** @typedef {import("./answer.js").Syntax} Syntax */
/** @typedef {import("./progress.js").Draft} Draft */
/** @typedef {import("./sheet.js").Entry} Entry */

/**
 * @param {import("./state.js").Store} store @param {import("./state.js").Api} api @param {import("./answering.js").Answering} answering
 */
export function createConversion({ get, set }, api, answering) {
  /** Each part in the other syntax; null where one cannot be read. @param {Entry} entry @param {string[]} parts @param {Syntax} from @param {Syntax} to */
  async function converted(entry, parts, from, to) {
    const { lang } = get().asked.place;
    const { id } = entry.task;
    if (parts.length === 1) {
      const read = await api
        .post("/checks/reading", { ...entry.reference, task: id, answer: { syntax: from, value: parts[0] }, lang })
        .catch(() => null);
      return read && !read.problems.length ? [read[to]] : null;
    }
    const asked = parts.map((expression) => ({ expression: expression.trim() || "0", syntax: from }));
    const answer = await api
      .post("/expressions/batch", { scene: entry.scene, expressions: asked, lang })
      .catch(() => null);
    const texts = answer?.expressions.map((one, i) => (parts[i].trim() ? one[to] : "")) ?? [];
    return answer && texts.every((text, i) => text || !parts[i].trim()) ? texts : null;
  }

  /** @param {Syntax} to */
  return async function switchTo(to) {
    const { entry, draft } = get();
    if (!entry || draft.syntax === to) return;
    const parts = partsIn(entry, draft);
    const from = draft.syntax;
    set({ notice: "" });
    if (isEmpty(parts) || isTranslated(entry, draft)) return answering.keep(entry, () => ({ syntax: to }));
    const texts = await converted(entry, parts, from, to);
    if (get().entry?.key !== entry.key || !sameTexts(parts, partsIn(entry, get().draft, from))) return;
    answering.keep(entry, (now) => ({
      syntax: to,
      ...(texts ? { texts: { ...now.texts, [to]: texts }, converted: { from, texts } } : {}),
    }));
    if (!texts) set({ notice: `homework.kept-${from}` });
    answering.arrive();
  };
}
