/** One field of an answer, as a formula or as text, and the keys that write into it. */

import { html, nothing } from "lit-html";
import { live } from "lit-html/directives/live.js";
import { inline } from "../formula.js";
import { columnsFor, isWord, written } from "../../model/homework/keys.js";
import { leaveNumber, mathField } from "./mathfield.js";

/** @typedef {import("../../model/homework/keys.js").Key} Key */
/** @typedef {import("../../model/homework/answer.js").Syntax} Syntax */
/** @typedef {{label: string, syntax: Syntax, value: string, invalid: boolean, why: string, placeholder: string, change: (text: string) => void, enter: () => void, shortcuts: Record<string, string>}} Entry */

const LAST = "last";

/** Which field the keys write into. @param {Event} event */
export function remember({ target, currentTarget }) {
  const field = target instanceof Element ? target.closest(".entry") : null;
  if (!field) return;
  /** @type {HTMLElement} */ (currentTarget).querySelectorAll(`.${LAST}`).forEach((one) => one.classList.remove(LAST));
  field.classList.add(LAST);
}

/** @param {Entry} entry @param {boolean} formulas  whether the field for formulas is there */
export function entryField(entry, formulas) {
  const { label, syntax, value, invalid, why, change, enter, shortcuts } = entry;
  if (syntax === "latex" && formulas) return mathField(label, { value, change, enter, shortcuts }, invalid, why);
  const press = (/** @type {KeyboardEvent} */ event) => {
    if (event.key !== "Enter" || event.shiftKey || event.isComposing) return;
    event.preventDefault();
    enter();
  };
  return html`<textarea class="entry" rows="1" maxlength="2000" autocomplete="off" autocapitalize="off" spellcheck="false" aria-label=${label}
    aria-invalid=${String(invalid)} aria-describedby=${why || nothing} placeholder=${entry.placeholder} .value=${live(value)} @keydown=${press}
    @input=${(/** @type {Event} */ event) => change(/** @type {HTMLTextAreaElement} */ (event.target).value)}></textarea>`;
}

/** Writes a key into the field last used, else into the first. @param {Element} root @param {Key} key */
function strike(root, key) {
  const field = root.querySelector(`.entry.${LAST}`) ?? root.querySelector(".entry");
  if (field instanceof HTMLTextAreaElement) {
    const { value, caret } = written(field.value, field.selectionStart, field.selectionEnd, key.plain);
    field.value = value;
    field.focus();
    field.setSelectionRange(caret, caret);
    field.dispatchEvent(new Event("input", { bubbles: true }));
  } else if (field) {
    const formula = /** @type {import("mathlive").MathfieldElement} */ (field);
    // What is selected becomes the base of a power. Else MathLive takes what stands before, but not a letter with a dot.
    if (!/^[\^/]/.test(key.latex)) leaveNumber(formula);
    const latex = formula.selectionIsCollapsed ? key.latex : key.latex.replace(/^\^/, "#@^");
    formula.insert(latex, { focus: true, feedback: false });
  }
}

/**
 * @param {import("../../model/homework/keys.js").Row[]} rows @param {import("../../model/catalog.js").Translate} t
 */
export function keyboard(rows, t) {
  const press = (/** @type {Event} */ event, /** @type {Key} */ key) => {
    const root = /** @type {Element} */ (event.currentTarget).closest(".answering");
    if (root) strike(root, key);
  };
  // The field keeps the focus while a key is pressed by hand.
  const hold = (/** @type {Event} */ event) => event.preventDefault();
  const keys = (/** @type {Key[]} */ some) =>
    some.map(
      (key) => html`
    <button type="button" class="key-cap ${isWord(key) ? "word" : ""}" title=${key.name} aria-label=${key.name} @pointerdown=${hold} @mousedown=${hold} @click=${(/** @type {Event} */ e) => press(e, key)}>${inline(key.label)}</button>`,
    );
  const together = rows.filter(({ id }) => id !== "greek").flatMap((row) => row.keys);
  const columns = (/** @type {Key[]} */ some) => `--columns:${columnsFor(some.length + some.filter(isWord).length)}`;
  return html`<div class="keyboard" role="group" aria-label=${t("homework.keyboard")} style=${columns(together)}>${rows.map(
    ({ id, keys: some }) =>
      id === "greek"
        ? html`<details class="greek" style=${columns(some)}><summary>${t("homework.greek")}</summary><div class="keys">${keys(some)}</div></details>`
        : html`<div class="keys ${id}" role="group" aria-label=${t(`homework.keys-${id}`)}>${keys(some)}</div>`,
  )}</div>`;
}
