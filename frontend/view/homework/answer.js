/** The answer: its fields, what they are understood as, the keyboard, and the button that has them checked. */

import { html, nothing } from "lit-html";
import { displayed, inline } from "../formula.js";
import { marked } from "../../model/editor/problems.js";
import { isCurrent, partsIn, valueOf } from "../../model/homework/answering.js";
import { placeIn } from "../../model/homework/answer.js";
import { isOrdering } from "../../model/homework/ordering.js";
import { ordering } from "./ordering.js";
import { failureLine } from "./trouble.js";
import { icon } from "../icons.js";
import { entryField, keyboard, remember } from "./entry.js";

/** @typedef {import("./page.js").HomeworkView} HomeworkView */
/** @typedef {import("../../model/homework/sheet.js").Entry} Entry */
/** @typedef {import("../../model/homework/progress.js").AnswerProblem} AnswerProblem */

const AXES = ["x", "y", "z"];

/** What is in the way of reading the text as it stands. @param {HomeworkView["state"]} state @returns {AnswerProblem[]} */
function problemsOf({ entry, draft, reading }) {
  if (!entry) return [];
  if (reading?.of === valueOf(entry, draft)) return reading.problems;
  return isCurrent(entry, draft) ? (draft.checked?.verdict.problems ?? []) : [];
}

/** @param {HomeworkView} view */
export function answer(view) {
  const { state, t, answering } = view;
  const { entry } = state;
  if (!entry) return nothing;
  const check = (/** @type {Event} */ event) => {
    event.preventDefault();
    void answering.check();
  };
  return html`
    <form class="answering" aria-label=${t("homework.answer")} @submit=${check} @focusin=${remember}>
      ${isOrdering(entry.task) ? ordering(view, entry) : written(view, entry)}
      <div class="acts">
        <button class="main" ?disabled=${state.busy === "checking"}>${t(state.busy === "checking" ? "homework.checking" : "homework.check")}</button>
        ${hinting(view, entry)}
      </div>
      <p class="notice-line" role="status">${state.notice ? t(state.notice) : nothing}</p>
      ${failureLine(view)}
    </form>`;
}

/** What is written in fields. @param {HomeworkView} view @param {Entry} entry */
const written = (view, entry) => html`
      <div class="answer-head"><h3>${view.t("homework.answer")}</h3>${wanted(view, entry)}${syntaxes(view)}</div>
      ${fields(view, entry)}
      ${understood(view, entry)}
      ${keyboard(view.keys, view.t)}`;

/** What to write, where the fields do not say so: components have a field each. @param {HomeworkView} view @param {Entry} entry */
function wanted({ state }, entry) {
  const single = partsIn(entry, state.draft).length === 1;
  return single || entry.task.form !== "vector" ? html`<span class="wanted">${entry.task.form_text}</span>` : nothing;
}

/** @param {HomeworkView} view */
function syntaxes({ state, t, switchTo }) {
  return html`<div class="segments" role="group" aria-label=${t("homework.syntax")}>${
    /** @type {const} */ (["latex", "plain"]).map(
      (one) => html`
    <button type="button" aria-pressed=${String(one === state.draft.syntax)} @click=${() => switchTo(one)}>${t(`homework.syntax-${one}`)}</button>`,
    )
  }</div>`;
}

