/** For teachers: a sheet picked from the tasks of the scenes, with points and rules; saved, sent and tried out. */

import { generate } from "lean-qr";
import { html, nothing, svg } from "lit-html";
import { live } from "lit-html/directives/live.js";
import { inLanguage } from "../../model/catalog.js";
import { fileName } from "../../model/homework/handin.js";
import { bounded, instantOf, listKey, localOf, sceneIn } from "../../model/homework/picker.js";
import { NO_DRILL, writeAsked } from "../../model/homework/place.js";
import { OWN } from "../../model/own.js";
import { pathOf } from "../../model/share.js";
import { HOME } from "../../model/url.js";
import { failure } from "../failure.js";
import { offer, toClipboard } from "../files.js";
import { prose } from "../formula.js";
import { icon } from "../icons.js";

/** @typedef {import("./page.js").HomeworkView} HomeworkView */
/** @typedef {import("../../model/homework/picker.js").Picker} Picker */
/** @typedef {import("../../model/homework/sheet.js").Task} Task */
/** @typedef {import("../../model/homework/picker.js").Assigned} Assigned */
/** @typedef {NonNullable<import("../../model/homework/picker.js").Assignment["vary"]>[number]} Aspect */

/** Empty modules around a code, so that phones find it. */
const QUIET = 4;
/** More does not fit a code that a phone reads from a wall. */
const LONGEST = 1200;
/** What may differ from student to student; without a choice the first. @type {readonly Aspect[]} */
const ASPECTS = ["values", "axes", "coordinates", "factors"];
const MOST_POINTS = 1000;
const MOST_ATTEMPTS = 1000;

/** @param {Event} event */
const typed = ({ target }) => /** @type {HTMLInputElement | HTMLSelectElement} */ (target).value;

/** @param {HomeworkView} view @param {Picker} session */
export function picker(view, session) {
  const { t } = view;
  return html`<section class="classroom picker" aria-label=${t("homework.side-sheet")}>
    <h2>${t("homework.side-sheet")}</h2>
    <p class="prose">${t("homework.pick-help")}</p>
    <div class="picking">
      ${offered(view, session)}
      ${sheet(view, session)}
    </div>
  </section>`;
}

/** @param {HomeworkView} view @param {number} value */
const pointsOf = ({ state, t }, value) =>
  t("homework.points", { count: value, points: value.toLocaleString(state.asked.place.lang) });

/** The tasks of a scene as students read them. @param {HomeworkView} view @param {Picker} session */
function offered(view, session) {
  const { state, t } = view;
  const { lang } = state.asked.place;
  const { scene, lists, failure: failed } = session.get();
  const list = lists[listKey(session.reference(), lang)];
  const options = [
    ...(session.own ? [{ id: OWN, title: inLanguage(state.entry?.scene.title, lang) }] : []),
    ...state.scenes.map(({ id, title }) => ({ id, title: inLanguage(title, lang) })),
  ];
  return html`<section class="offered" aria-label=${t("homework.pick-tasks")}>
    <div class="field wide"><label for="pick-scene">${t("homework.pick-scene")}</label>
      <select id="pick-scene" @change=${(/** @type {Event} */ event) => void session.choose(typed(event))}>${options.map(({ id, title }) => html`<option value=${id} ?selected=${id === scene}>${title}</option>`)}</select></div>
    ${failed ? failure(failed, t("homework.no-tasks"), () => void session.choose(scene), t) : nothing}
    ${
      list
        ? html`<div class="catalogue" tabindex="0" role="region" aria-label=${t("homework.pick-tasks")}><ul>${list.tasks.map((task) => offeredTask(view, session, task))}</ul></div>
        <p class="acts"><button type="button" class="quiet small framed" @click=${() => session.add(list.tasks)}>${icon("add")}${t("homework.pick-all")}</button></p>`
        : failed
          ? nothing
          : html`<p class="patience" role="status">${t("homework.loading")}</p>`
    }</section>`;
}

/** @param {HomeworkView} view @param {Picker} session @param {Task} task */
function offeredTask(view, session, task) {
  const { t } = view;
  return html`<li><div><b>${prose(task.title)}</b> <span class="so">${pointsOf(view, task.points)}</span>
      <p class="prose">${prose(task.statement)}</p></div>
    <button type="button" class="quiet small framed" @click=${() => session.add([task])}>${icon("add")}${t("homework.pick-add")}<span class="unseen">: ${prose(task.title)}</span></button></li>`;
}

