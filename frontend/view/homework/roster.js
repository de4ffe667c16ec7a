/** Who earned what, and all answers: tables that are searched, put in order and turned page by page. */

import { html, nothing } from "lit-html";
import { ALL, ANSWERS, arranged, chosen, keyOf, ONLY, paged, STUDENTS } from "../../model/homework/roster.js";
import { plainly } from "../../model/prose.js";
import { prose } from "../formula.js";
import { icon } from "../icons.js";
import { moment } from "./handin.js";

/** @typedef {import("./page.js").HomeworkView} HomeworkView */
/** @typedef {import("../../model/homework/classroom.js").Classroom} Classroom */
/** @typedef {import("../../model/homework/classroom.js").Row} Row */
/** @typedef {import("../../model/homework/classroom.js").StudentTotals} StudentTotals */
/** @typedef {import("../../model/homework/classroom.js").TaskTotals} TaskTotals */
/** @typedef {import("../../model/homework/roster.js").Order} Order */

/** @type {import("../../model/homework/classroom.js").Outcome[]} */
export const OUTCOMES = ["correct", "follow_through", "undecided", "invalid", "wrong"];

/** @param {HomeworkView} view @param {number} value */
export const number = ({ state }, value) => value.toLocaleString(state.asked.place.lang, { maximumFractionDigits: 2 });

/** @param {Event} event */
const typed = ({ target }) => /** @type {HTMLInputElement | HTMLSelectElement} */ (target).value;

/** The way through the pages of a table. @param {HomeworkView} view @param {{page: number, pages: number, first: number, count: number, rows: unknown[]}} at @param {(page: number) => void} turn @param {string} name */
function pager({ t }, { page, pages, first, count, rows }, turn, name) {
  const button = (/** @type {"previous" | "next"} */ way, /** @type {number} */ to) =>
    html`<button type="button" class="tool" aria-label=${`${name}: ${t(`homework.page-${way}`)}`} title=${t(`homework.page-${way}`)} ?disabled=${to < 0 || to >= pages} @click=${() => turn(to)}>${icon(way)}</button>`;
  const told = t("homework.page", { first: count ? first + 1 : 0, last: first + rows.length, count });
  return html`<p class="turning"><span role="status">${told}</span>${pages > 1 ? html`${button("previous", page - 1)}${button("next", page + 1)}` : nothing}</p>`;
}

/** @param {string} label @param {string} value @param {(value: string) => void} change */
const search = (label, value, change) =>
  html`<label class="field"><span>${label}</span><input type="search" autocomplete="off" spellcheck="false" .value=${value} @input=${(/** @type {Event} */ event) => change(typed(event))}></label>`;

/** @param {string} label @param {string} value @param {[string, string][]} options @param {(value: string) => void} change */
const select = (label, value, options, change) =>
  html`<label class="field"><span>${label}</span><select @change=${(/** @type {Event} */ event) => change(typed(event))}>${options.map(([id, said]) => html`<option value=${id} ?selected=${id === value}>${said}</option>`)}</select></label>`;

/** Opens the list of answers at those that are wanted. @param {Classroom} session @param {Partial<import("../../model/homework/roster.js").Wanted>} wanted */
export function showAnswers(session, wanted) {
  session.want({ ...ALL, ...wanted });
  const list = /** @type {HTMLElement | null} */ (document.querySelector(".all-results summary"));
  list?.focus();
  list?.scrollIntoView({ block: "start" });
}

/** Who earned what: a column for each task, by its number below. @param {HomeworkView} view @param {Classroom} session */
export function students(view, session) {
  const { state, t } = view;
  const { totals, order } = session.get();
  const { tasks } = totals;
  const all = arranged(totals.students, order, state.asked.place.lang);
  const at = paged(all, order.page, STUDENTS);
  const dated = totals.students.some(({ late, beyond }) => late || beyond);
  const name = t("homework.class-students");
  return html`<section class="roster" aria-label=${name}><h3>${name}</h3>
    <div class="fields">${search(t("homework.class-find"), order.text, (text) => session.arrange({ text }))}
      ${select(
        t("homework.class-only"),
        order.only,
        ONLY.map((one) => [one, t(`homework.only-${one || "all"}`)]),
        (only) => session.arrange({ only: /** @type {Order["only"]} */ (only) }),
      )}</div>
    <div class="students" tabindex="0" role="region" aria-label=${name}><table>
    <thead><tr>${heading(view, session, "student", t("homework.class-student"))}${tasks.map(({ title }, n) => heading(view, session, n, String(n + 1), plainly(title)))}
      ${heading(view, session, "points", t("homework.class-points"))}${dated ? html`<th scope="col">${t("homework.class-remarks")}</th>` : nothing}</tr></thead>
    <tbody>${at.rows.map((one) => student(view, session, one, dated))}</tbody></table></div>
    ${pager(view, at, (page) => session.arrange({ page }), name)}
    <p class="so">${t("homework.class-best-last")}</p></section>`;
}

/** A heading that puts the rows in order. @param {HomeworkView} view @param {Classroom} session @param {Order["by"]} by @param {string} told @param {string} [title] */
function heading({ t }, session, by, told, title = "") {
  const { order } = session.get();
  const here = order.by === by;
  const turn = () => session.arrange({ by, down: here ? !order.down : by !== "student" });
  return html`<th scope="col" aria-sort=${here ? (order.down ? "descending" : "ascending") : nothing}><button type="button" class="small ${here ? "here" : ""}" title=${title || t("homework.class-sort")} @click=${turn}>${title ? html`<span class="unseen">${title}: </span>` : nothing}${told}${here ? html`<span class=${order.down ? "down" : "up"}>${icon(order.down ? "chevron" : "up")}</span>` : nothing}</button></th>`;
}

