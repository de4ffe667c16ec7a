/** One field of the form: label, input, formula, and what is wrong with it. */

import { html, nothing } from "lit-html";
import { inline } from "../formula.js";
import { numberText } from "../../model/numbers.js";
import {
  componentsOf,
  dimensionOf,
  isTensor,
  materialOf,
  memberOf,
  nameOf,
  otherInertia,
  rowsOf,
  standardOf,
} from "../../model/editor/schema.js";
import { formulaKey } from "../../model/editor/editor.js";
import { numberOf, renamed } from "../../model/editor/changes.js";
import { isWarning, marked } from "../../model/editor/problems.js";

/** @typedef {import("./editor.js").Sheet} Sheet */
/** @typedef {import("../../model/editor/schema.js").Field} Field */
/** @typedef {{section: string, index: number, row: unknown}} Row */

/** @param {Event} event */
const typed = (event) => /** @type {HTMLInputElement} */ (event.target).value;
/** @param {string} pointer */
const idOf = (pointer) => `field${pointer.replaceAll("/", "-")}`;

/** What is wrong at a place, in sentences, the place in the text marked. @param {Sheet} sheet @param {string} pointer @param {string} [text] */
export function complaints({ problems }, pointer, text = "") {
  const found = problems.get(pointer) ?? [];
  if (!found.length) return nothing;
  return html`<div class="complaints" id=${`${idOf(pointer)}-why`}>${found.map((problem) => {
    const parts = marked(text, problem);
    return html`
      ${parts ? html`<code class="where" aria-hidden="true">${parts[0]}<mark>${parts[1]}</mark>${parts[2]}</code>` : nothing}
      <p class=${isWarning(problem) ? "advice" : "wrong"}>${problem.message}</p>`;
  })}</div>`;
}

/** @param {Sheet} sheet @param {string} pointer */
function aria({ problems }, pointer) {
  const found = problems.get(pointer) ?? [];
  return {
    invalid: String(found.some((problem) => !isWarning(problem))),
    why: found.length ? `${idOf(pointer)}-why` : nothing,
  };
}

/** @param {Sheet} sheet @param {string} pointer @param {string} label @param {unknown} value @param {(text: string) => void} change @param {{className?: string, mode?: string, standard?: string}} [look]  `standard` is what an empty field means */
export function line(sheet, pointer, label, value, change, { className = "", mode = "text", standard = "" } = {}) {
  const text = value === undefined || value === null ? "" : String(value);
  const { invalid, why } = aria(sheet, pointer);
  return html`
    <div class="field ${className}" data-pointer=${pointer}>
      <label for=${idOf(pointer)}>${label}</label>
      <input id=${idOf(pointer)} type="text" inputmode=${mode} autocomplete="off" autocapitalize="off" spellcheck="false" maxlength="4000" placeholder=${standard}
        aria-invalid=${invalid} aria-describedby=${why} .value=${text} @input=${(/** @type {Event} */ e) => change(typed(e))}>
      ${complaints(sheet, pointer, text)}
    </div>`;
}

/** @param {Sheet} sheet @param {string} pointer @param {unknown} label @param {unknown} value @param {string[]} material */
function expression(sheet, pointer, label, value, material) {
  const text = typeof value === "string" ? value : value === undefined ? "" : String(value);
  const formula = sheet.writing.formulas.get(formulaKey(text, material));
  const { invalid, why } = aria(sheet, pointer);
  return html`
    <div class="field expression" data-pointer=${pointer}>
      <label for=${idOf(pointer)}>${label}</label>
      <input id=${idOf(pointer)} type="text" autocomplete="off" autocapitalize="off" spellcheck="false" maxlength="4000"
        aria-invalid=${invalid} aria-describedby=${why} .value=${text} @input=${(/** @type {Event} */ e) => sheet.put(pointer, typed(e))}>
      ${complaints(sheet, pointer, text)}
      <div class="preview">${formula ? inline(formula) : nothing}</div>
    </div>`;
}

/** @param {Sheet} sheet @param {string} pointer @param {string} label @param {string} value @param {{options: string[], say?: (option: string) => string}} from @param {(text: string) => void} change */
export function choice(sheet, pointer, label, value, { options, say = (one) => one }, change) {
  const all = options.includes(value) ? options : [value, ...options];
  const { invalid, why } = aria(sheet, pointer);
  return html`
    <div class="field" data-pointer=${pointer}>
      <label for=${idOf(pointer)}>${label}</label>
      <select id=${idOf(pointer)} aria-invalid=${invalid} aria-describedby=${why} @change=${(/** @type {Event} */ e) => change(typed(e))}>
        ${all.map((one) => html`<option value=${one} ?selected=${one === value}>${one ? say(one) : "–"}</option>`)}
      </select>
      ${complaints(sheet, pointer)}
    </div>`;
}

