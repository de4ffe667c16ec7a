/** One field of the question: label, input, and what is wrong with it, at the very letter. */

import { html, nothing } from "lit-html";
import { marked } from "../../model/editor/problems.js";

/** @typedef {import("./page.js").VariationsView} VariationsView */
/** @typedef {import("../../model/types.js").Problem} Problem */

/** @param {Event} event */
export const typed = (event) => /** @type {HTMLInputElement} */ (event.target).value;
/** @param {string} pointer */
const idOf = (pointer) => `field${pointer.replaceAll("/", "-")}`;

/** What the server says of a field or of what lies in it. @param {VariationsView} view @param {string} pointer */
export const problemsAt = ({ asking }, pointer) =>
  [...asking.problems, ...asking.numericProblems].filter(
    (one) => one.pointer === pointer || one.pointer.startsWith(`${pointer}/`),
  );

/** @param {VariationsView} view @param {Problem} problem @param {string} text */
function complaint({ lab, t }, problem, text) {
  const parts = marked(text, problem);
  const name = parts && /^\w+$/.test(parts[1]) && problem.code === "unknown-name" ? parts[1] : "";
  return html`
    ${parts ? html`<code class="where" aria-hidden="true">${parts[0]}<mark>${parts[1]}</mark>${parts[2]}</code>` : nothing}
    <p class="wrong">${problem.message}</p>
    ${
      name
        ? html`<p class="ways">${
            /** @type {const} */ (["parameters", "functions"]).map(
              (list) => html`
      <button class="quiet small" type="button" @click=${() => lab.declare(list, name)}>${t(`variations.declare-${list}`, { name })}</button>`,
            )
          }</p>`
        : nothing
    }`;
}

/**
 * @param {VariationsView} view @param {string} pointer @param {unknown} label @param {string} value @param {(text: string) => void} change
 * @param {{className?: string, help?: string, placeholder?: string}} [look]
 */
export function field(view, pointer, label, value, change, { className = "", help = "", placeholder = "" } = {}) {
  const found = problemsAt(view, pointer);
  const why = `${idOf(pointer)}-why`;
  return html`
    <div class="field ${className}" data-pointer=${pointer}>
      <label for=${idOf(pointer)} title=${help || nothing}>${label}</label>
      <input id=${idOf(pointer)} type="text" autocomplete="off" autocapitalize="off" spellcheck="false" maxlength="2000" placeholder=${placeholder || nothing}
        aria-invalid=${String(found.length > 0)} aria-describedby=${found.length ? why : nothing} .value=${value} @input=${(/** @type {Event} */ e) => change(typed(e))}>
      ${found.length ? html`<div class="complaints" id=${why} role="alert">${found.map((problem) => complaint(view, problem, value))}</div>` : nothing}
    </div>`;
}

/** A few ways, of which one holds. @template {string} K @param {string} label @param {readonly K[]} options @param {K} value @param {(one: K) => void} choose @param {(one: K) => string} say */
export const segments = (label, options, value, choose, say) => html`
  <div class="segments" role="group" aria-label=${label}>${options.map(
    (one) => html`
    <button type="button" aria-pressed=${String(one === value)} @click=${() => choose(one)}>${say(one)}</button>`,
  )}</div>`;
