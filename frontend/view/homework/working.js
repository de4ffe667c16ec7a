/** A whole working: one line for each step, each the answer to a task; marked together, with points. */

import { html, nothing } from "lit-html";
import { displayed, prose } from "../formula.js";
import { marked as parted } from "../../model/editor/problems.js";
import { fingerprint } from "../../model/homework/working.js";
import { plainly } from "../../model/prose.js";
import { icon } from "../icons.js";
import { entryField, keyboard, remember } from "./entry.js";
import { failureLine } from "./trouble.js";
import { furtherOf } from "./verdict.js";

/** @typedef {import("./page.js").HomeworkView} HomeworkView */
/** @typedef {import("../../model/homework/progress.js").Line} Line */
/** @typedef {import("../../model/homework/state.js").Mark} Mark */

/** @param {HomeworkView} view */
export function working(view) {
  const { state, t, working: session } = view;
  const { lines, marked } = state;
  const current = marked?.of === fingerprint(lines) ? marked : null;
  const submit = (/** @type {Event} */ event) => {
    event.preventDefault();
    void session.mark();
  };
  return html`<form class="whole answering" aria-label=${t("homework.side-working")} @submit=${submit} @focusin=${remember}>
    <p class="prose">${t("homework.working-help")}</p>
    <ol class="written">${lines.map((line, index) => written(view, line, index, current?.lines[index] ?? null, current?.first_wrong === index))}</ol>
    <p class="acts"><button type="button" class="quiet framed" @click=${session.add}>${icon("add")}${t("homework.add-line")}</button>
      <button type="button" class="quiet" @click=${session.gather}>${t("homework.gather")}</button></p>
    ${lines.length ? keyboard(view.keys, t) : nothing}
    <div class="acts"><button class="main" ?disabled=${!lines.length || state.busy === "marking"}>${t(state.busy === "marking" ? "homework.checking" : "homework.mark")}</button>
      ${current ? html`<output class="score" aria-live="polite">${t("homework.total", { earned: number(view, current.points), of: number(view, current.total) })}</output>` : nothing}</div>
    <p class="notice-line" role="status">${state.notice ? t(state.notice) : marked && !current ? t("homework.changed-since") : nothing}</p>
    ${failureLine(view)}
  </form>`;
}

/** @param {HomeworkView} view @param {number} value */
const number = ({ state }, value) => value.toLocaleString(state.asked.place.lang, { maximumFractionDigits: 2 });

/** @param {HomeworkView} view @param {Line} line @param {number} index @param {Mark | null} mark @param {boolean} first */
function written(view, line, index, mark, first) {
  const { state, t, working: session, formulas, shortcuts } = view;
  const label = t("homework.line", { number: index + 1 });
  const problem = mark?.problems[0];
  const at = problem && parted(line.value, problem);
  return html`<li class="line ${first ? "first-wrong" : ""}" data-outcome=${mark?.outcome ?? nothing}>
    <div class="line-head"><label class="choice"><span class="unseen">${t("homework.line-task", { number: index + 1 })}</span>
        <select @change=${(/** @type {Event} */ e) => session.edit(index, { task: /** @type {HTMLSelectElement} */ (e.target).value })}>
          ${session.entries().map(({ task }) => html`<option value=${task.id} ?selected=${task.id === line.task}>${plainly(task.title)}</option>`)}</select>${icon("chevron")}</label>
      <button type="button" class="quiet small" @click=${() => session.convert(index)}>${t(`homework.to-${line.syntax === "plain" ? "latex" : "plain"}`)}</button>
      <button type="button" class="tool" title=${t("homework.remove-line")} aria-label=${`${t("homework.remove-line")} ${index + 1}`} @click=${() => session.remove(index)}>${icon("close")}</button></div>
    ${entryField({ label, syntax: line.syntax, value: line.value, invalid: mark?.outcome === "invalid", why: mark ? `mark-${index}` : "", placeholder: "…", change: (value) => session.edit(index, { value }), enter: () => void session.mark(), shortcuts }, formulas && state.asked.side === "working")}
    ${
      mark
        ? html`<div class="mark" id=${`mark-${index}`}>
      <p><b>${first ? t("homework.first-wrong") : t(`homework.outcome.${mark.outcome}`)}</b> <span class="score">${t("homework.total", { earned: number(view, mark.points), of: number(view, mark.of) })}</span></p>
      ${at ? html`<code class="where" aria-hidden="true">${at[0]}<mark>${at[1]}</mark>${at[2]}</code>` : nothing}
      ${mark.understood_as && mark.outcome !== "correct" ? displayed(mark.marked || mark.understood_as) : nothing}
      ${furtherOf(mark, t) ? html`<p class="prose">${mark.misconceptions[0] ? html`<b>${prose(mark.misconceptions[0].title)}.</b> ` : nothing}${prose(furtherOf(mark, t))}</p>` : nothing}
    </div>`
        : nothing
    }
  </li>`;
}
