/** A value for a field that somebody may be typing in: it is written only when the field is left alone. */

import { noChange } from "lit-html";
import { Directive, directive } from "lit-html/directive.js";
import { setCommittedValue } from "lit-html/directive-helpers.js";

class Settled extends Directive {
  /** @param {string} value */
  render(value) {
    return value;
  }

  /** @override @param {import("lit-html/directive.js").PropertyPart} part @param {[string]} values */
  update(part, [value]) {
    const field = /** @type {HTMLInputElement} */ (part.element);
    if (field === document.activeElement || field.value === value) return noChange;
    setCommittedValue(part);
    return value;
  }
}

export const settled = directive(Settled);
