/** Formulas: KaTeX into the DOM, made to fit their column; what KaTeX refuses is shown as plain text. */

import { html, nothing } from "lit-html";
import { Directive, directive } from "lit-html/directive.js";

/** Display formulas shrink to this part of their size, 11 pixels on a phone, before they scroll. */
export const SMALLEST = 0.56;
/** Formulas that would become smaller are rather broken, where that is not said otherwise. */
export const BEARABLE = 0.78;
/** LaTeX of more letters is typeset row by row. */
const LONG = 600;
/** Milliseconds for which formulas are typeset in one go, and after which those nobody sees have waited long enough. */
const SLICE = 8, IMPATIENCE = 300;

/** @param {{command: string}} context  only classes, which carry the colours, and only in LaTeX from the server */
const onlyClasses = (context) => context.command === "\\htmlClass";

/** @param {HTMLElement} element @param {string} latex @param {boolean} display @param {"html" | "mathml" | "htmlAndMathml"} [output]  to be seen, to be heard, or both */
export function typeset(element, latex, display, output = "htmlAndMathml") {
  try {
    globalThis.katex.render(latex, element, {
      displayMode: display, output, trust: onlyClasses, strict: "ignore", throwOnError: true, maxExpand: 1000, maxSize: 10,
    });
  } catch {
    element.textContent = latex;
    element.classList.add("untypeset");
  }
}

const fitter = new ResizeObserver((entries) => fit(entries.map(({ target }) => /** @type {HTMLElement} */ (target))));
/** @type {WeakMap<HTMLElement, number>} */
const fittedWidths = new WeakMap();

/** What each display formula says. @type {WeakMap<HTMLElement, string>} */
const sources = new WeakMap();
/** Those that are typeset row by row. @type {WeakSet<HTMLElement>} */
const inRows = new WeakSet();
/** How that is done is fetched when there is one. @type {typeof import("./rows.js") | null} */
let rows = null;

/** What a long step has out of sight has a size, but its content has none yet. @param {HTMLElement} element */
const laidOut = ({ firstElementChild: content }) => !content || content.checkVisibility({ contentVisibilityAuto: true });

/** Sets the sizes at which formulas fit their columns; those that would become too small go on below. @param {HTMLElement[]} elements */
function fit(elements) {
  const seen = elements.filter((element) => element.clientWidth > 0 && laidOut(element));
  rows?.arrange(seen.filter((element) => inRows.has(element)));
  const due = seen.filter((element) => !inRows.has(element) && fittedWidths.get(element) !== element.clientWidth);
  // A lecture would rather have more lines than smaller ones.
  for (const { element } of shrink(due).filter(({ part, bearable }) => part < bearable)) void giveRows(element);
}

/**
 * Shrinks what is too wide. All is measured before anything is written, so that the page is laid out once and not for each.
 * @param {HTMLElement[]} elements
 */
function shrink(elements) {
  for (const element of elements) element.style.removeProperty("--fit");
  const found = elements.map((element) => {
    const [width, needed] = [element.clientWidth, element.scrollWidth];
    const part = needed > width ? Math.floor((width / needed) * 98) / 100 : 1;
    const bearable = part < 1 ? Number(getComputedStyle(element).getPropertyValue("--bearable")) || BEARABLE : 0;
    return { element, width, part, bearable };
  });
  for (const { element, width, part } of found) {
    fittedWidths.set(element, width);
    if (part < 1) element.style.setProperty("--fit", String(Math.max(SMALLEST, part)));
    element.classList.toggle("wide", part < SMALLEST);
  }
  return found;
}

/** There will be long formulas: how they are typeset is fetched before. */
export const expectLong = async () => (rows ??= await import("./rows.js").catch(() => null));

/** Typesets a formula row by row, as it is seen. @param {HTMLElement} element */
async function giveRows(element) {
  inRows.add(element);
  const late = !rows;
  if (late) await expectLong();
  rows?.tell(element, sources.get(element) ?? "");
  fitSoon(element);
  if (late) element.dispatchEvent(new CustomEvent("grown", { bubbles: true }));
}

/**
 * Does the first of some things, if there is one, and more as long as there is time; takes away and returns what was done.
 * @template T
 * @param {number} time in milliseconds @param {T[]} things @param {(thing: T) => void} act
 */
function during(time, things, act) {
  const end = performance.now() + time;
  let done = 0;
  while (done < things.length && (done === 0 || performance.now() < end)) act(things[done++]);
  return things.splice(0, done);
}

