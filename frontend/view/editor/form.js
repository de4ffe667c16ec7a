/** The scene as a form: what it is called, then its parts, row by row. */

import { html, nothing } from "lit-html";
import { icon } from "../icons.js";
import { added, inDimension, ofKind, removed, shifted } from "../../model/editor/changes.js";
import { dimensionOf, fieldsOf, memberOf, rowsOf, SECTIONS } from "../../model/editor/schema.js";
import { rowFor } from "../../model/editor/templates.js";
import { completed, tableOf } from "../../model/own.js";
import { verticalOf } from "../../model/drawing/sketch.js";
import { choice, complaints, fieldOf, line } from "./field.js";

/** @typedef {import("./editor.js").Sheet} Sheet */
/** @typedef {import("../../model/editor/schema.js").Section} Section */

/** @param {Sheet} sheet */
export function form(sheet) {
  const { t, writing } = sheet;
  return html`
    <form class="form" ?inert=${writing.unread !== ""} @submit=${(/** @type {Event} */ e) => e.preventDefault()}>
      ${complaints(sheet, "")}
      ${about(sheet)}
      ${SECTIONS.map((section) => part(sheet, section))}
      <section class="part"><h2>${t("editor.drawing")}</h2>${drawing(sheet)}</section>
    </form>`;
}

/** @param {Sheet} sheet */
function about(sheet) {
  const { t, state, writing } = sheet;
  const { document } = writing;
  const { lang } = state.place;
  const text = (/** @type {"title" | "summary"} */ key) => {
    const given = document[key];
    const table = tableOf(given);
    const change = (/** @type {string} */ value) =>
      sheet.put(`/${key}`, { ...(typeof given === "string" ? { de: given, en: given } : table), [lang]: value });
    return line(
      sheet,
      `/${key}`,
      t(`editor.field.${key}`),
      typeof given === "string" ? given : (table?.[lang] ?? table?.en),
      change,
      { className: "wide" },
    );
  };
  return html`
    <section class="part about">
      <div class="fields">
        ${text("title")}${text("summary")}
        ${line(sheet, "/id", t("editor.field.id"), document.id, (id) => sheet.put("/id", id), { className: "name" })}
        ${choice(sheet, "/dimension", t("editor.field.dimension"), String(dimensionOf(document)), { options: ["2", "3"], say: (d) => t(`editor.dimension.${d}`) }, (d) => sheet.editing.edit(inDimension(document, Number(d))))}
      </div>
    </section>`;
}

/** @param {Sheet} sheet @param {Section} section */
function part(sheet, section) {
  const { t, writing, editing } = sheet;
  const { key } = section;
  const name = t(`editor.${key}`);
  return html`
    <section class="part" aria-label=${name} data-section=${key}>
      <h2>${name}</h2>
      ${complaints(sheet, `/${key}`)}
      ${rowsOf(writing.document[key]).map((row, index) => card(sheet, section, row, index))}
      <button type="button" class="quiet add" @click=${() => editing.edit(added(writing.document, key, rowFor(writing.document, key)))}>
        ${icon("add")}${t(`editor.add.${key}`)}</button>
    </section>`;
}

/** @param {Sheet} sheet @param {Section} section @param {unknown} row @param {number} index */
function card(sheet, section, row, index) {
  const { t, writing } = sheet;
  const { key, kinds } = section;
  const [first, ...others] = fieldsOf(section, row, dimensionOf(writing.document));
  const kind =
    kinds &&
    choice(
      sheet,
      `/${key}/${index}/kind`,
      t("editor.field.kind"),
      String(memberOf(row, "kind") ?? ""),
      { options: Object.keys(kinds), say: (one) => t(`editor.kind.${one}`) },
      (one) => sheet.editing.edit(ofKind(writing.document, key, index, one)),
    );
  const asked = others.filter((field) => !field.optional);
  const beside = others.filter((field) => field.optional);
  const fields = key === "coordinates" || key === "parameters" ? others : [...asked, ...beside];
  return html`
    <fieldset class="card">
      <legend class="unseen">${t(`editor.${key}`)} ${index + 1}: ${memberOf(row, "name") ?? memberOf(row, "coordinate") ?? ""}</legend>
      <div class="fields">
        ${fieldOf(sheet, { section: key, index, row }, first)}${kind ?? nothing}
        ${fields.map((field) => fieldOf(sheet, { section: key, index, row }, field))}
      </div>
      ${complaints(sheet, `/${key}/${index}`)}
      ${tools(sheet, key, index)}
    </fieldset>`;
}

/** @param {Sheet} sheet @param {string} key @param {number} index */
function tools({ t, writing, editing }, key, index) {
  const { document } = writing;
  const last = rowsOf(document[key]).length - 1;
  const move = (/** @type {number} */ by) => editing.edit(shifted(document, key, index, by));
  return html`
    <div class="row-tools">
      <button type="button" class="tool" title=${t("editor.up")} aria-label=${t("editor.up")} ?disabled=${index === 0} @click=${() => move(-1)}>${icon("up")}</button>
      <button type="button" class="tool" title=${t("editor.down")} aria-label=${t("editor.down")} ?disabled=${index === last} @click=${() => move(1)}>${icon("chevron")}</button>
      <button type="button" class="tool" title=${t("editor.remove")} aria-label=${t("editor.remove")} @click=${() => editing.edit(removed(document, key, index))}>${icon("close")}</button>
    </div>`;
}

/** @param {Sheet} sheet */
function drawing(sheet) {
  const { t, writing } = sheet;
  const count = rowsOf(memberOf(writing.document.drawing, "elements")).length;
  const vertical = verticalOf(completed(writing.document));
  return html`
    <div class="card"><div class="fields">
      ${choice(sheet, "/drawing", t("editor.vertical"), vertical, { options: ["down", "up"], say: (one) => t(`editor.vertical.${one}`) }, (one) => sheet.put("/drawing/vertical", one))}
    </div>
    <p class="hint">${count ? t("editor.drawing-own", { count }) : t("editor.drawing-automatic")}
      ${count ? html`<button type="button" class="quiet small" @click=${() => sheet.put("/drawing", { vertical })}>${t("editor.drawing-reset")}</button>` : nothing}</p></div>`;
}
