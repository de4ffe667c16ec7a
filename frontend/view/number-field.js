/**
 * Fields for numbers with the decimal mark of the reader's language, which take either: what a browser makes of
 * `type="number"` has the mark of the browser's language, and some refuse the other one.
 */

import { html, nothing } from "lit-html";
import { numberIn, numberText } from "../model/numbers.js";
import { settled } from "./settled.js";

/** By so many steps the arrow keys move a number. @type {Record<string, number>} */
const STEPS = { ArrowUp: 1, ArrowDown: -1 };
/** Decimals beyond those of doubles: 0.1 + 0.2 is 0.3 in a field. */
const DIGITS = 12;

/**
 * @param {{value: number | "", lang: string, put: (value: number) => number | void, label?: string, hint?: string, step?: number,
 *   least?: number, placeholder?: string}} given  put: takes what was typed, and may answer what is shown instead; hint: id of what is told of it;
 *   step: of the arrow keys; least: below which there is none
 */
export function numberField({ value, lang, put, label, hint, step = 1, least = -Infinity, placeholder = "" }) {
  const text = value === "" ? "" : numberText(value, lang);
  const take = (/** @type {HTMLInputElement} */ field, /** @type {number} */ asked) => {
    const shown = Number.isNaN(asked) ? value : (put(asked) ?? asked);
    field.value = shown === "" ? "" : numberText(shown, lang);
  };
  const fieldOf = (/** @type {Event} */ event) => /** @type {HTMLInputElement} */ (event.currentTarget);
  const changed = (/** @type {Event} */ event) => take(fieldOf(event), numberIn(fieldOf(event).value));
  const pressed = (/** @type {KeyboardEvent} */ event) => {
    const by = STEPS[event.key];
    if (!by || event.altKey || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    const now = numberIn(fieldOf(event).value);
    take(fieldOf(event), Number(((Number.isNaN(now) ? 0 : now) + by * step).toPrecision(DIGITS)));
  };
  // Some keyboards for decimals have no minus.
  return html`<input class="decimal" type="text" inputmode=${least >= 0 ? "decimal" : "text"} autocomplete="off" autocapitalize="off" spellcheck="false"
    style="--digits:${text.length}" aria-label=${label ?? nothing} aria-describedby=${hint || nothing} placeholder=${placeholder || nothing}
    .value=${settled(text)} @change=${changed} @keydown=${pressed}>`;
}