// What was measured before the fonts of the formulas had come was not their width; what nobody sees is not measured at all.
document.fonts.addEventListener("loadingdone", () => document.querySelectorAll(".formula").forEach((element) => fitSoon(/** @type {HTMLElement} */ (element))));

/** When it is laid out; what is observed anew is told of once, even if it has not changed. @param {HTMLElement} element */
function fitSoon(element) {
  fittedWidths.delete(element);
  fitter.unobserve(element);
  fitter.observe(element);
}

/** Formulas that nobody sees yet, in the order in which they came. @type {Map<HTMLElement, () => void>} */
const waiting = new Map();
const whenIdle = window.requestIdleCallback ?? ((/** @type {() => void} */ work) => setTimeout(work, 30));

function work() {
  during(SLICE, [...waiting.keys()], catchUp);
  if (waiting.size) whenIdle(work, { timeout: IMPATIENCE });
}

const catchUp = (/** @type {HTMLElement} */ element) => {
  if (element.isConnected) waiting.get(element)?.();
  waiting.delete(element);
};

const waitingIn = (/** @type {Node} */ place) => [...waiting.keys()].filter((element) => place.contains(element));

/** A formula of a long step has been scrolled to; or it, or a whole step, has gone out of sight. @param {EventTarget | null} target @param {boolean} [gone] */
export function fitSeen(target, gone = false) {
  if (!(target instanceof HTMLElement)) return;
  if (gone) rows?.rest(sources.has(target) ? [target] : target.querySelectorAll(".formula"));
  else if (sources.has(target)) fitSoon(target);
  rows?.wake();
}

/** Formulas that somebody sees now. @type {HTMLElement[]} */
const sought = [];

/** What has come into view is typeset before all others, so many at once that scrolling goes on; what closed details hide goes on waiting. @param {Node} place */
export function typesetWithin(place) {
  if (!sought.length) requestAnimationFrame(seek);
  sought.push(...waitingIn(place).filter((element) => !element.closest("details:not([open])")));
}

function seek() {
  during(SLICE, sought, catchUp);
  if (sought.length) requestAnimationFrame(seek);
}

/** All that still waits, at once, at its size and with its rows: for paper. */
export function typesetAll() {
  waitingIn(document).forEach(catchUp);
  fit([.../** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll(".formula"))]);
  rows?.finish();
}
window.addEventListener("beforeprint", typesetAll);

class Typeset extends Directive {
  latex = "";

  /** @param {string} _latex @param {boolean} _display @param {boolean} _later */
  render(_latex, _display, _later) {
    return nothing;
  }

  /** @param {import("lit-html").ElementPart} part @param {[string, boolean, boolean]} values */
  update(part, [latex, display, later]) {
    const element = /** @type {HTMLElement} */ (part.element);
    const unseen = later && !element.closest("details[open]");
    // A step that was far may be near now.
    rows?.wake();
    if (latex === this.latex && (unseen || !waiting.has(element))) return nothing;
    this.latex = latex;
    if (unseen && !waiting.size) whenIdle(work, { timeout: IMPATIENCE });
    if (unseen) waiting.set(element, () => set(element, latex, display));
    else set(element, latex, display, true);
    return nothing;
  }
}

/** @param {HTMLElement} element @param {string} latex @param {boolean} display @param {boolean} [atOnce]  it is seen now */
function set(element, latex, display, atOnce = false) {
  waiting.delete(element);
  if (!display) return typeset(element, latex, display);
  sources.set(element, latex);
  const inTurn = latex.length > LONG || inRows.has(element);
  if (!inTurn || (atOnce && !rows)) typeset(element, latex, display);
  if (inTurn) void giveRows(element);
  else fitSoon(element);
}

const typesetInto = directive(Typeset);

/** A formula within a line. @param {string} latex @param {string} [className] @param {boolean} [later] it is not seen yet */
export const inline = (latex, className = "", later = false) => html`<span class="math ${className}" ${typesetInto(latex, false, later)}></span>`;

/** A formula on a line of its own. @param {string} latex @param {boolean} [later] it is not seen yet */
export const displayed = (latex, later = false) => html`<div class="formula" tabindex="-1" ${typesetInto(latex, true, later)}></div>`;

/** A sentence with formulas between dollar signs. @param {string} text @param {boolean} [later] it is not seen yet */
export const prose = (text, later = false) => text.split("$").map((part, i) => (i % 2 ? inline(part, "", later) : part));

/** A sentence without markup, for titles and screen readers. @param {string} text */
export const plainly = (text) => text.replace(/\$[^$]*\$/g, (formula) => formula.slice(1, -1).replace(/\\(htmlClass\{[^}]*\}|[a-z]+)|[{}\\]/g, "$1"));