/** @param {Sheet} sheet @param {string} pointer @param {string} label @param {Row} at @param {string} key */
function vector(sheet, pointer, label, { row }, key) {
  const given = memberOf(row, key);
  const components = componentsOf(given, dimensionOf(sheet.writing.document));
  return html`<div class="vector">${components.map((c) =>
    expression(sheet, `${pointer}/${c}`, html`${label}<sub>${c + 1}</sub>`, rowsOf(given)[c], materialOf(row)),
  )}</div>`;
}

/** Principal moments, or the rows of a tensor. @param {Sheet} sheet @param {string} pointer @param {string} label @param {Row} at @param {string} key */
function tensor(sheet, pointer, label, at, key) {
  const given = memberOf(at.row, key);
  const other = () => sheet.put(pointer, otherInertia(given));
  return html`<div class="tensor">
    ${
      isTensor(given)
        ? rowsOf(given).map(
            (row, k) =>
              html`<div class="vector">${[0, 1, 2].map((l) =>
                expression(
                  sheet,
                  `${pointer}/${k}/${l}`,
                  html`${label}<sub>${k + 1}${l + 1}</sub>`,
                  rowsOf(row)[l],
                  [],
                ),
              )}</div>`,
          )
        : vector(sheet, pointer, label, at, key)
    }
    <div class="actions"><button class="quiet small" @click=${other}>${sheet.t(isTensor(given) ? "editor.inertia-principal" : "editor.inertia-tensor")}</button></div>
  </div>`;
}

/** @param {Sheet} sheet @param {string} pointer @param {unknown} row */
function material(sheet, pointer, row) {
  const { t } = sheet;
  const list = rowsOf(memberOf(row, "material"));
  return html`<div class="material">${list.map(
    (one, i) => html`<div class="vector">
      ${line(sheet, `${pointer}/${i}/name`, t("editor.field.material"), memberOf(one, "name"), (text) => sheet.put(`${pointer}/${i}/name`, text), { className: "narrow" })}
      ${expression(sheet, `${pointer}/${i}/from`, t("editor.field.lower"), memberOf(one, "from"), [])}
      ${expression(sheet, `${pointer}/${i}/to`, t("editor.field.upper"), memberOf(one, "to"), [])}</div>`,
  )}
    ${complaints(sheet, pointer)}
    <div class="actions">
      ${list.length < 3 ? html`<button class="quiet small" @click=${() => sheet.put(`${pointer}/${list.length}`, { name: "suv"[list.length], from: "0", to: "1" })}>${t("editor.material-add")}</button>` : nothing}
      ${list.length > 1 ? html`<button class="quiet small" @click=${() => sheet.put(pointer, list.slice(0, -1))}>${t("editor.material-remove")}</button>` : nothing}
    </div></div>`;
}

/** A number with the decimal mark of the reader's language; text that is none as it is. @param {unknown} value @param {string} lang */
const inLocale = (value, lang) => (typeof value === "number" ? numberText(value, lang) : value);

/** @param {Sheet} sheet @param {Row} at @param {Field} field */
export function fieldOf(sheet, at, { key, type }) {
  const { section, index, row } = at;
  const { document } = sheet.writing;
  const pointer = `/${section}/${index}/${key}`;
  const label = sheet.t(`editor.field.${key}`);
  const value = memberOf(row, key);
  const put = (/** @type {unknown} */ value) => sheet.put(pointer, value);
  const places = [
    ...rowsOf(document.points),
    ...rowsOf(document.bodies).filter((body) => memberOf(body, "kind") !== "continuum"),
  ].map(nameOf);
  const coordinates = rowsOf(document.coordinates).map(nameOf);
  if (type === "vector") return vector(sheet, pointer, label, at, key);
  if (type === "tensor") return tensor(sheet, pointer, label, at, key);
  if (type === "expression") return expression(sheet, pointer, label, value, materialOf(row));
  if (type === "material") return material(sheet, pointer, row);
  if (type === "number")
    return line(sheet, pointer, label, inLocale(value, sheet.state.place.lang), (text) => put(numberOf(text)), {
      className: "narrow",
      mode: "decimal",
      standard: standardOf(section, key),
    });
  if (type === "place") return choice(sheet, pointer, label, String(value ?? ""), { options: places }, put);
  if (type === "coordinate") return choice(sheet, pointer, label, String(value ?? ""), { options: coordinates }, put);
  if (type === "flag")
    return choice(
      sheet,
      pointer,
      label,
      String(value ?? true),
      { options: ["true", "false"], say: (one) => sheet.t(`editor.flag.${one}`) },
      (text) => put(text === "true"),
    );
  if (key === "name")
    return line(sheet, pointer, label, value, (text) => sheet.editing.edit(renamed(document, section, index, text)), {
      className: "name",
    });
  return line(sheet, pointer, label, value, (text) => put(text || undefined), { className: "narrow" });
}
