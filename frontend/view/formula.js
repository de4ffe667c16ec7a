/** Formulas as parts of templates: typeset, made to fit their column, and, where nobody sees them yet, when there is time. */

import { html, nothing } from "lit-html";
import { Directive, directive } from "lit-html/directive.js";
import { withDecimalMark } from "../model/numbers.js";
import { pieces } from "../model/prose.js";
import { Exploring } from "./exploring.js";
import { Fitting } from "./fitting.js";
import { typeset } from "./typesetting.js";
import { Waiting } from "./waiting.js";

/** Of the page: templates have no other way to reach it. */
const fitting = new Fitting();
const waiting = new Waiting();
const exploring = new Exploring();

/** There will be long formulas: how they are typeset is fetched before. */
export const expectLong = () => fitting.expectLong();

/** A formula of a long step has been scrolled to; or it, or a whole step, has gone out of sight. @param {EventTarget | null} target @param {boolean} [gone] */
export function fitSeen(target, gone = false) {
  if (!(target instanceof HTMLElement)) return;
  if (gone) fitting.gone(target);
  else fitting.seen(target);
}

/** Formulas whose size has been changed fit their places anew. @param {HTMLElement} place */
export function refit(place) {
  for (const element of place.querySelectorAll(".formula")) fitting.fitSoon(/** @type {HTMLElement} */ (element));
}

/** What has come into view is typeset before all others. @param {Node} place */
export const typesetWithin = (place) => waiting.hurry(place);

/** All that still waits, at once, at its size and with its rows: for paper. */
export function typesetAll() {
  waiting.finish();
  fitting.finish();
}
window.addEventListener("beforeprint", typesetAll);

// What was measured before the fonts of the formulas had come was not their width; what nobody sees is not measured at all.
document.fonts.addEventListener("loadingdone", () =>
  document.querySelectorAll(".formula").forEach((element) => fitting.fitSoon(/** @type {HTMLElement} */ (element))),
);

/** @param {HTMLElement} element @param {string} latex @param {boolean} display @param {boolean} [atOnce]  it is seen now */
function set(element, latex, display, atOnce = false) {
  waiting.drop(element);
  if (display) fitting.show(element, latex, atOnce);
  else typeset(element, latex, display);
}

class Typeset extends Directive {
  latex = "";

  /** @param {string} _latex @param {boolean} _display @param {boolean} _later */
  render(_latex, _display, _later) {
    return nothing;
  }

  /** @param {import("lit-html").ElementPart} part @param {[string, boolean, boolean]} values */
  update(part, [given, display, later]) {
    const element = /** @type {HTMLElement} */ (part.element);
    const latex = withDecimalMark(given, document.documentElement.lang);
    const unseen = later && !element.closest("details[open]");
    // A step that was far may be near now.
    fitting.wake();
    if (latex === this.latex && (unseen || !waiting.has(element))) return nothing;
    this.latex = latex;
    if (unseen) waiting.put(element, () => set(element, latex, display));
    else set(element, latex, display, true);
    return nothing;
  }
}

const typesetInto = directive(Typeset);

/** A formula within a line. @param {string} latex @param {string} [className] @param {boolean} [later] it is not seen yet */
export const inline = (latex, className = "", later = false) =>
  html`<span class="math ${className}" ${typesetInto(latex, false, later)}></span>`;

/**
 * A formula on a line of its own; what it says is its name, and its terms can be walked through.
 * @param {string} latex @param {boolean} [later] it is not seen yet @param {import("../model/spoken.js").Said} [said]  by the server; else KaTeX says what it can
 */
export const displayed = (latex, later = false, said = {}) =>
  said.spoken
    ? html`<div class="formula" tabindex="0" role="img" aria-label=${said.spoken} @keydown=${(/** @type {KeyboardEvent} */ event) => exploring.press(event, said)}
        @blur=${() => exploring.leave()} ${typesetInto(latex, true, later)}></div>`
    : html`<div class="formula" tabindex="-1" ${typesetInto(latex, true, later)}></div>`;

/** A sentence of the server with its formulas. @param {import("../model/prose.js").CatalogText} sentence @param {boolean} [later] it is not seen yet */
export const prose = (sentence, later = false) =>
  pieces(sentence).map(({ text, formula }) => (formula ? inline(text, "", later) : text));
