/** Handing in: who it is, what there is to be handed in, until when, and the file. */

import { html, nothing } from "lit-html";
import { answersOf, createWho, fileName, handIn } from "../../model/homework/handin.js";
import { inLanguage } from "../../model/catalog.js";
import { offer } from "../files.js";
import { prose } from "../formula.js";
import { icon } from "../icons.js";

/** @typedef {import("./page.js").HomeworkView} HomeworkView */

/** @param {HomeworkView} view */
export function handingIn(view) {
  const { state, t, progress } = view;
  const { sheet, assignment } = state;
  if (!assignment || !sheet) return html`<p class="classroom prose">${t("homework.handin-no-sheet")}</p>`;
  const answers = answersOf(sheet.entries, progress);
  const answered = new Set(answers.map(({ task }) => task));
  const who = createWho(progress).get();
  const name = assignment.individual ? state.asked.seed : who.name;
  const submit = (/** @type {SubmitEvent} */ event) => {
    event.preventDefault();
    const title = inLanguage(sheet.title, state.asked.place.lang) || "deltaq";
    offer(
      `${fileName(title, name)}.json`,
      handIn(sheet.code, { ...who, name }, answers, new Date()),
      "application/json",
    );
    view.notice("homework.handin-saved");
  };
  return html`<form class="classroom handin" aria-label=${t("homework.side-handin")} @submit=${submit}>
    <h2>${t("homework.side-handin")}</h2>
    <p class="prose">${t("homework.handin-help")}</p>
    ${rules(view)}
    <ol class="to-hand-in">${sheet.entries.map(
      (
        entry,
      ) => html`<li data-there=${String(answered.has(Number(entry.id)))}><span class="tick" aria-hidden="true">${answered.has(Number(entry.id)) ? icon("verified") : nothing}</span>
      <span>${prose(entry.task.title)}</span><span class="so">${t(answered.has(Number(entry.id)) ? "homework.handin-there" : "homework.handin-missing")}</span></li>`,
    )}</ol>
    <div class="fields">${whose(view, name, who.id)}</div>
    <p class="acts"><button class="main" ?disabled=${!name.trim() || !answers.length}>${t("homework.handin-save")}</button></p>
    <p class="notice-line" role="status">${state.notice ? t(state.notice) : name.trim() ? nothing : t("homework.handin-name-wanted")}</p>
    <p class="so">${t("homework.code", { code: sheet.code })}</p>
  </form>`;
}

/** @param {HomeworkView} view @param {string} name @param {string} id */
function whose(view, name, id) {
  const { state, t, progress, exercise } = view;
  const who = createWho(progress);
  const value = (/** @type {Event} */ { target }) => /** @type {HTMLInputElement} */ (target).value.trim();
  const named = (/** @type {Event} */ event) => {
    if (state.assignment?.individual) void exercise.individual(value(event));
    else who.set({ ...who.get(), name: value(event) });
    view.notice("");
  };
  const numbered = (/** @type {Event} */ event) => {
    who.set({ ...who.get(), id: value(event) });
    view.notice("");
  };
  return html`
    <div class="field"><label for="handin-name">${t("homework.handin-name")}</label>
      <input id="handin-name" type="text" maxlength="64" autocomplete="name" required .value=${name} @change=${named} @input=${state.assignment?.individual ? nothing : named}></div>
    <div class="field"><label for="handin-id">${t("homework.handin-id")}</label>
      <input id="handin-id" type="text" maxlength="64" autocomplete="off" spellcheck="false" aria-describedby="handin-id-help" .value=${id} @change=${numbered}>
      <p class="so" id="handin-id-help">${t("homework.handin-id-help")}</p></div>`;
}

/** Until when, and how often. @param {HomeworkView} view */
export function rules({ state, t }) {
  const { deadline, late, attempts } = state.assignment ?? {};
  const { lang } = state.asked.place;
  const share = (late ?? 0).toLocaleString(lang, { style: "percent" });
  const told = [
    deadline
      ? t(late ? "homework.rule-deadline-late" : "homework.rule-deadline", { time: moment(deadline, lang), share })
      : "",
    attempts ? t("homework.rule-attempts", { count: attempts }) : "",
  ].filter(Boolean);
  return told.length ? html`<ul class="sheet-rules">${told.map((one) => html`<li>${one}</li>`)}</ul>` : nothing;
}

/** A moment in the time of the place. @param {string} instant @param {string} lang */
export const moment = (instant, lang) =>
  new Date(instant).toLocaleString(lang, { dateStyle: "medium", timeStyle: "short" });
