/** For teachers: a table of answers in, a table of results out, who earned what, and which mistakes were made how often. */

import { html, nothing } from "lit-html";
import { assignmentOf } from "../../model/homework/sheet.js";
import { plainly } from "../../model/prose.js";
import { failure } from "../failure.js";
import { offer } from "../files.js";
import { prose } from "../formula.js";

/** @typedef {import("./page.js").HomeworkView} HomeworkView */
/** @typedef {import("../../model/homework/classroom.js").Classroom} Classroom */
/** @typedef {import("../../model/homework/classroom.js").Row} Row */
/** @typedef {import("../../model/homework/classroom.js").TaskTotals} TaskTotals */
/** @typedef {import("../../model/homework/classroom.js").StudentTotals} StudentTotals */

/** @type {import("../../model/homework/classroom.js").Outcome[]} */
const OUTCOMES = ["correct", "follow_through", "undecided", "invalid", "wrong"];
const SAMPLE =
  "student,scene,task,answer,syntax,line\nada,pendulum,kinetic-energy,m*l^2*dot(phi)^2,plain,1\nada,pendulum,equation:phi,2*m*l^2*ddot(phi) + m*g*l*sin(phi) = 0,plain,2\nemmy,pendulum,equation:phi,\\ddot\\varphi = -\\frac{g}{\\ell}\\sin\\varphi,latex,1\n";

/** @param {HomeworkView} view @param {Classroom} session */
export function classroom(view, session) {
  const { state, t } = view;
  const { notice, rows, failure: failed } = session.get();
  const take = async (/** @type {Event} */ event) => {
    const input = /** @type {HTMLInputElement} */ (event.target);
    const [file] = input.files ?? [];
    if (file) await session.grade(file.name, new Uint8Array(await file.arrayBuffer()));
    input.value = "";
  };
  return html`<section class="classroom" aria-label=${t("homework.side-class")}>
    <h2>${t("homework.class")}</h2>
    <p class="prose">${t(state.assignment ? "homework.class-help-assignment" : "homework.class-help")}</p>
    <details class="rules"><summary>${t("homework.class-rules-title")}</summary><p class="prose">${t("homework.class-rules")}</p></details>
    <p class="acts"><label class="pick"><input class="unseen" type="file" accept=".csv,.tsv,.txt,text/csv" @change=${take}>${t("homework.class-open")}</label>
      <button type="button" class="quiet" @click=${() => offer("answers.csv", SAMPLE, "text/csv")}>${t("homework.class-sample")}</button></p>
    ${state.entry ? preparing(view, session) : nothing}
    ${notice ? html`<p class="wrong" role="alert">${t(notice)}</p>` : nothing}
    ${progress(view, session)}
    ${failed ? failure(failed, t("homework.class-failed"), session.again, t) : nothing}
    ${rows.length ? outcome(view, session) : nothing}
  </section>`;
}

/** @param {HomeworkView} view @param {Classroom} session */
function progress({ t }, session) {
  const { name, running, waiting, total, rows } = session.get();
  if (!name || (!running && !total)) return nothing;
  const told = t("homework.class-progress", { done: rows.length, total });
  return html`<div class="grading">${total ? html`<progress max=${total} value=${rows.length} aria-label=${told}></progress>` : html`<progress aria-label=${t("homework.class-reading")}></progress>`}
    <p role="status">${name}: ${total ? told : t("homework.class-reading")}${waiting ? html` ${t("homework.class-waiting", { seconds: Math.ceil(waiting) })}` : nothing}</p>
    ${running ? html`<button type="button" class="quiet small" @click=${session.stop}>${t("homework.class-stop")}</button>` : nothing}</div>`;
}

/** What a teacher begins with: an assignment of these tasks to be cut down, and the tasks as questions for Moodle. @param {HomeworkView} view @param {Classroom} session */
function preparing({ state, t }, session) {
  const { sheet, entry } = state;
  const stack = async () => {
    const file = await session.stack();
    if (file) offer(`${entry?.scene.id}-stack.xml`, file, "application/xml");
  };
  const begin = () =>
    sheet &&
    offer(
      `${entry?.scene.id}-assignment.json`,
      JSON.stringify(assignmentOf(sheet, sheet.title ?? entry?.scene.title ?? {}), null, 1),
      "application/json",
    );
  return html`<p class="acts"><button type="button" class="quiet framed" @click=${begin}>${t("homework.class-assignment")}</button>
    <button type="button" class="quiet framed" @click=${stack}>${t("homework.class-stack")}</button></p>
    <p class="so">${t("homework.class-link")}</p>`;
}

