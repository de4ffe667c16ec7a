/** Practice: the level and its rule, the problem, on to the next exercise, and what comes back when. */

import { html, nothing } from "lit-html";
import { inLanguage } from "../../model/catalog.js";
import { ahead, due, ENOUGH } from "../../model/homework/memory.js";
import { LEVELS } from "../../model/homework/place.js";
import { prose } from "../formula.js";
import { icon } from "../icons.js";

/** @typedef {import("./page.js").HomeworkView} HomeworkView */
/** @typedef {import("../../model/homework/practice.js").Practice} Practice */

/** @param {HomeworkView} view @param {Practice} session @param {(id: string) => string} nameOf */
export function panel(view, session, nameOf) {
  const { t } = view;
  return html`<section class="tasks practice" aria-label=${t("practice.title")}>
    ${level(view, session)}
    ${lessons(view, session, nameOf)}
    ${forgetting(view, session)}
  </section>`;
}

/** @param {HomeworkView} view @param {Practice} session */
function level({ state, t, exercise }, session) {
  const { memory, kept } = session.get();
  const choose = (/** @type {Event} */ event) =>
    void exercise.drill(session.choose(Number(/** @type {HTMLSelectElement} */ (event.target).value)));
  const top = memory.level === LEVELS.length;
  const given = { solved: memory.solved, enough: ENOUGH, level: memory.level };
  return html`<div class="level">
    <label class="field"><span>${t("practice.level")}</span>
      <select @change=${choose}>${LEVELS.map((one) => html`<option value=${one} ?selected=${one === memory.level}>${t("practice.level-option", { level: one, what: t(`practice.level-${one}`) })}</option>`)}</select></label>
    <p class="what">${t(`practice.level-${memory.level}`)}</p>
    ${top ? nothing : html`<div class="total"><div class="bar" aria-hidden="true"><span style="transform:scaleX(${memory.solved / ENOUGH})"></span></div><p>${t("practice.solved", given)}</p></div>`}
    <p class="so">${t(top ? "practice.rule-top" : "practice.rule", given)}</p>
    ${kept && state.kept ? nothing : html`<p class="wrong" role="status">${t("practice.not-kept")}</p>`}
  </div>`;
}

/** What comes back when, by the clock of this device. @param {HomeworkView} view @param {Practice} session @param {(id: string) => string} nameOf */
function lessons({ state, t }, session, nameOf) {
  const { memory } = session.get();
  const now = session.now();
  const at = state.sheet?.recalled;
  const waiting = due(memory, now).filter(({ id }) => id !== at).length;
  const none = due(memory, now).length ? "practice.at-hand" : "practice.none-due";
  const { lang } = state.asked.place;
  return html`<div class="lessons"><h2>${t("practice.back")}</h2>
    ${
      memory.lessons.length
        ? html`<p class="so">${waiting ? t("practice.due", { count: waiting }) : t(none)}</p>
      <ul>${ahead(memory).map(({ id, card }) => html`<li data-due=${String(card.due <= now)}><span>${prose(nameOf(id))}</span><time datetime=${card.due.toISOString()}>${card.due <= now ? t("practice.now") : moment(card.due, now, lang)}</time></li>`)}</ul>`
        : html`<p class="so">${t("practice.nothing-back")}</p>`
    }</div>`;
}

/** The time of today, else the day. @param {Date} when @param {Date} now @param {string} lang */
const moment = (when, now, lang) =>
  when.toDateString() === now.toDateString()
    ? when.toLocaleTimeString(lang, { hour: "2-digit", minute: "2-digit" })
    : when.toLocaleDateString(lang, {
        day: "numeric",
        month: "short",
        ...(when.getFullYear() === now.getFullYear() ? {} : { year: "numeric" }),
      });

/** @param {HomeworkView} view @param {Practice} session */
function forgetting({ t }, session) {
  const { asks } = session.get();
  return html`<div class="own"><p class="so">${t("practice.private")}</p>
    <div class="files-of-work"><button type="button" class="quiet framed small" @click=${() => session.forget()}>${t(asks ? "practice.forget-sure" : "practice.forget")}</button>
    ${asks ? html`<button type="button" class="quiet framed small" @click=${() => session.spare()}>${t("practice.spare")}</button>` : nothing}</div></div>`;
}

/** The system, in words. @param {HomeworkView} view */
export function problem({ state, t }) {
  const { entry, sheet, asked } = state;
  if (!entry) return nothing;
  const { lang } = asked.place;
  return html`<div class="problem">
    ${sheet?.recalled ? html`<p class="returns">${icon("again")}<span>${t("practice.returns")}</span></p>` : nothing}
    <p class="which">${t("practice.which", { level: asked.drill.level, number: asked.drill.number })}</p>
    <h2 class="of-system">${inLanguage(entry.scene.title, lang)}</h2>
    <p class="prose">${inLanguage(entry.scene.summary, lang)}</p></div>`;
}

/** @param {HomeworkView} view @param {Practice} session */
export function onward({ state, t, exercise }, session) {
  const { solved } = state.draft;
  const { memory, risen } = session.get();
  const next = () => void exercise.drill(session.next());
  return html`<div class="acts next-exercise">
    <p class="risen" role="status">${risen ? t("practice.risen", { level: memory.level }) : nothing}</p>
    <button type="button" class=${solved ? "main" : "quiet framed"} @click=${next}>${t(solved ? "practice.next" : "practice.other")}${icon("next")}</button></div>`;
}