/** The sheet as it is so far. @param {HomeworkView} view @param {Picker} session */
function sheet(view, session) {
  const { state, t } = view;
  const { lang } = state.asked.place;
  const { sheet: made } = session.get();
  const sum = made.tasks.reduce((all, { points }) => all + (points ?? 0), 0);
  return html`<section class="made" aria-label=${t("homework.pick-sheet")}>
    <div class="field wide"><label for="pick-title">${t("homework.pick-title")}</label>
      <input id="pick-title" type="text" maxlength="200" autocomplete="off" .value=${inLanguage(made.title, lang)} @change=${(/** @type {Event} */ event) => session.change({ title: typed(event) })}></div>
    ${
      made.tasks.length
        ? html`<ol class="picked">${made.tasks.map((task, index) => picked(view, session, task, index, made.tasks.length))}</ol>
        <p class="so">${t("homework.pick-sum", { count: made.tasks.length, points: sum.toLocaleString(lang) })}</p>`
        : html`<p class="so none">${t("homework.pick-none")}</p>`
    }
    ${rules(view, session)}
    ${made.tasks.length ? ready(view, session) : nothing}
  </section>`;
}

/** @param {HomeworkView} view @param {Picker} session @param {Assigned} task @param {number} index @param {number} count */
function picked(view, session, task, index, count) {
  const { state, t } = view;
  const { lang } = state.asked.place;
  const list = session.get().lists[listKey(sceneIn(task), lang)];
  const found = list?.tasks.find(({ id }) => id === task.task);
  const title = found ? prose(found.title) : task.task;
  const weigh = (/** @type {Event} */ event) => session.weigh(index, bounded(typed(event), 0, MOST_POINTS));
  const act = (
    /** @type {string} */ what,
    /** @type {"up" | "chevron" | "close"} */ sign,
    /** @type {() => void} */ go,
    off = false,
  ) =>
    html`<button type="button" class="tool" title=${t(what)} aria-label=${t(`${what}-task`, { number: index + 1 })} ?disabled=${off} @click=${go}>${icon(sign)}</button>`;
  return html`<li><span class="what"><b>${title}</b> <span class="so">${inLanguage(list?.title, lang)}</span></span>
    <label class="points"><span class="unseen">${t("homework.pick-points", { number: index + 1 })}</span><input type="text" inputmode="decimal" size="4" .value=${(task.points ?? found?.points ?? 0).toLocaleString(lang, { useGrouping: false })} @change=${weigh}></label>
    <span class="moves">${act("homework.pick-up", "up", () => session.move(index, -1), index === 0)}${act("homework.pick-down", "chevron", () => session.move(index, 1), index === count - 1)}${act("homework.pick-remove", "close", () => session.remove(index))}</span></li>`;
}

/** Deadline, attempts and shares. @param {HomeworkView} view @param {Picker} session */
function rules({ state, t }, session) {
  const { lang } = state.asked.place;
  const { sheet: made } = session.get();
  const percent = (/** @type {number | null | undefined} */ share, /** @type {number} */ usual) =>
    (100 * (share ?? usual)).toLocaleString(lang, { maximumFractionDigits: 1, useGrouping: false });
  const share = (/** @type {"late" | "follow_through"} */ name, /** @type {number} */ usual) =>
    html`<div class="field"><label for=${`pick-${name}`}>${t(`homework.pick-${name}`)}</label><input id=${`pick-${name}`} type="text" inputmode="decimal" .value=${percent(made[name], usual)} @change=${(/** @type {Event} */ event) => session.change({ [name]: (bounded(typed(event), 0, 100) ?? 100 * (made[name] ?? usual)) / 100 })}></div>`;
  return html`<fieldset class="rules-of-sheet"><legend>${t("homework.pick-rules")}</legend><div class="fields">
    <div class="field when"><label for="pick-deadline">${t("homework.pick-deadline")}</label><input id="pick-deadline" type="datetime-local" .value=${localOf(made.deadline)} @change=${(/** @type {Event} */ event) => session.change({ deadline: instantOf(typed(event)) })}></div>
    ${share("late", 0)}
    <div class="field"><label for="pick-attempts">${t("homework.pick-attempts")}</label><input id="pick-attempts" type="text" inputmode="numeric" placeholder=${t("homework.pick-any")} .value=${made.attempts ?? ""} @change=${(/** @type {Event} */ event) => session.change({ attempts: whole(bounded(typed(event), 1, MOST_ATTEMPTS)) })}></div>
    ${share("follow_through", 0.5)}</div>
    <label class="check"><input type="checkbox" .checked=${made.individual === true} @change=${(/** @type {Event} */ event) => session.change({ individual: /** @type {HTMLInputElement} */ (event.target).checked })}> ${t("homework.pick-individual")}</label>
    ${made.individual ? aspects(t, made.vary ?? [ASPECTS[0]], session) : nothing}
    </fieldset>`;
}

