/** A field for formulas: MathLive's element, fetched when it is first wanted, kept in step with what is kept. */

import { html, nothing } from "lit-html";
import { Directive, directive } from "lit-html/directive.js";
import { paired } from "../../model/homework/fences.js";
import { inRows } from "../../model/homework/keys.js";

/** @typedef {{value: string, change: (latex: string) => void, enter: () => void, shortcuts: Record<string, string>}} Wiring */

/** Named in the import map, so that the addresses carry the version of the libraries. */
const FONTS = import.meta.resolve("katex-fonts/");
/** Milliseconds until MathLive's keyboard has come up from below. */
const RISE = 350;
const IN_A_ROW = 8;
const IN_A_LONG_ROW = 14;
/** A phone held across: fewer rows leave room for the field above them. */
export const low = matchMedia("(max-height: 480px) and (min-width: 560px)");
const coarse = matchMedia("(pointer: coarse)");

/** False if it cannot be had. */
export async function fetchMathLive() {
  try {
    const { MathfieldElement } = await import("mathlive");
    MathfieldElement.fontsDirectory = FONTS;
    MathfieldElement.soundsDirectory = null;
    MathfieldElement.plonkSound = null;
    return true;
  } catch {
    return false;
  }
}

/** Where there is no keyboard to type on, MathLive's own shows the keys of the task. @param {import("../../model/homework/keys.js").Row[]} rows @param {string} label */
export function offerKeys(rows, label) {
  if (!coarse.matches || !window.mathVirtualKeyboard) return;
  const caps = rows
    .filter(({ id }) => id !== "greek")
    .flatMap(({ keys }) => keys.map((key) => ({ latex: key.label, insert: key.latex, tooltip: key.name })));
  const digits = [..."1234567890"].map((digit) => ({ label: digit, key: digit }));
  const acts = ["[left]", "[right]", ",", ";", "[backspace]", "[return]"];
  const layout = {
    label,
    rows: low.matches
      ? [...inRows(caps, IN_A_LONG_ROW), [...digits, ...acts]]
      : [...inRows(caps, IN_A_ROW), digits, acts],
  };
  window.mathVirtualKeyboard.layouts = [layout, "alphabetic", "greek"];
}

class MathField extends Directive {
  /** @type {Wiring | null} */
  wiring = null;
  /** What the field holds: written into it only when something else is wanted, for that would lose the caret. */
  held = "";

  /** @param {Wiring} _wiring */
  render(_wiring) {
    return nothing;
  }

  /** @param {import("lit-html").ElementPart} part @param {[Wiring]} values */
  update(part, [wiring]) {
    const field = /** @type {import("mathlive").MathfieldElement} */ (part.element);
    const first = this.wiring === null;
    const shortcuts = this.wiring?.shortcuts;
    this.wiring = wiring;
    if (first) this.connect(field);
    if (shortcuts !== wiring.shortcuts) whenMounted(field, () => (field.inlineShortcuts = wiring.shortcuts));
    if (this.held !== wiring.value) field.setValue((this.held = wiring.value), { silenceNotifications: true });
    return nothing;
  }

  /** @param {import("mathlive").MathfieldElement} field */
  connect(field) {
    field.addEventListener("input", (event) => {
      keepPairs(field, /** @type {InputEvent} */ (event).inputType);
      this.wiring?.change((this.held = field.getValue("latex-without-placeholders")));
    });
    field.addEventListener(
      "keydown",
      (event) => {
        if (event.key === "Enter") this.wiring?.enter();
        if (event.key === " " && !event.ctrlKey) blank(field, event);
        if (event.key === "^") afterPrimes(field, event);
        if (event.key === "/") overDotted(field, event);
        if (event.key.length === 1 && !event.ctrlKey && !event.metaKey && !/[\d.,^_ ]/.test(event.key))
          leaveNumber(field);
      },
      { capture: true },
    );
    field.addEventListener("focusin", () => {
      if (coarse.matches) setTimeout(() => field.scrollIntoView({ block: "start" }), RISE);
    });
    field.smartFence = true;
    field.mathVirtualKeyboardPolicy = coarse.matches ? "auto" : "manual";
    whenMounted(field, () => (field.menuItems = []));
  }
}