/** @param {HomeworkView} view @param {Entry} entry */
function fields(view, entry) {
  const { state, t, answering, formulas, shortcuts } = view;
  const { draft } = state;
  const parts = partsIn(entry, draft);
  const found = problemsOf(state);
  const places = found.map((problem) =>
    problem.offset === null ? null : placeIn(parts, entry.task.form, draft.syntax, problem.offset),
  );
  const outcomes = isCurrent(entry, draft) ? (draft.checked?.verdict.parts ?? []) : [];
  return html`<div class="parts">${parts.map((value, index) => {
    const invalid = places.some((place) => place?.part === index);
    const label = labelOf(entry, index, parts.length, t);
    return html`<div class="part" data-outcome=${outcomes[index] ?? nothing}>
      ${parts.length > 1 ? html`<span class="part-name" aria-hidden="true">${entry.task.form === "vector" ? inline(AXES[index]) : `${index + 1}.`}</span>` : nothing}
      ${entryField({ label, syntax: draft.syntax, value, invalid, why: invalid ? "why" : "", placeholder: placeholderOf(entry), change: (text) => answering.type(index, text), enter: () => void answering.check(), shortcuts }, formulas)}
      ${outcomes[index] ? html`<span class="part-outcome" title=${t(`homework.part-${outcomes[index]}`)}>${icon(outcomes[index] === "correct" ? "verified" : "close")}<span class="unseen">${t(`homework.part-${outcomes[index]}`)}</span></span>` : nothing}
    </div>`;
  })}
  ${found.length ? html`<div class="complaints" id="why" role="status">${found.map((problem, i) => complaint(problem, parts, places[i]))}</div>` : nothing}</div>`;
}

/** @param {Entry} entry @param {number} index @param {number} count @param {HomeworkView["t"]} t */
function labelOf({ task }, index, count, t) {
  if (count === 1) return t("homework.answer");
  return task.form === "vector"
    ? t("homework.component", { name: AXES[index] })
    : t("homework.line", { number: index + 1 });
}

/** How the text of an answer to such a task looks. @param {Entry} entry */
function placeholderOf({ task, symbols }) {
  const name = symbols.find(({ kind }) => kind === "coordinate")?.name ?? "q";
  const equation = `ddot(${name}) + … = 0`;
  const positions = `${name} = …; ${name} = …`;
  const rate = `dot(${name})^2 = …`;
  const forms = { equation, equations: equation, set: "omega = …", expression: "…", vector: "…" };
  return { ...forms, positions, rate, stability: "…", order: "c; a; b" }[task.form];
}

/** @param {AnswerProblem} problem @param {string[]} parts @param {{part: number, offset: number} | null} place */
function complaint(problem, parts, place) {
  const at = place && marked(parts[place.part], { ...problem, offset: place.offset });
  return html`${at ? html`<code class="where" aria-hidden="true">${at[0]}<mark>${at[1]}</mark>${at[2]}</code>` : nothing}<p class="wrong">${problem.message}</p>`;
}

/** What was read, or judged, and the other ways to read it: one of them is a click away. @param {HomeworkView} view @param {Entry} entry */
function understood({ state, t, answering }, entry) {
  const { reading, draft } = state;
  const fresh = reading?.of === valueOf(entry, draft);
  const verdict = isCurrent(entry, draft) ? draft.checked?.verdict : null;
  const latex = verdict?.understood_as || reading?.latex;
  const others = ((verdict ?? (fresh ? reading : null))?.readings ?? []).filter(({ taken }) => !taken);
  return html`<div class="understood-as ${fresh || verdict ? "" : "stale"}"><span class="caption">${t("homework.understood")}</span>
    <div class="room">${latex ? displayed(latex) : html`<span class="nothing-yet">${t("homework.nothing-yet")}</span>`}</div>
    ${others.length ? html`<div class="other-readings" role="group" aria-label=${t("homework.readings")}><span class="caption">${t("homework.readings")}</span>${others.map((one) => reread(one, () => answering.reread(one)))}</div>` : nothing}</div>`;
}

/** @param {import("../../model/homework/progress.js").PossibleReading} reading @param {() => void} take */
function reread({ latex }, take) {
  return html`<button type="button" class="reading-chip" @click=${take}>${inline(latex)}</button>`;
}

/** @param {HomeworkView} view @param {Entry} entry */
function hinting({ state, t, answering }, { task }) {
  const { hints } = state.draft;
  const rest = task.hints.length - hints;
  return html`<button type="button" class="quiet" ?disabled=${rest === 0} @click=${answering.hint}>${t(hints ? "homework.next-hint" : "homework.hint", { number: Math.min(hints + 1, task.hints.length), count: task.hints.length })}</button>`;
}
