/** What the checker says: the outcome, what leads on, an example where the answers differ; hints; the solution. */

import { html, nothing } from "lit-html";
import { displayed, inline, prose } from "../formula.js";
import { icon } from "../icons.js";
import { brief, significant } from "../../model/numbers.js";
import { isCurrent } from "../../model/homework/answering.js";
import { isOrdering } from "../../model/homework/ordering.js";
import { isPlain } from "../../model/homework/sheet.js";
import { stepAddress } from "../../model/homework/place.js";
import { inOrder } from "./ordering.js";

/** @typedef {import("./page.js").HomeworkView} HomeworkView */
/** @typedef {import("../../model/homework/progress.js").Verdict} Verdict */

const AXES = ["", "x", "y", "z"];
const MOVING = [
  "kinetic-energy",
  "potential-energy",
  "lagrangian",
  "momentum",
  "generalized-force",
  "equation",
  "equations",
];
const ICONS = /** @type {const} */ ({
  correct: "verified",
  follow_through: "verified",
  wrong: "close",
  undecided: "help",
  invalid: "help",
});

/** The sentences after the outcome, which stands above them. @param {Verdict} verdict @param {HomeworkView["t"]} t */
export const furtherOf = ({ feedback, outcome }, t) => {
  const first = t(`homework.outcome.${outcome}`);
  return feedback.startsWith(first) ? feedback.slice(first.length).trim() : feedback;
};

/** @param {HomeworkView} view */
export function verdict(view) {
  const { state, t } = view;
  const { entry, draft } = state;
  const checked = draft.checked;
  if (!entry || !checked) return html`<div class="verdict-room" aria-live="polite"></div>`;
  const { verdict: found } = checked;
  return html`<div class="verdict-room" aria-live="polite">
    <section class="verdict-card ${isCurrent(entry, draft) ? "" : "stale"}" data-outcome=${found.outcome} aria-label=${t("homework.verdict")}>
      <h3>${icon(ICONS[found.outcome])}<span>${t(`homework.outcome.${found.outcome}`)}</span></h3>
      ${isCurrent(entry, draft) ? nothing : html`<p class="so">${t("homework.changed-since")}</p>`}
      ${found.outcome === "invalid" ? nothing : said(view, found)}
      ${found.outcome === "correct" ? onward(view) : nothing}
    </section></div>`;
}

/** The next task that is not solved yet. @param {HomeworkView} view */
function onward({ state, t, draftOf, exercise }) {
  const entries = state.sheet?.entries ?? [];
  const next = entries
    .slice(entries.findIndex(({ key }) => key === state.entry?.key) + 1)
    .find(({ key }) => !draftOf(key).solved);
  return next
    ? html`<p class="acts"><button type="button" class="quiet framed" @click=${() => exercise.show(next)}><span>${t("homework.next-task")}: ${prose(next.task.title)}</span>${icon("next")}</button></p>`
    : nothing;
}

/** @param {HomeworkView} view @param {Verdict} found */
function said(view, found) {
  const { t } = view;
  const rest = furtherOf(found, t);
  const title = found.misconceptions[0]?.title;
  return html`
    ${title ? html`<p class="misconception">${prose(title)}</p>` : nothing}
    ${rest ? html`<p class="prose">${prose(rest)}</p>` : nothing}
    ${found.marked ? html`<div class="marked" role="group" aria-label=${t("homework.marked")}>${displayed(found.marked)}</div>` : nothing}
    ${partly(view, found)}
    ${found.misconceptions.length > 1 ? html`<p class="so">${t("homework.or")} ${found.misconceptions.slice(1).map(({ title: other }, i) => html`${i ? ", " : ""}${prose(other)}`)}</p>` : nothing}
    ${found.counterexample && found.misconceptions.length + Number(Boolean(found.slip)) > 0 ? example(view, found.counterexample) : nothing}
    ${comparing(view, found)}`;
}

/** What the right parts of a wrong answer earn. @param {HomeworkView} view @param {Verdict} found */
const partly = ({ state, t }, { outcome, share }) =>
  outcome === "wrong" && share
    ? html`<p class="so">${t("homework.partly", { share: share.toLocaleString(state.asked.place.lang, { style: "percent" }) })}</p>`
    : nothing;