/** @param {HomeworkView} view @param {Classroom} session */
function outcome(view, session) {
  const { t } = view;
  const { name, csv, totals } = session.get();
  const save = () => offer(name.replace(/\.\w+$/, "") + "-results.csv", csv ?? "", "text/csv");
  return html`
    ${csv === null ? nothing : html`<p class="acts"><button type="button" class="main" @click=${save}>${t("homework.class-save")}</button></p>`}
    <div class="key-of-outcomes">${OUTCOMES.map((one) => html`<span class="key" data-outcome=${one}><i></i>${t(`homework.status-${one}`)}</span>`)}</div>
    ${totals.students.length ? students(view, totals.students, totals.tasks) : nothing}
    ${totals.tasks.map((task, n) => chart(view, task, n + 1))}
    ${answers(view, session)}`;
}

/** Who earned what: a column for each task, by its number below. @param {HomeworkView} view @param {StudentTotals[]} all @param {TaskTotals[]} tasks */
function students(view, all, tasks) {
  const { t } = view;
  const cell = (/** @type {StudentTotals["answers"][number]} */ answer) =>
    answer
      ? html`<td data-outcome=${answer.outcome} title=${t(`homework.status-${answer.outcome}`)}><span class="unseen">${t(`homework.status-${answer.outcome}`)}: </span>${number(view, answer.points)}</td>`
      : html`<td></td>`;
  return html`<div class="students" tabindex="0" role="region" aria-label=${t("homework.class-students")}><table>
    <thead><tr><th scope="col">${t("homework.class-student")}</th>${tasks.map(({ title }, n) => html`<th scope="col" title=${plainly(title)}><span class="unseen">${prose(title)}: </span>${n + 1}</th>`)}<th scope="col">${t("homework.class-points")}</th></tr></thead>
    <tbody>${all.map(({ student, answers: given, points, of }) => html`<tr><th scope="row">${student}</th>${given.map(cell)}<td class="sum">${number(view, points)} / ${number(view, of)}</td></tr>`)}</tbody></table></div>`;
}

/** @param {HomeworkView} view @param {number} value */
const number = ({ state }, value) => value.toLocaleString(state.asked.place.lang, { maximumFractionDigits: 2 });

/** All answers, drawn while somebody looks at them. @param {HomeworkView} view @param {Classroom} session */
function answers(view, session) {
  const { t } = view;
  const { rows, looked } = session.get();
  const toggled = (/** @type {Event} */ event) => session.look(/** @type {HTMLDetailsElement} */ (event.target).open);
  return html`<details class="all-results" ?open=${looked} @toggle=${toggled}><summary>${t("homework.class-all", { count: rows.length })}</summary>
    ${
      looked
        ? html`<div class="table"><table><thead><tr>${["row", "student", "task", "answer", "outcome", "points"].map((column) => html`<th scope="col">${t(`homework.class-${column}`)}</th>`)}</tr></thead>
      <tbody>${[...rows].sort((a, b) => a.index - b.index).map((row) => answer(view, row))}</tbody></table></div>`
        : nothing
    }</details>`;
}

/** @param {HomeworkView} view @param {Row} row */
function answer(view, { row, student, title, answer: given, outcome: found, mistake, column, feedback, points, of }) {
  const { t } = view;
  const place = column ? t("homework.class-place", { column }) : "";
  const why = mistake
    ? html`: ${prose(mistake)}`
    : found === "invalid" || found === "undecided"
      ? html`: ${place} ${prose(feedback)}`
      : nothing;
  return html`<tr data-outcome=${found}><td>${row}</td><td>${student}</td><td>${prose(title)}</td><td><code>${given}</code></td><td>${t(`homework.status-${found}`)}${why}</td><td>${number(view, points)} / ${number(view, of)}</td></tr>`;
}

/** One task: the share of each outcome, and a bar for every mistake. @param {HomeworkView} view @param {TaskTotals} totals @param {number} place */
function chart({ t }, { title, scene, count, outcomes, mistakes }, place) {
  const share = (/** @type {number} */ some) => `${(100 * some) / count}%`;
  const shown = OUTCOMES.flatMap((one) => (outcomes[one] ? [{ one, some: outcomes[one] }] : []));
  return html`<figure class="chart"><figcaption><b>${place}. ${prose(title)}</b> <span class="so">${scene}</span><span class="share">${t("homework.class-right", { right: outcomes.correct ?? 0, count })}</span></figcaption>
    <div class="stack" role="img" aria-label=${shown.map(({ one, some }) => `${t(`homework.status-${one}`)}: ${some}`).join(", ")}>${shown.map(({ one, some }) => html`<span data-outcome=${one} style="width:${share(some)}"></span>`)}</div>
    ${
      mistakes.length
        ? html`<table class="mistakes"><tbody>${mistakes.map(
            ({ outcome: one, mistake, count: times, students: who }) => html`
      <tr title=${who.join(", ")} data-outcome=${one}><th scope="row">${prose(mistake)}</th><td class="bar"><span style="width:${share(times)}"></span></td><td class="times">${times}</td></tr>`,
          )}</tbody></table>`
        : nothing
    }
  </figure>`;
}
