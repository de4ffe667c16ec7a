/** The page "Homework": the tasks, the one being answered, and the scene in motion. */

import { html, nothing } from "lit-html";
import { live } from "lit-html/directives/live.js";
import { inLanguage } from "../../model/catalog.js";
import { SIDES } from "../../model/homework/place.js";
import { failure } from "../failure.js";
import { prose } from "../formula.js";
import { appearance, lettersOf, titleMenu } from "../header.js";
import { addEntry, addTool, titleOfPlace } from "../lectures/adding.js";
import { top } from "../top.js";
import { answer } from "./answer.js";
import { figure } from "./figure.js";
import { handingIn } from "./handin.js";
import { tasks } from "./tasks.js";
import { hints, solution, verdict } from "./verdict.js";
import { working } from "./working.js";

/**
 * @typedef {object} HomeworkView
 * @property {import("../../model/homework/state.js").State} state
 * @property {import("../../model/catalog.js").Translate} t
 * @property {import("../../model/homework/answering.js").Answering} answering
 * @property {import("../../model/homework/exercise.js").Exercise} exercise
 * @property {import("../../model/homework/working.js").Working} working
 * @property {import("../header.js").Appearance["session"]} session
 * @property {(to: import("../../model/homework/answer.js").Syntax) => Promise<void>} switchTo
 * @property {(key: string) => import("../../model/homework/progress.js").Draft} draftOf
 * @property {import("../../model/homework/keys.js").Row[]} keys
 * @property {Record<string, string>} shortcuts
 * @property {boolean} formulas  whether the field for formulas is there
 * @property {import("../../model/clock.js").Clock} clock
 * @property {() => void} togglePlay
 * @property {(t: number) => void} scrub
 * @property {(patch: Partial<import("../../model/homework/place.js").Asked>) => string} link
 * @property {(step: string) => string} ownStep  where the derivation of a scene from the address shows a step; "" if there is none
 * @property {import("../page.js").View["follow"]} follow
 * @property {() => void} download  the student's work as a file
 * @property {(file: File) => Promise<void>} upload  such a file, or an assignment
 * @property {((view: HomeworkView) => unknown) | null} classroom  once it has been opened
 * @property {((view: HomeworkView) => unknown) | null} picker  once it has been opened
 * @property {ReturnType<typeof import("./open-practice.js").open> | null} practice  once it has been opened
 * @property {() => Promise<void>} practise  on to an exercise
 * @property {import("../../model/homework/progress.js").Progress} progress
 * @property {(key: string) => void} notice  says a sentence
 * @property {(file: File) => Promise<boolean>} opened  opens a file that is an assignment where none is open
 * @property {(assignment: import("../../model/homework/sheet.js").Assignment) => void} open  shows it as students see it
 */

/** What is shown on the other sides of the page. @type {Partial<Record<import("../../model/homework/place.js").Side, (view: HomeworkView) => unknown>>} */
const BESIDE = {
  working,
  handin: handingIn,
  sheet: (view) => view.picker?.(view) ?? nothing,
  class: (view) => view.classroom?.(view) ?? nothing,
};

/** @param {HomeworkView} view */
export function page(view) {
  const { state, t } = view;
  const { place, side } = state.asked;
  const shown = { state: { place }, session: view.session, t };
  const { entry } = state;
  const title = () =>
    titleOfPlace(entry?.task.title, inLanguage(entry?.scene.title, place.lang) || t("place.homework"));
  return html`
    ${top(shown, { main: "work", skip: t("homework.skip"), here: "homework", heading: heading(view), menu: [appearance(shown), addEntry(title, t)], tools: addTool(title, t) })}
    <main class="homework" data-side=${side}>
      ${side === "practice" ? (view.practice?.panel(view) ?? html`<nav class="tasks"></nav>`) : tasks(view)}
      <div class="work" id="work" tabindex="-1">
        ${sides(view)}
        ${BESIDE[side]?.(view) ?? single(view)}
      </div>
      ${figure(view)}
    </main>`;
}

/** @param {HomeworkView} view */
function heading({ state, t, exercise }) {
  const { place } = state.asked;
  const { lang } = place;
  const { scenes, sheet, assignment, entry } = state;
  if (state.asked.side === "practice")
    return html`<div class="scene"><h1 style=${lettersOf(t("practice.title"))}>${t("practice.title")}</h1><p class="summary">${t("practice.summary")}</p></div>`;
  const chosen = state.own ? "" : (entry?.scene.id ?? place.scene);
  if (assignment) {
    const title = inLanguage(sheet?.title ?? assignment.title, lang) || t("homework.assignment");
    const leave = () => void exercise.choose(typeof entry?.reference.scene === "string" ? entry.reference.scene : "");
    return html`<div class="scene"><h1 style=${lettersOf(title)}>${title}</h1>
      <p class="summary">${entry ? inLanguage(entry.scene.title, lang) : ""}</p><button class="quiet small" @click=${leave}>${t("homework.leave")}</button></div>`;
  }
  const listed = state.own ? null : scenes.find(({ id }) => id === chosen);
  const title =
    inLanguage(listed?.title ?? entry?.scene.title, lang) || (scenes.length || state.failure ? t("scene.choose") : "");
  const select = html`
    <select .value=${live(chosen)} @change=${(/** @type {Event} */ e) => void exercise.choose(/** @type {HTMLSelectElement} */ (e.target).value)}>
      ${listed ? nothing : html`<option value=${chosen} selected>${title}</option>`}
      ${scenes.map((one) => html`<option value=${one.id} ?selected=${one === listed}>${inLanguage(one.title, lang)}</option>`)}
    </select>`;
  return html`<div class="scene">${titleMenu(t("scene.choose"), title, select)}</div>`;
}

/** @param {HomeworkView} view */
function sides({ state, t, exercise, practise }) {
  const turn = (/** @type {import("../../model/homework/place.js").Side} */ side) =>
    side !== "practice" ? exercise.turn(side) : state.asked.side !== side ? void practise() : undefined;
  return html`<div class="work-head"><div class="segments" role="group" aria-label=${t("homework.side")}>${SIDES.filter(
    (side) => side !== "handin" || state.assignment || state.asked.side === side,
  ).map(
    (side) => html`
    <button aria-pressed=${String(side === state.asked.side)} @click=${() => turn(side)}>${t(`homework.side-${side}`)}</button>`,
  )}</div></div>`;
}

/** @param {HomeworkView} view */
function single(view) {
  const { state, t, exercise } = view;
  const { entry } = state;
  if (state.failure) return failure(state.failure, t("homework.no-tasks"), () => void exercise.load(), t);
  if (!entry) return html`<p class="patience" role="status">${t("homework.loading")}</p>`;
  return html`<article class="question" aria-label=${t("homework.task")}>
    ${state.asked.side === "practice" ? view.practice?.problem(view) : nothing}
    <h2><span>${prose(entry.task.title)}</span><span class="worth">${t("homework.points", { count: entry.task.points, points: entry.task.points.toLocaleString(state.asked.place.lang) })}</span></h2>
    <p class="prose">${prose(entry.task.statement)}</p>
    ${answer(view)}
    ${verdict(view)}
    ${hints(view)}
    ${solution(view)}
    ${state.asked.side === "practice" ? view.practice?.onward(view) : nothing}
  </article>`;
}
