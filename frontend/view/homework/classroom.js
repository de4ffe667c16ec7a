/** For teachers: a table of answers in, a table of results out, who earned what, and which mistakes were made how often. */

import { html, nothing } from "lit-html";
import { keyOf } from "../../model/homework/roster.js";
import { failure } from "../failure.js";
import { offer } from "../files.js";
import { prose } from "../formula.js";
import { rules } from "./handin.js";
import { answers, OUTCOMES, showAnswers, students } from "./roster.js";

/** @typedef {import("./page.js").HomeworkView} HomeworkView */
/** @typedef {import("../../model/homework/classroom.js").Classroom} Classroom */
/** @typedef {import("../../model/homework/classroom.js").TaskTotals} TaskTotals */

const SAMPLE =
  "student,scene,task,answer,syntax,line\nada,pendulum,kinetic-energy,m*l^2*dot(phi)^2,plain,1\nada,pendulum,equation:phi,2*m*l^2*ddot(phi) + m*g*l*sin(phi) = 0,plain,2\nemmy,pendulum,equation:phi,\\ddot\\varphi = -\\frac{g}{\\ell}\\sin\\varphi,latex,1\n";

/** @param {HomeworkView} view @param {Classroom} session */
export function classroom(view, session) {
  const { state, t } = view;
  const { notice, rows, failure: failed } = session.get();
  const taken = (/** @type {Iterable<File>} */ files) => void take(view, session, [...files]);
  const picked = (/** @type {Event} */ { target }) => {
    const input = /** @type {HTMLInputElement} */ (target);
    taken(input.files ?? []);
    input.value = "";
  };
  return html`<section class="classroom" aria-label=${t("homework.side-class")} @dragover=${hold} @drop=${(
    /** @type {DragEvent} */ event,
  ) => {
    hold(event);
    taken(event.dataTransfer?.files ?? []);
  }}>
    <h2>${t("homework.class")}</h2>
    <p class="prose">${t(state.assignment ? "homework.class-help-assignment" : "homework.class-help")}</p>
    <details class="rules"><summary>${t("homework.class-rules-title")}</summary><p class="prose">${t("homework.class-rules")}</p></details>
    ${state.assignment ? html`${rules(view)}<p class="so">${t("homework.code", { code: state.sheet?.code ?? "" })}</p>` : nothing}
    <p class="acts drop"><label class="pick"><input class="unseen" type="file" multiple accept=".json,.zip,.csv,.tsv,.txt,.toml" @change=${picked}>${t("homework.class-open")}</label>
      <span class="so">${t("homework.class-drop")}</span>
      <button type="button" class="quiet" @click=${() => offer("answers.csv", SAMPLE, "text/csv")}>${t("homework.class-sample")}</button></p>
    ${state.entry ? preparing(view, session) : nothing}
    ${notice ? html`<p class="wrong" role="alert">${t(notice)}</p>` : nothing}
    ${progress(view, session)}
    ${refusals(view, session)}
    ${failed ? failure(failed, t("homework.class-failed"), session.again, t) : nothing}
    ${rows.length ? outcome(view, session) : nothing}
  </section>`;
}

/** What is dropped is not opened by the browser. @param {Event} event */
const hold = (event) => event.preventDefault();

