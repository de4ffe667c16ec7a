/** The start page: a moving pendulum, the lecture as a course, the scenes, and everything else there is. */

import { html } from "lit-html";
import { icon } from "../icons.js";
import { top } from "../top.js";
import { inLanguage } from "../../model/catalog.js";
import { COURSE, addressOf } from "../../model/start/course.js";
import { HOME, PAGES, pageAddress, writePlace } from "../../model/url.js";

/**
 * @typedef {import("../header.js").Appearance & {scenes: import("../../model/types.js").SceneEntry[]}} StartView
 */

/** The scene that moves at the top of the page. */
export const HERO = "elastic-pendulum";

/** @param {StartView} view */
export function page(view) {
  const { t } = view;
  return html`
    ${top(view, { main: "course", skip: t("start.skip") })}
    <main class="start">
      ${opening(view)}
      <section id="course" aria-labelledby="course-title"><h2 id="course-title">${t("start.course")}</h2>
        <ol class="course">${COURSE.map((part, index) => chapter(part, index, view))}</ol></section>
      <section id="scenes" aria-labelledby="scenes-title"><h2 id="scenes-title">${t("start.scenes")}</h2>
        <p class="lead">${t("start.scenes-lead", { count: view.scenes.length })}</p>
        <ul class="cards">${view.scenes.map((scene) => card(scene, view))}${ownCard(view)}</ul></section>
      <section aria-labelledby="more-title"><h2 id="more-title">${t("start.more")}</h2>
        <ul class="doors">${PAGES.filter((name) => name !== "scene").map((name) => door(name, view))}</ul></section>
    </main>`;
}

/** The lecture that is ready to be given. @param {Pick<import("../../model/types.js").Place, "lang" | "theme">} reader */
function givenAddress(reader) {
  const address = pageAddress("lecture", reader);
  return `${address}${address.includes("?") ? "&" : "?"}shipped=1`;
}

/** @param {StartView} view */
function opening({ state, t }) {
  const first = addressOf(COURSE[0].entries[0], state.place);
  const scene = sceneAddress(HERO, state.place);
  return html`
    <section class="opening">
      <div class="words">
        <h1>${t("start.heading")}</h1>
        <p>${t("start.lead")}</p>
        <p class="ways"><a class="way main" href=${first}>${t("start.begin")}${icon("next")}</a><a class="way" href="#scenes">${t("start.choose")}</a>
          <a class="way" href=${givenAddress(state.place)}>${t("start.give")}${icon("lecture")}</a></p>
      </div>
      <div class="hero">
        <div class="drawing waiting" data-scene=${HERO}><svg aria-hidden="true"></svg><div class="labels" aria-hidden="true"></div></div>
        <p class="patience" role="status">${t("drawing.loading")} <small>${t("drawing.first-start")}</small></p>
        <a href=${scene} aria-label=${t("start.hero")}></a></div>
    </section>`;
}

/** @param {import("../../model/start/course.js").Part} part @param {number} index @param {StartView} view */
function chapter({ id, entries }, index, { state, t }) {
  return html`
    <li><h3><span class="ordinal">${index + 1}</span>${t(`course.${id}`)}</h3>
      <ul>${entries.map((entry) => html`<li><a href=${addressOf(entry, state.place)}>${t(`course.${id}.${entry.id}`)}</a></li>`)}</ul></li>`;
}

/** @param {string} scene @param {Pick<import("../../model/types.js").Place, "lang" | "theme">} reader */
const sceneAddress = (scene, { lang, theme }) => `/scene${writePlace({ ...HOME, scene, lang, theme })}`;

/** @param {import("../../model/types.js").SceneEntry} scene @param {StartView} view */
function card({ id, title, summary, degrees_of_freedom: count }, { state, t }) {
  const { lang } = state.place;
  return html`
    <li><a class="card" href=${sceneAddress(id, state.place)}>
      <div class="drawing waiting" data-scene=${id}><svg aria-hidden="true"></svg><div class="labels" aria-hidden="true"></div></div>
      <h3>${inLanguage(title, lang)}</h3>
      <p>${inLanguage(summary ?? undefined, lang)}</p>
      <p class="count">${t("scene.freedoms", { count })}</p></a></li>`;
}

/** @param {StartView} view */
function ownCard({ state, t }) {
  const { lang, theme } = state.place;
  return html`
    <li><a class="card own" href=${`/scene${writePlace({ ...HOME, lang, theme })}#edit`}>
      <div class="drawing">${icon("pen")}</div><h3>${t("start.own")}</h3><p>${t("start.own-summary")}</p></a></li>`;
}

/** @param {string} name @param {StartView} view */
function door(name, { state, t }) {
  return html`<li><a class="door" href=${pageAddress(name, state.place)}><h3>${t(`place.${name}`)}${icon("next")}</h3><p>${t(`start.${name}`)}</p></a></li>`;
}