/** @param {HomeworkView} view @param {Classroom} session @param {StudentTotals} one @param {boolean} dated */
function student(view, session, { student: name, id, answers, points, of, late, beyond }, dated) {
  const { t } = view;
  const remarks = [
    late ? t("homework.class-late", { count: late }) : "",
    beyond ? t("homework.class-beyond", { count: beyond }) : "",
  ].filter(Boolean);
  return html`<tr><th scope="row"><button type="button" class="small" title=${t("homework.class-show-answers")} @click=${() => showAnswers(session, { text: id || name })}>${name}</button>${id && id !== name ? html` <span class="so">${id}</span>` : nothing}</th>
    ${answers.map((answer) => earned(view, answer))}<td class="sum">${number(view, points)} / ${number(view, of)}</td>${dated ? html`<td class="so">${remarks.join(", ")}</td>` : nothing}</tr>`;
}

/** The best attempt, and below it the last one where there were several. @param {HomeworkView} view @param {StudentTotals["answers"][number]} answer */
function earned(view, answer) {
  const { t } = view;
  if (!answer) return html`<td></td>`;
  const { outcome, points, attempts, last, last_points: latest } = answer;
  const said = t(`homework.status-${outcome}`);
  const more =
    attempts > 1
      ? t("homework.class-attempts", {
          count: attempts,
          outcome: t(`homework.status-${last}`),
          points: number(view, latest),
        })
      : "";
  return html`<td data-outcome=${outcome} title=${more ? `${said}; ${more}` : said}><span class="unseen">${said}: </span>${number(view, points)}${
    more
      ? html`<span class="last" data-outcome=${last}><span class="unseen">; ${more}</span><span aria-hidden="true">${number(view, latest)}</span></span>`
      : nothing
  }</td>`;
}

/** All answers, drawn while somebody looks at them. @param {HomeworkView} view @param {Classroom} session */
export function answers(view, session) {
  const { t } = view;
  const { rows, looked, wanted, totals } = session.get();
  const toggled = (/** @type {Event} */ event) => session.look(/** @type {HTMLDetailsElement} */ (event.target).open);
  const at = looked ? paged(chosen(rows, wanted), wanted.page, ANSWERS) : null;
  const columns = ["row", "student", "task", "answer", "outcome", "points"];
  return html`<details class="all-results" ?open=${looked} @toggle=${toggled}><summary>${t("homework.class-all", { count: rows.length })}</summary>
    ${
      at
        ? html`<div class="fields">${search(t("homework.class-find"), wanted.text, (text) => session.want({ text }))}
        ${select(t("homework.class-task"), wanted.task, [["", t("homework.only-all")], ...totals.tasks.map((one, n) => /** @type {[string, string]} */ ([keyOf(one), `${n + 1}. ${plainly(one.title)}`]))], (task) => session.want({ task }))}
        ${select(t("homework.class-outcome"), wanted.outcome, [["", t("homework.only-all")], ...OUTCOMES.map((one) => /** @type {[string, string]} */ ([one, t(`homework.status-${one}`)]))], (outcome) => session.want({ outcome }))}
        ${select(t("homework.class-mistake"), wanted.mistake, [["", t("homework.only-all")], ...mistakesIn(totals.mistakes)], (mistake) => session.want({ mistake }))}</div>
      <div class="table" tabindex="0" role="region" aria-label=${t("homework.class-all", { count: rows.length })}><table><thead><tr>${columns.map((column) => html`<th scope="col">${t(`homework.class-${column}`)}</th>`)}</tr></thead>
      <tbody>${at.rows.map((row) => given(view, row))}</tbody></table></div>
      ${pager(view, at, (page) => session.want({ page }), t("homework.class-all", { count: rows.length }))}`
        : nothing
    }</details>`;
}

/** The mistakes that have a name. @param {{outcome: string, mistake: string}[]} all @returns {[string, string][]} */
const mistakesIn = (all) =>
  all.filter(({ outcome }) => outcome === "wrong").map(({ mistake }) => [mistake, plainly(mistake)]);

/** @param {HomeworkView} view @param {Row} row */
function given(
  view,
  {
    row,
    student: name,
    title,
    answer,
    outcome,
    mistake,
    column,
    feedback,
    worth,
    of,
    file,
    attempt,
    late,
    counts,
    time,
  },
) {
  const { state, t } = view;
  const place = column ? t("homework.class-place", { column }) : "";
  const why = mistake
    ? html`: ${prose(mistake)}`
    : outcome === "invalid" || outcome === "undecided"
      ? html`: ${place} ${prose(feedback)}`
      : nothing;
  const when = [
    attempt ? t("homework.class-attempt", { number: attempt }) : "",
    time ? moment(time, state.asked.place.lang) : "",
    late ? t("homework.class-is-late") : "",
    counts === 0 && !late ? t("homework.class-is-beyond") : "",
  ].filter(Boolean);
  return html`<tr data-outcome=${outcome}><td>${row}</td><td>${name}${file ? html`<span class="so">${file}</span>` : nothing}${time || counts < 1 ? html`<span class="so">${when.join(", ")}</span>` : nothing}</td><td>${prose(title)}</td><td><code>${answer}</code></td><td>${t(`homework.status-${outcome}`)}${why}</td><td>${number(view, worth)} / ${number(view, of)}</td></tr>`;
}
