/** For teachers: a table of answers in, a table of results out, and which mistakes were made how often. */

import { html, nothing } from "lit-html";
import { prose } from "../formula.js";
import { COLUMNS, SLIPS, summaryOf } from "../../model/homework/grading.js";
import { assignmentOf } from "../../model/homework/sheet.js";
import { writeTable } from "../../model/homework/table.js";
import { offer } from "../files.js";

/** @typedef {import("./page.js").HomeworkView} HomeworkView */
/** @typedef {import("../../model/homework/classroom.js").Classroom} Classroom */
/** @typedef {ReturnType<typeof summaryOf>[number]} Summary */

const OUTCOMES = ["correct", "follow_through", "undecided", "invalid", "wrong"];
const SAMPLE = "student,scene,task,answer,syntax,line\nada,pendulum,kinetic-energy,m*l^2*dot(phi)^2,plain,1\nada,pendulum,equation:phi,2*m*l^2*ddot(phi) + m*g*l*sin(phi) = 0,plain,2\nemmy,pendulum,equation:phi,\\ddot\\varphi = -\\frac{g}{\\ell}\\sin\\varphi,latex,1\n";

/** @param {HomeworkView} view @param {Classroom} session */
export function classroom(view, session) {
  const { state, t } = view;
  const { name, total, done, running, notice, column, results } = session.get();
  const take = async (/** @type {Event} */ event) => {
    const input = /** @type {HTMLInputElement} */ (event.target);
    const [file] = input.files ?? [];
    if (file) await session.grade(file.name, new Uint8Array(await file.arrayBuffer()));
    input.value = "";
  };
  return html`<section class="classroom" aria-label=${t("homework.side-class")}>
    <h2>${t("homework.class")}</h2>
    <p class="prose">${t(state.assignment ? "homework.class-help-assignment" : "homework.class-help")}</p>
    <p class="acts"><label class="pick"><input class="unseen" type="file" accept=".csv,.tsv,.txt,text/csv" @change=${take}>${t("homework.class-open")}</label>
      <button type="button" class="quiet" @click=${() => offer("answers.csv", SAMPLE, "text/csv")}>${t("homework.class-sample")}</button></p>
    ${state.entry ? preparing(view, session) : nothing}
    ${notice ? html`<p class="wrong" role="alert">${t(notice, { name: column })}</p>` : nothing}
    ${total && !notice ? html`<div class="grading"><progress max=${total} value=${done} aria-label=${t("homework.class-progress", { done, total })}></progress>
      <p role="status">${name}: ${t("homework.class-progress", { done, total })}</p>
      ${running ? html`<button type="button" class="quiet small" @click=${session.stop}>${t("homework.class-stop")}</button>` : nothing}</div>` : nothing}
    ${results.length ? outcome(view, session) : nothing}
  </section>`;
}

/** What a teacher begins with: an assignment of these tasks to be cut down, and the tasks as questions for Moodle. @param {HomeworkView} view @param {Classroom} session */
function preparing({ state, t }, session) {
  const { sheet, entry } = state;
  const stack = async () => {
    const file = await session.stack();
    if (file) offer(`${entry?.scene.id}-stack.xml`, file, "application/xml");
  };
  const begin = () => sheet && offer(`${entry?.scene.id}-assignment.json`, JSON.stringify(assignmentOf(sheet, sheet.title ?? entry?.scene.title ?? {}), null, 1), "application/json");
  return html`<p class="acts"><button type="button" class="quiet framed" @click=${begin}>${t("homework.class-assignment")}</button>
    <button type="button" class="quiet framed" @click=${stack}>${t("homework.class-stack")}</button></p>
    <p class="so">${t("homework.class-link")}</p>`;
}

/** @param {HomeworkView} view @param {Classroom} session */
function outcome(view, session) {
  const { t } = view;
  const { results, name, style } = session.get();
  const save = () => offer(name.replace(/\.\w+$/, "") + "-results.csv", writeTable(COLUMNS, results, style), "text/csv");
  return html`
    <p class="acts"><button type="button" class="main" @click=${save}>${t("homework.class-save")}</button></p>
    <div class="key-of-outcomes">${OUTCOMES.map((one) => html`<span class="key" data-outcome=${one}><i></i>${t(`homework.status-${one}`)}</span>`)}</div>
    ${summaryOf(results).map((summary) => chart(view, summary))}
    <details class="all-results"><summary>${t("homework.class-all", { count: results.length })}</summary>
      <div class="table"><table><thead><tr>${["student", "task", "answer", "outcome", "points"].map((column) => html`<th scope="col">${t(`homework.class-${column}`)}</th>`)}</tr></thead>
        <tbody>${results.map((result) => html`<tr data-outcome=${result.outcome}><td>${result.student}</td><td>${prose(result.title)}</td><td><code>${result.answer}</code></td><td>${t(`homework.status-${result.outcome}`)}${result.mistake && result.mistake !== result.outcome ? html`: ${words(view, result.mistake)}` : result.outcome === "invalid" ? html`: ${result.feedback}` : nothing}</td><td>${result.points.toLocaleString(view.state.asked.place.lang)} / ${result.of.toLocaleString(view.state.asked.place.lang)}</td></tr>`)}</tbody></table></div></details>`;
}

/** A misconception has a title; a slip and what has no diagnosis are named here. @param {HomeworkView} view @param {string} mistake */
function words({ t }, mistake) {
  const slip = SLIPS.find((one) => mistake === `slip:${one}`);
  if (slip) return t(`homework.slip-${slip}`);
  return ["wrong", "invalid", "undecided"].includes(mistake) ? t(`homework.class-${mistake}`) : prose(mistake);
}

/** One task: the share of each outcome, and a bar for every mistake. @param {HomeworkView} view @param {Summary} summary */
function chart(view, { title, scene, count, outcomes, mistakes }) {
  const { t } = view;
  const right = outcomes.find(({ outcome: one }) => one === "correct")?.count ?? 0;
  const share = (/** @type {number} */ some) => `${(100 * some) / count}%`;
  const shown = OUTCOMES.flatMap((one) => outcomes.filter(({ outcome: other }) => other === one));
  return html`<figure class="chart"><figcaption><b>${prose(title)}</b> <span class="so">${scene}</span><span class="share">${t("homework.class-right", { right, count })}</span></figcaption>
    <div class="stack" role="img" aria-label=${shown.map((one) => `${t(`homework.status-${one.outcome}`)}: ${one.count}`).join(", ")}>${shown.map((one) => html`<span data-outcome=${one.outcome} style="width:${share(one.count)}"></span>`)}</div>
    ${mistakes.length ? html`<table class="mistakes"><tbody>${mistakes.map(({ mistake, count: times, students }) => html`
      <tr title=${students.join(", ")} data-outcome=${["invalid", "undecided"].includes(mistake) ? mistake : "wrong"}><th scope="row">${words(view, mistake)}</th><td class="bar"><span style="width:${share(times)}"></span></td><td class="times">${times}</td></tr>`)}</tbody></table>` : nothing}
  </figure>`;
}
