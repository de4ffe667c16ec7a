/** The editor beside the drawing: form, JSON and TOML of one scene, and what the server makes of it. */

import { html, nothing } from "lit-html";
import { inline } from "../formula.js";
import { icon } from "../icons.js";
import { jsonOf } from "../../model/editor/editor.js";
import { isWarning, placed } from "../../model/editor/problems.js";
import { tomlOf } from "../../model/editor/toml.js";
import { written } from "../../model/editor/changes.js";
import { form } from "./form.js";
import { menu } from "./menu.js";

/**
 * @typedef {import("../page.js").View & {editing: import("../../model/editor/editor.js").Editor,
 *   api: Pick<import("../../model/api.js").Api, "scene" | "readToml">}} EditorView
 * @typedef {EditorView & {writing: import("../../model/editor/editor.js").Writing,
 *   problems: Map<string, import("../../model/types.js").Problem[]>, put: (pointer: string, value: unknown) => void}} Sheet
 */

const SIDES = /** @type {const} */ (["form", "json", "toml"]);

/** @param {EditorView} view */
export function editorView(view) {
  const { editing, state } = view;
  const writing = editing.get();
  const put = (/** @type {string} */ pointer, /** @type {unknown} */ value) =>
    editing.edit(written(editing.get().document, pointer, value));
  const sheet = { ...view, writing, put, problems: placed(writing.problems, writing.document) };
  return html`
    <div class="sides">${tabs(sheet)}${menu(sheet)}</div>
    <div class="scroll">
      ${notice(sheet)}
      ${state.place.edit === "json" ? json(sheet) : state.place.edit === "toml" ? toml(sheet) : html`${unread(sheet)}${form(sheet)}`}
    </div>
    ${verdict(sheet)}`;
}

/** @param {Sheet} sheet */
function tabs({ state, session, t }) {
  return html`<div class="segments" role="group" aria-label=${t("editor.sides")}>${SIDES.map(
    (side) => html`
    <button aria-pressed=${String(state.place.edit === side)} @click=${() => session.move({ edit: side })}>${t(`editor.side.${side}`)}</button>`,
  )}</div>`;
}

/** @param {Sheet} sheet */
function notice({ writing, editing, t }) {
  if (!writing.kept) return html`<p class="warning">${t("editor.not-kept")}</p>`;
  if (!writing.notice) return nothing;
  const back = writing.notice === "editor.set-aside";
  return html`<p class="warning" role="status">${t(writing.notice)}
    ${back ? html`<button class="quiet small" @click=${editing.undo}>${t("editor.undo")}</button>` : nothing}</p>`;
}

/** The form waits while the JSON cannot be read: it must not overwrite what was typed. @param {Sheet} sheet */
function unread({ writing, editing, session, t }) {
  if (!writing.unread) return nothing;
  return html`<p class="warning" role="alert">${t("editor.unread-form")}
    <button class="quiet small" @click=${() => session.move({ edit: "json" })}>${t("editor.unread-go")}</button>
    <button class="quiet small" @click=${editing.untype}>${t("editor.unread-drop")}</button></p>`;
}

/** @param {Sheet} sheet */
function json({ writing, editing, t }) {
  const text = writing.text ?? jsonOf(writing.document);
  const listed = writing.unread ? [] : writing.problems;
  return html`
    <div class="source">
      ${writing.unread ? html`<p class="wrong" role="alert">${t("editor.unread")} <code>${writing.unread}</code></p>` : nothing}
      <ul class="found">${listed.map((problem) => html`<li class=${isWarning(problem) ? "advice" : "wrong"}><code>${problem.pointer || "/"}</code> ${problem.message}</li>`)}</ul>
      <textarea aria-label=${t("editor.side.json")} spellcheck="false" autocapitalize="off" .value=${text}
        @input=${(/** @type {Event} */ e) => editing.type(/** @type {HTMLTextAreaElement} */ (e.target).value)}></textarea>
    </div>`;
}

/** @param {Sheet} sheet */
function toml({ writing, t }) {
  return html`<div class="source"><p class="hint">${t("editor.toml-hint")}</p>
    <pre class="toml" tabindex="0" aria-label=${t("editor.side.toml")}>${tomlOf(writing.document)}</pre></div>`;
}

/** What the server says, the equations as soon as there are any, and the way to the derivation. @param {Sheet} sheet */
function verdict({ writing, state, session, editing, t }) {
  const errors = writing.problems.filter((problem) => !isWarning(problem)).length;
  const warnings = writing.problems.length - errors;
  const valid = writing.verdict === "valid";
  const equations = valid ? (state.derivation?.result?.equations ?? []) : [];
  const failed = valid ? state.failures.derivation : null;
  return html`
    <div class="verdict-bar ${writing.verdict}">
      ${equations.length ? html`<div class="equations" tabindex="0" role="region" aria-label=${t("editor.equations")}>${equations.map(({ latex }) => html`<div>${inline(latex)}</div>`)}</div>` : nothing}
      ${failed ? html`<p class="wrong" role="alert">${failed.detail || failed.title}</p>` : nothing}
      <div class="line"><p role="status">
        ${valid ? icon("verified") : nothing}
        <span>${writing.verdict === "invalid" ? t("editor.invalid", { count: errors }) : t(`editor.${writing.verdict}`)}</span>
        ${warnings && writing.verdict !== "waiting" ? html`<span class="advice">${t("editor.warnings", { count: warnings })}</span>` : nothing}
        ${writing.verdict === "unreachable" ? html`<button class="quiet small" @click=${editing.again}>${t("retry")}</button>` : nothing}</p>
        <button class="main" ?disabled=${!valid} @click=${() => session.move({ edit: "" })}>${t("editor.derive")}${icon("next")}</button>
      </div>
    </div>`;
}
