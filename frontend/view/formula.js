/** Formulas: KaTeX into the DOM, made to fit their column; what KaTeX refuses is shown as plain text. */

import { html, nothing } from "lit-html";
import { Directive, directive } from "lit-html/directive.js";

/** Display formulas shrink to this part of their size before they scroll. */
const SMALLEST = 0.62;
/** Rows that would become smaller are rather broken, where that is not said otherwise. */
const BEARABLE = 0.78;
/** Broken rows are to fit at this size. */
const COMFORTABLE = 0.85;

/** @param {{command: string}} context  only classes, which carry the colours, and only in LaTeX from the server */
const onlyClasses = (context) => context.command === "\\htmlClass";

/**
 * @param {HTMLElement} element @param {string} latex @param {boolean} display
 */
function typeset(element, latex, display) {
  try {
    globalThis.katex.render(latex, element, {
      displayMode: display, trust: onlyClasses, strict: "ignore", throwOnError: true, maxExpand: 1000, maxSize: 10,
    });
  } catch {
    element.textContent = latex;
    element.classList.add("untypeset");
  }
}

const fitter = new ResizeObserver((entries) => entries.forEach(({ target }) => fit(/** @type {HTMLElement} */ (target))));
/** @type {WeakMap<HTMLElement, number>} */
const fittedWidths = new WeakMap();

/** What each display formula says; those that are broken into lines say it in another form. @type {WeakMap<HTMLElement, {latex: string, broken: boolean}>} */
const sources = new WeakMap();

/** Sets the size at which a formula fits its column; one that would become too small goes on below. @param {HTMLElement} element */
function fit(element) {
  const width = element.clientWidth;
  if (width === 0 || fittedWidths.get(element) === width) return;
  fittedWidths.set(element, width);
  const source = sources.get(element);
  if (source?.broken) whole(element, source.latex);
  const part = shrink(element, width);
  // A lecture would rather have more lines than smaller ones.
  const bearable = part < 1 ? Number(getComputedStyle(element).getPropertyValue("--bearable")) || BEARABLE : 0;
  if (part < bearable && source) void goOnBelow(element, source.latex, part / Math.max(bearable, COMFORTABLE));
}

/** @param {HTMLElement} element @param {number} width @returns {number} the size at which it would fit */
function shrink(element, width) {
  element.style.setProperty("--fit", "1");
  const needed = element.scrollWidth;
  const part = needed > width ? Math.floor((width / needed) * 98) / 100 : 1;
  element.style.setProperty("--fit", String(Math.max(SMALLEST, part)));
  return part;
}

/** How wide a row is, is only guessed before it is set: if it is wider, it is broken into shorter ones. */
const SHARES = [1, 0.7, 0.45];

/** @param {HTMLElement} element @param {string} latex */
function whole(element, latex) {
  typeset(element, latex, true);
  sources.set(element, { latex, broken: false });
}

/** How to break lines is fetched when a line has to be. @param {HTMLElement} element @param {string} latex @param {number} part */
async function goOnBelow(element, latex, part) {
  const { brokenRows } = await import("../model/linebreak.js");
  if (sources.get(element)?.latex !== latex) return;
  sources.set(element, { latex, broken: true });
  for (const share of SHARES) {
    typeset(element, brokenRows(latex, share * part), true);
    if (shrink(element, element.clientWidth) >= SMALLEST) return;
  }
}

// What was measured before the fonts of the formulas had come was not their width.
document.fonts.addEventListener("loadingdone", () => document.querySelectorAll(".formula").forEach((element) => {
  fittedWidths.delete(/** @type {HTMLElement} */ (element));
  fit(/** @type {HTMLElement} */ (element));
}));

class Typeset extends Directive {
  latex = "";

  /** @param {string} _latex @param {boolean} _display */
  render(_latex, _display) {
    return nothing;
  }

  /** @param {import("lit-html").ElementPart} part @param {[string, boolean]} values */
  update(part, [latex, display]) {
    if (latex === this.latex) return nothing;
    this.latex = latex;
    const element = /** @type {HTMLElement} */ (part.element);
    typeset(element, latex, display);
    if (display) {
      sources.set(element, { latex, broken: false });
      fittedWidths.delete(element);
      fitter.observe(element);
    }
    return nothing;
  }
}

const typesetInto = directive(Typeset);

/** A formula within a line. @param {string} latex @param {string} [className] */
export const inline = (latex, className = "") => html`<span class="math ${className}" ${typesetInto(latex, false)}></span>`;

/** A formula on a line of its own. @param {string} latex */
export const displayed = (latex) => html`<div class="formula" tabindex="-1" ${typesetInto(latex, true)}></div>`;

/** What closes a sentence or a bracket never begins a line; browsers would break there after a formula. */
const CLOSING = /^[.,;:!?)]+/;
/** Longer formulas may need the break within. */
const SHORT = 40;

/** A sentence with formulas between dollar signs. @param {string} text */
export function prose(text) {
  const parts = text.split("$");
  const closing = parts.map((part, i) => (i && i % 2 === 0 && parts[i - 1].length <= SHORT && CLOSING.exec(part)?.[0]) || "");
  return parts.map((part, i) => {
    if (i % 2 === 0) return part.slice(closing[i].length);
    return closing[i + 1] ? html`<span class="unbroken">${inline(part)}${closing[i + 1]}</span>` : inline(part);
  });
}

/** A sentence without markup, for titles and screen readers. @param {string} text */
export const plainly = (text) => text.replace(/\$[^$]*\$/g, (formula) => formula.slice(1, -1).replace(/\\(htmlClass\{[^}]*\}|[a-z]+)|[{}\\]/g, "$1"));