/** A sheet that is dropped by itself is opened; a student's file never is one. @param {HomeworkView} view @param {Classroom} session @param {File[]} files */
async function take({ t, opened }, session, files) {
  if (files.length === 1 && (await opened(files[0]))) return;
  await session.take(files, {
    named: t("homework.class-files", { count: files.length }),
    broken: t("homework.class-broken-zip"),
  });
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

/** The tasks on the page as questions for Moodle. @param {HomeworkView} view @param {Classroom} session */
function preparing({ state, t }, session) {
  const stack = async () => {
    const file = await session.stack();
    if (file) offer(`${state.entry?.scene.id}-stack.xml`, file, "application/xml");
  };
  return html`<p class="acts"><button type="button" class="quiet framed" @click=${stack}>${t("homework.class-stack")}</button></p>`;
}

/** @param {HomeworkView} view @param {Classroom} session */
function outcome(view, session) {
  const { t } = view;
  const { name, csv, platforms, totals } = session.get();
  const save = (/** @type {string} */ end, /** @type {string} */ text) =>
    offer(`${name.replace(/\.\w+$/, "")}-${end}.csv`, text, "text/csv");
  return html`
    ${
      csv === null
        ? nothing
        : html`<p class="acts"><button type="button" class="main" @click=${() => save("results", csv)}>${t("homework.class-save")}</button>
      ${platforms.moodle ? html`<button type="button" class="quiet framed" @click=${() => save("moodle", platforms.moodle)}>${t("homework.class-moodle")}</button>` : nothing}
      ${platforms.canvas ? html`<button type="button" class="quiet framed" @click=${() => save("canvas", platforms.canvas)}>${t("homework.class-canvas")}</button>` : nothing}</p>
      ${platforms.moodle ? html`<p class="so">${t("homework.class-platforms-help")}</p>` : nothing}`
    }
    <div class="key-of-outcomes">${OUTCOMES.map((one) => html`<span class="key" data-outcome=${one}><i></i>${t(`homework.status-${one}`)}</span>`)}</div>
    ${totals.students.length ? students(view, session) : nothing}
    ${totals.mistakes.length ? html`<section aria-label=${t("homework.class-mistakes")}><h3>${t("homework.class-mistakes")}</h3>${mistaken(session, totals.mistakes, session.get().rows.length, "")}</section>` : nothing}
    ${totals.tasks.map((task, n) => chart(view, session, task, n + 1))}
    ${answers(view, session)}`;
}

/** Files that could not be taken, each with its reason. @param {HomeworkView} view @param {Classroom} session */
function refusals({ t }, session) {
  const { refused } = session.get();
  if (!refused.length) return nothing;
  const told = t("homework.class-refused", {
    count: refused.length,
  });
  return html`<details class="refusals" open><summary role="alert">${told}</summary>
    <div tabindex="0" role="region" aria-label=${told}><ul>${refused.map(({ file, why }) => html`<li><b>${file}</b> ${why}</li>`)}</ul></div></details>`;
}

/** A bar for every mistake, which shows the answers that made it. @param {Classroom} session @param {import("../../model/homework/classroom.js").TaskTotals["mistakes"]} mistakes @param {number} count @param {string} task */
function mistaken(session, mistakes, count, task) {
  const share = (/** @type {number} */ some) => `${(100 * some) / count}%`;
  const show = (/** @type {string} */ outcome, /** @type {string} */ mistake) =>
    showAnswers(session, { task, outcome, mistake: outcome === "wrong" ? mistake : "" });
  return html`<table class="mistakes"><tbody>${mistakes.map(
    ({ outcome: one, mistake, count: times, students: who }) => html`
      <tr title=${who.slice(0, 20).join(", ")} data-outcome=${one}><th scope="row"><button type="button" class="small" @click=${() => show(one, mistake)}>${prose(mistake)}</button></th><td class="bar"><span style="width:${share(times)}"></span></td><td class="times">${times}</td></tr>`,
  )}</tbody></table>`;
}

/** One task: the share of each outcome, and a bar for every mistake. @param {HomeworkView} view @param {Classroom} session @param {TaskTotals} totals @param {number} place */
function chart({ t }, session, { title, scene, task, count, outcomes, mistakes }, place) {
  const share = (/** @type {number} */ some) => `${(100 * some) / count}%`;
  const shown = OUTCOMES.flatMap((one) => (outcomes[one] ? [{ one, some: outcomes[one] }] : []));
  return html`<figure class="chart"><figcaption><b>${place}. ${prose(title)}</b> <span class="so">${scene}</span><span class="share">${t("homework.class-right", { right: outcomes.correct ?? 0, count })}</span></figcaption>
    <div class="stack" role="img" aria-label=${shown.map(({ one, some }) => `${t(`homework.status-${one}`)}: ${some}`).join(", ")}>${shown.map(({ one, some }) => html`<span data-outcome=${one} style="width:${share(some)}"></span>`)}</div>
    ${mistakes.length ? mistaken(session, mistakes, count, keyOf({ scene, task })) : nothing}
  </figure>`;
}