/**
 * What differs from student to student; with nothing chosen it is the values.
 * @param {HomeworkView["t"]} t @param {readonly Aspect[]} chosen @param {Picker} session
 */
function aspects(t, chosen, session) {
  const turn = (/** @type {Aspect} */ aspect, /** @type {Event} */ { target }) => {
    const { checked } = /** @type {HTMLInputElement} */ (target);
    const vary = ASPECTS.filter((one) => (one === aspect ? checked : chosen.includes(one)));
    session.change({ vary: vary.length ? vary : null });
  };
  return html`<div class="aspects" role="group" aria-label=${t("homework.pick-vary")}><span class="so">${t("homework.pick-vary")}</span>${ASPECTS.map(
    (one) =>
      html`<label class="check"><input type="checkbox" .checked=${live(chosen.includes(one))} @change=${(/** @type {Event} */ event) => turn(one, event)}> ${t(`homework.pick-vary-${one}`)}</label>`,
  )}</div>`;
}

/** @param {number | null} value */
const whole = (value) => (value === null ? null : Math.round(value));

/** What is done with it: saved, sent, tried. @param {HomeworkView} view @param {Picker} session */
function ready(view, session) {
  const { state, t, open } = view;
  const { lang } = state.asked.place;
  const { sheet: made, fragment, code, wrong } = session.get();
  const title = inLanguage(made.title, lang) || t("homework.assignment");
  const save = () => offer(`${fileName(title)}.json`, session.file(), "application/json");
  const place = { ...HOME, lang };
  const address =
    fragment &&
    location.origin +
      location.pathname +
      writeAsked({ task: "", seed: "", side: "task", drill: NO_DRILL, place }) +
      fragment;
  return html`
    ${wrong ? html`<ul class="wrong-sheet" role="alert">${(wrong.problems.length ? wrong.problems.map(({ message }) => message) : [wrong.detail || wrong.title || t("failure.unreachable")]).map((one) => html`<li>${one}</li>`)}</ul>` : nothing}
    <p class="acts"><button type="button" class="main" ?disabled=${!fragment} @click=${() => open(session.made())}>${t("homework.pick-try")}</button>
      <button type="button" class="quiet framed" @click=${save}>${icon("file")}${t("homework.pick-save")}</button>
      <button type="button" class="quiet" @click=${session.clear}>${t("homework.pick-clear")}</button></p>
    ${address ? link(view, address) : nothing}
    <p class="so" role="status">${code ? t("homework.code", { code }) : ""}</p>`;
}

/** The address for the class, and as a code for phones. @param {HomeworkView} view @param {string} address */
function link({ t }, address) {
  const copy = async (/** @type {Event} */ { currentTarget }) => {
    const button = /** @type {HTMLElement} */ (currentTarget);
    const field = /** @type {HTMLInputElement} */ (button.previousElementSibling);
    const done = await toClipboard(address);
    if (!done) field.select();
    /** @type {HTMLElement} */ (button.nextElementSibling).textContent = t(
      done ? "homework.pick-copied" : "homework.pick-by-hand",
    );
  };
  return html`<div class="link-of-sheet"><label for="pick-link">${t("homework.pick-link")}</label>
    <p class="copied"><input id="pick-link" readonly .value=${address} @focus=${(/** @type {Event} */ { target }) => /** @type {HTMLInputElement} */ (target).select()}>
      <button type="button" class="quiet framed" @click=${copy}>${t("homework.pick-copy")}</button><span role="status"></span></p>
    <p class="so">${t("homework.pick-link-help")}</p>
    ${address.length > LONGEST ? html`<p class="so">${t("homework.pick-too-long")}</p>` : html`<details><summary>${t("homework.pick-code")}</summary>${code(address, t)}</details>`}</div>`;
}

/** @param {string} address @param {HomeworkView["t"]} t */
function code(address, t) {
  const made = generate(address);
  const side = made.size + 2 * QUIET;
  return html`<svg class="qr" role="img" aria-label=${t("homework.pick-code")} viewBox="${-QUIET} ${-QUIET} ${side} ${side}">
    ${svg`<rect x=${-QUIET} y=${-QUIET} width=${side} height=${side} /><path d=${pathOf(made)} />`}</svg>`;
}
