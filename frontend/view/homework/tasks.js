/** The tasks with what has been earned, the student's own values, and the file of their work. */

import { html, nothing } from "lit-html";
import { inLanguage } from "../../model/catalog.js";
import { pointsOf } from "../../model/homework/sheet.js";
import { prose } from "../formula.js";
import { icon } from "../icons.js";

/** @typedef {import("./page.js").HomeworkView} HomeworkView */
/** @typedef {import("../../model/homework/sheet.js").Entry} Entry */

/** @param {HomeworkView} view */
export function tasks(view) {
  const { state, t } = view;
  return html`<nav class="tasks" aria-label=${t("homework.tasks")}>
    ${total(view)}
    <ol>${(state.sheet?.entries ?? []).map((entry, index) => row(view, entry, index))}</ol>
    ${own(view)}
  </nav>`;
}

/** @param {HomeworkView} view */
function total({ state, t, draftOf }) {
  if (!state.sheet) return nothing;
  const { earned, of, solved, count } = pointsOf(state.sheet, draftOf);
  const { lang } = state.asked.place;
  const said = t("homework.total", { earned: earned.toLocaleString(lang), of: of.toLocaleString(lang) });
  return html`<div class="total"><div class="bar" role="img" aria-label=${t("homework.solved", { solved, count })}><span style="transform:scaleX(${count ? solved / count : 0})"></span></div><p>${said}</p></div>`;
}

/** @param {HomeworkView} view @param {Entry} entry @param {number} index */
function row({ state, t, draftOf, exercise, link, follow }, entry, index) {
  const draft = draftOf(entry.key);
  const status = draft.solved
    ? "solved"
    : draft.checked
      ? draft.checked.verdict.outcome
      : draft.texts.latex.concat(draft.texts.plain).some((text) => text.trim())
        ? "begun"
        : "";
  const before = state.sheet?.entries[index - 1];
  const { lang } = state.asked.place;
  return html`
    ${state.assignment && before?.group !== entry.group ? html`<li class="of-scene">${inLanguage(entry.scene.title, lang)}</li>` : nothing}
    <li><a class="task" data-status=${status || nothing} href=${link({ task: entry.id, side: "task" })} aria-current=${entry.key === state.entry?.key ? "true" : nothing}
      @click=${(/** @type {Event} */ event) =>
        follow(event, () => {
          exercise.turn(["task", "working"].includes(state.asked.side) ? state.asked.side : "task");
          exercise.show(entry);
        })}>
      <span class="tick" aria-hidden="true">${status === "solved" ? icon("verified") : nothing}</span><span>${prose(entry.task.title)}</span>
      ${status ? html`<span class="unseen">${t(`homework.status-${status}`)}</span>` : nothing}</a></li>`;
}

/** @param {HomeworkView} view */
function own({ state, t, exercise, download, upload }) {
  const take = async (/** @type {Event} */ event) => {
    const input = /** @type {HTMLInputElement} */ (event.target);
    const [file] = input.files ?? [];
    if (file) await upload(file);
    input.value = "";
  };
  const asks = state.assignment?.individual === true && !state.asked.seed;
  const seed = (/** @type {Event} */ event) =>
    void exercise.individual(/** @type {HTMLInputElement} */ (event.target).value.trim());
  return html`<div class="own">
    <label class="field seed"><span>${t("homework.seed")}</span><input type="text" maxlength="64" autocomplete="off" spellcheck="false" .value=${state.asked.seed} placeholder=${t("homework.seed-none")} @change=${seed}></label>
    <p class="so ${asks ? "asks" : ""}" role="status">${t(asks ? "homework.seed-wanted" : "homework.seed-help")}</p>
    <div class="files-of-work"><button class="quiet framed small" @click=${download}>${t("homework.export")}</button>
      <label class="quiet framed small load"><input class="unseen" type="file" accept=".json,.toml,application/json" @change=${take}>${t("homework.import")}</label></div>
  </div>`;
}
