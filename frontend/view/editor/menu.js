/** Where a scene comes from and where it goes: examples, files, the link. */

import { html, nothing } from "lit-html";
import { offer, toClipboard } from "../files.js";
import { icon } from "../icons.js";
import { problemsIn } from "../../model/attempts.js";
import { inLanguage } from "../../model/catalog.js";
import { completed, fragmentOf, tableOf } from "../../model/own.js";
import { jsonOf } from "../../model/editor/editor.js";
import { copyOf, EMPTY } from "../../model/editor/templates.js";
import { tomlOf } from "../../model/editor/toml.js";

/** @typedef {import("./editor.js").Sheet} Sheet */

const LARGEST_FILE = 400_000;

/** @param {Sheet} sheet */
export function menu(sheet) {
  const { t } = sheet;
  return html`
    <div class="menu">
      ${beginnings(sheet)}
      <button class="quiet small" @click=${() => void copyLink(sheet)}>${t("editor.link")}</button>
      <details class="files" @click=${close} @change=${close}>
        <summary>${t("editor.file")}</summary>
        <div>
          <button class="quiet" @click=${() => save(sheet, "json")}>${t("editor.save-json")}</button>
          <button class="quiet" @click=${() => save(sheet, "toml")}>${t("editor.save-toml")}</button>
          <label class="load"><input class="unseen" type="file" accept=".json,.toml,application/json,application/toml" @change=${(/** @type {Event} */ e) => void load(sheet, e)}>${t("editor.load-json")}</label>
        </div>
      </details>
    </div>`;
}

/** A choice made, the list closes. @param {Event} event */
function close(event) {
  const details = /** @type {HTMLDetailsElement} */ (event.currentTarget);
  if (event.type === "change" || event.target instanceof HTMLButtonElement) details.open = false;
}

/** What to start from: nothing, a built-in scene, or a scene that was set aside. @param {Sheet} sheet */
function beginnings({ state, editing, writing, api, t }) {
  const { lang } = state.place;
  const chosen = async (/** @type {Event} */ event) => {
    const select = /** @type {HTMLSelectElement} */ (event.target);
    const [kind, name] = select.value.split(":");
    select.value = "";
    if (kind === "empty") editing.begin(EMPTY);
    else if (kind === "earlier") editing.begin(writing.earlier[Number(name)]);
    else
      await api.scene(name, lang).then(
        (scene) => editing.begin(copyOf(scene)),
        () => editing.tell("failure.unreachable"),
      );
  };
  return html`<label class="choice"><span class="unseen">${t("editor.start")}</span>
    <select @change=${chosen}>
      <option value="" selected>${t("editor.start")}</option>
      <option value="empty:">${t("editor.empty")}</option>
      <optgroup label=${t("editor.examples")}>${state.scenes.map((scene) => html`<option value=${`scene:${scene.id}`}>${inLanguage(scene.title, lang)}</option>`)}</optgroup>
      ${writing.earlier.length ? html`<optgroup label=${t("editor.earlier")}>${writing.earlier.map((one, i) => html`<option value=${`earlier:${i}`}>${titleOf(one, lang)}</option>`)}</optgroup>` : nothing}
    </select>${icon("chevron")}</label>`;
}

/** @param {import("../../model/own.js").SceneDocument} document @param {string} lang */
const titleOf = (document, lang) => inLanguage(completed(document).title, lang) || String(document.id ?? "");

/** @param {Sheet} sheet */
async function copyLink({ writing, editing, state }) {
  const fragment = await fragmentOf(writing.document);
  const address = `${location.origin}${location.pathname}?scene=own&lang=${state.place.lang}${fragment}`;
  editing.tell((await toClipboard(address)) ? "editor.link-copied" : "editor.link-refused");
}

/** @param {Sheet} sheet @param {"json" | "toml"} format */
function save({ writing }, format) {
  const text = format === "json" ? (writing.text ?? jsonOf(writing.document)) : tomlOf(writing.document);
  offer(
    `${String(writing.document.id ?? "scene").replace(/[^\w-]/g, "_") || "scene"}.${format}`,
    text,
    `application/${format}`,
  );
}

/** @param {Sheet} sheet @param {Event} event */
async function load({ editing, api, state }, event) {
  const input = /** @type {HTMLInputElement} */ (event.target);
  const file = input.files?.[0];
  input.value = "";
  if (!file) return;
  try {
    const text = file.size <= LARGEST_FILE ? await file.text() : "";
    const read = tableOf(
      file.name.endsWith(".toml") ? (await api.readToml(text, state.place.lang)).scene : JSON.parse(text),
    );
    if (read) editing.begin(read);
    else editing.tell("editor.load-refused");
  } catch (error) {
    editing.tell(problemsIn(error)[0]?.message ?? "editor.load-refused");
  }
}