/** The field is alive one frame after it has come onto the page, if it is still there. @param {HTMLElement} field @param {() => void} task */
function whenMounted(field, task) {
  requestAnimationFrame(() => {
    if (field.isConnected) task();
  });
}

/** @param {import("mathlive").MathfieldElement} field @param {string} inputType */
function keepPairs(field, inputType) {
  if (!inputType?.startsWith("deleteContent")) return;
  const mended = paired(field.getValue("latex"), inputType === "deleteContentBackward");
  if (!mended) return;
  const { position } = field;
  field.setValue(mended.latex, { silenceNotifications: true });
  field.position = position + mended.shift;
}

/** What a blank does not lead out of: brackets, and what is still empty. */
const HELD = /^\\left|\\placeholder/;

/** A blank leads out of a fraction or an exponent, and is nothing else: people write it between factors. @param {import("mathlive").MathfieldElement} field @param {Event} event */
function blank(field, event) {
  event.preventDefault();
  event.stopImmediatePropagation();
  const { selection } = field;
  field.executeCommand("moveAfterParent");
  if (HELD.test(field.getElementInfo(field.position)?.latex ?? "")) field.selection = selection;
}

const PRIMED = /\^(\{(\\prime|')+\}|\\prime|')$|'$/;

/** A power of x′ stands behind the prime: MathLive would write it over the prime. @param {import("mathlive").MathfieldElement} field @param {Event} event */
function afterPrimes(field, event) {
  const before = field.getValue(0, field.position, "latex");
  if (!field.selectionIsCollapsed || !PRIMED.test(before)) return;
  event.preventDefault();
  event.stopImmediatePropagation();
  field.executeCommand("moveToSuperscript");
  field.position = field.selection.ranges[0][1];
  // As with x^2: one digit, and the exponent is complete.
  field.addEventListener(
    "input",
    () => /\d\}*$/.test(field.getValue(0, field.position, "latex")) && field.executeCommand("moveAfterParent"),
    {
      once: true,
    },
  );
}

const DOTTED = /^\\d+ot\s*(\{(\\[a-z]+|.)\}|[A-Za-z])(_(\{.*?\}|.))?(\^(\{.*\}|.))?$/i;

/** ẋ and ẋ² are divided as a whole: MathLive would take the exponent alone, and of ẋ nothing. @param {import("mathlive").MathfieldElement} field @param {Event} event */
function overDotted(field, event) {
  const end = field.position;
  if (!field.selectionIsCollapsed || !/^\^|^\\d+ot/.test(field.getElementInfo(end)?.latex ?? "")) return;
  for (let start = end - 1; start >= 0; start -= 1) {
    const latex = field.getValue(start, end, "latex");
    if (!DOTTED.test(latex)) continue;
    event.preventDefault();
    event.stopImmediatePropagation();
    // Not by a selection: at the beginning of a root or the like it would take the whole of it.
    while (field.position > start) field.executeCommand("deleteBackward");
    field.insert(`\\frac{${latex}}{#?}`, { selectionMode: "placeholder" });
    return;
  }
}

/** A fraction with a number below the line, no other one in it. */
const OVER_NUMBER = /^\\[dt]?frac(\d|\{.*\})(\d|\{\d+\})$/;

/**
 * Whoever types 1/2(M+m)… means half of it: a number below the line is complete when something else follows. What goes
 * below the line as well is put in brackets. @param {import("mathlive").MathfieldElement} field
 */
export function leaveNumber(field) {
  if (!field.selectionIsCollapsed) return;
  const { position, selection } = field;
  // Who moves the caret ends the word that MathLive is about to recognize, as sqrt: only behind a digit there is none.
  if (!/^\d$/.test(field.getElementInfo(position)?.latex ?? "")) return;
  field.executeCommand("moveAfterParent");
  const left = field.getElementInfo(field.position)?.latex ?? "";
  const atItsEnd = field.position === position + 1 && OVER_NUMBER.test(left);
  if (!atItsEnd) field.selection = selection;
}

const wired = directive(MathField);

/** @param {string} label @param {Wiring} wiring @param {boolean} invalid @param {string} why  id of what is wrong with it */
export const mathField = (label, wiring, invalid, why) => html`
  <math-field class="entry" aria-label=${label} aria-invalid=${String(invalid)} aria-describedby=${why || nothing} ${wired(wiring)}></math-field>`;