/** @param {HomeworkView} view @param {NonNullable<Verdict["counterexample"]>} found */
function example({ state, t }, { values, latex = {}, of, yours, right, reference = {} }) {
  const { lang } = state.asked.place;
  const given = (/** @type {number} */ value) => brief(value, 4, lang);
  const number = (/** @type {number} */ value) => significant(value, 4, lang);
  const component = AXES[Number(of)];
  const what = component ? html`${inline(component)}: ` : latex[of] ? html`${inline(latex[of])} = ` : nothing;
  const place = (/** @type {Record<string, number>} */ where) =>
    Object.entries(where).map(
      ([name, value]) => html`<span>${latex[name] ? inline(latex[name]) : name} = ${given(value)}</span>`,
    );
  return html`<details class="example"><summary>${icon("chevron")}${t("homework.example")}</summary>
    <p class="state">${place(values)}</p>
    ${Object.keys(reference).length ? html`<p class="state"><span>${t("homework.agreeing")}</span>${place(reference)}</p>` : nothing}
    <dl class="numbers"><div><dt>${t("homework.yours")}</dt><dd>${what}${number(yours)}</dd></div><div><dt>${t("homework.right")}</dt><dd>${what}${number(right)}</dd></div></dl>
  </details>`;
}

/** @param {HomeworkView} view @param {Verdict} found */
function comparing({ state, t, exercise }, { outcome }) {
  const offered =
    ["wrong", "follow_through", "undecided"].includes(outcome) && MOVING.includes(state.entry?.task.kind ?? "");
  if (!offered || state.answered) return nothing;
  return html`<p class="acts"><button type="button" class="quiet framed" ?disabled=${state.busy === "moving"} @click=${exercise.compare}>${icon("play")}${t(state.busy === "moving" ? "homework.moving" : "homework.compare")}</button></p>`;
}

/** @param {HomeworkView} view */
export function hints({ state, t }) {
  const { entry, draft } = state;
  if (!entry || !draft.hints) return nothing;
  return html`<section class="hints" aria-label=${t("homework.hints")} aria-live="polite"><ol>
    ${entry.task.hints.slice(0, draft.hints).map((hint, i) => html`<li><span class="level">${t("homework.hint", { number: i + 1, count: entry.task.hints.length })}</span><p class="prose">${prose(hint)}</p></li>`)}</ol></section>`;
}

/** @param {HomeworkView} view */
export function solution(view) {
  const { state, t, exercise } = view;
  const { entry, draft } = state;
  if (!entry || !(draft.solved || draft.tries)) return nothing;
  const { deadline } = (state.asked.side !== "practice" && state.assignment) || {};
  if (deadline && new Date(deadline) > new Date()) return html`<p class="so">${t("homework.solution-later")}</p>`;
  if (!state.solution)
    return html`<p class="acts solving"><button type="button" class="quiet framed" ?disabled=${state.busy === "solving"} @click=${exercise.solve}>${t("homework.solution")}</button>
    ${draft.solved ? nothing : html`<span class="so">${t("homework.solution-costs")}</span>`}</p>`;
  const { plain, latex, step } = state.solution;
  const address =
    step &&
    (isPlain(entry.reference)
      ? stepAddress(String(entry.reference.scene), step.id, state.asked.place)
      : view.ownStep(step.id));
  return html`<section class="worked" aria-label=${t("homework.solution")}>
    <h3>${t("homework.worked")}</h3>
    <div class="model-answer">${isOrdering(entry.task) ? inOrder(entry, plain) : latex.map((one) => displayed(one))}</div>
    ${
      step
        ? html`<div class="shown-step"><h4>${prose(step.title)}</h4>${step.text ? html`<p class="prose">${prose(step.text)}</p>` : nothing}
      ${step.marked || step.latex ? displayed(step.marked || step.latex, false, step) : nothing}
      ${address ? html`<p><a href=${address}>${t("homework.to-step")}</a></p>` : nothing}</div>`
        : nothing
    }
  </section>`;
}
