/** KaTeX into the DOM; what it refuses is shown as plain text. */

import { airy } from "../model/latex.js";
import { areOfFormulas } from "../model/prose.js";

/** Display formulas shrink to this part of their size, 11 pixels on a phone, before they scroll. */
export const SMALLEST = 0.56;
/** Formulas that would become smaller are rather broken, where that is not said otherwise. */
const BEARABLE = 0.78;

/** @param {{command: string, class?: string}} context  only classes, and only those that carry the colours of formulas */
const onlyClasses = (context) => context.command === "\\htmlClass" && areOfFormulas(context.class ?? "");

/** What has a name is heard by it, and not a second time. @param {HTMLElement} element */
export const isNamed = (element) => element.hasAttribute("aria-label");

/** @param {HTMLElement} element @param {string} latex @param {boolean} display @param {"html" | "mathml" | "htmlAndMathml"} [output]  to be seen, to be heard, or both */
export function typeset(element, latex, display, output = isNamed(element) ? "html" : "htmlAndMathml") {
  try {
    globalThis.katex.render(airy(latex), element, {
      displayMode: display,
      output,
      trust: onlyClasses,
      strict: "ignore",
      throwOnError: true,
      maxExpand: 1000,
      maxSize: 10,
    });
  } catch {
    element.textContent = latex;
    element.classList.add("untypeset");
  }
}

/** How small a formula may become where it stands. @param {CSSStyleDeclaration} style */
export const bearableIn = (style) => Number(style.getPropertyValue("--bearable")) || BEARABLE;

/** Whether rows that have room in one row share it where the formula stands, and whether it is in shorthand. @param {CSSStyleDeclaration} style */
export function rowsIn(style) {
  const asked = style.getPropertyValue("--rows").trim();
  return { close: asked === "close" || asked === "brief", brief: asked === "brief" };
}

/** Sets a formula to a part of its size; below the smallest one it scrolls. @param {HTMLElement} element @param {number} part */
export function resize(element, part) {
  element.style.setProperty("--fit", String(Math.max(SMALLEST, part)));
  element.classList.toggle("wide", part < SMALLEST);
}
