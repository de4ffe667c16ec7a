/** The top line: which scene, which language, which appearance. */

import { html, nothing } from "lit-html";
import { live } from "lit-html/directives/live.js";
import { icon } from "./icons.js";
import { addEntry, addTool, titleOfPlace } from "./lectures/adding.js";
import { inLanguage } from "../model/catalog.js";
import { OWN } from "../model/own.js";
import { degreesOf } from "../model/subject.js";
import { LANGUAGES, PAGES, pageAddress } from "../model/url.js";

/** @typedef {import("./page.js").View} View */
/** @typedef {{state: Pick<View["state"], "place">, session: Pick<View["session"], "language" | "move">, t: View["t"]}} Appearance */

const THEMES = ["auto", "light", "dark", "projector"];

/** @param {Event} event */
const chosen = (event) => /** @type {HTMLSelectElement} */ (event.target).value;

/** @param {View} view */
export function header(view) {
  return html`
    <header class="top">
      ${brand(view)}
      ${sceneChooser(view)}
      ${places(view, "scene", [...actions(view), penEntry(view), appearance(view)])}
      <div class="tools">
        ${penTool(view)}
        ${language(view)}
        ${appearance(view)}
        ${buttons(view)}
      </div>
    </header>
  `;
}

/**
 * Gives the page its language and its theme. Written only when they change: for either, every style is found anew.
 * @param {Pick<import("../model/types.js").Place, "lang" | "theme">} place @param {boolean} dark  what the viewer prefers
 */
export function dressed({ lang, theme }, dark) {
  const { documentElement: page } = document;
  const worn = theme === "auto" ? (dark ? "dark" : "light") : theme;
  if (page.lang !== lang) page.lang = lang;
  if (page.dataset.theme !== worn) page.dataset.theme = worn;
  return worn;
}

/** The way to the start page. @param {Pick<Appearance, "state" | "t">} view */
export function brand({ state, t }) {
  return html`<a class="brand" href=${pageAddress("", state.place)} title=${t("tagline")} aria-label=${`δq · ${t("place.start")}`}><span class="delta">δ</span><span class="q">q</span></a>`;
}

/** An entry of the menu that does something. @param {string} label @param {() => void} press */
const action = (label, press) => html`
  <button class="action" popovertarget="places" popovertargetaction="hide" @click=${press}>${label}</button>`;

/** Above a derivation. @typedef {Pick<View, "enterLecture" | "t"> & {session: Pick<View["session"], "overlay">,
 *   state: Pick<View["state"], "lines" | "place"> & {scene?: View["state"]["scene"]}}} Above */

/** What a stop at the present step is called. @param {Pick<Above, "state" | "t">} view */
export function stopTitle({ state, t }) {
  const { lines, place, scene } = state;
  const subject = scene ? inLanguage(scene.title, place.lang) : t("place.proof");
  return titleOfPlace(lines.find(({ step }) => step.id === place.step)?.step.title, subject);
}

/** @param {Above} view */
export function buttons(view) {
  const { session, enterLecture, t } = view;
  return html`
    <button class="tool" title=${t("tool.share")} aria-label=${t("tool.share")} @click=${() => session.overlay("share")}>${icon("share")}</button>
    ${addTool(() => stopTitle(view), t)}
    <button class="tool" title=${t("tool.overview")} aria-label=${t("tool.overview")} @click=${() => session.overlay("overview")}>${icon("overview")}</button>
    <button class="tool wide-only" title=${t("tool.lecture")} aria-label=${t("tool.lecture")} @click=${enterLecture}>${icon("lecture")}</button>
    <button class="tool wide-only" title=${t("tool.help")} aria-label=${t("tool.help")} @click=${() => session.overlay("help")}>${icon("help")}</button>`;
}

/**
 * What the buttons of the header do, where there is no room for them.
 * @param {Above} view
 */
export function actions(view) {
  const { session, enterLecture, t } = view;
  return [
    action(t("tool.overview"), () => session.overlay("overview")),
    action(t("tool.share"), () => session.overlay("share")),
    action(t("tool.lecture"), enterLecture),
    addEntry(() => stopTitle(view), t),
  ];
}

/** The way to every page, behind a button where there is no room for it. @param {Pick<Appearance, "state" | "t">} view @param {string} here @param {unknown} [more] */
export function places({ state, t }, here, more = nothing) {
  return html`
    <button class="tool menu" popovertarget="places" title=${t("places")} aria-label=${t("places")}>${icon("menu")}</button>
    <nav class="places" id="places" popover aria-label=${t("places")}>
      <a class="action home" href=${pageAddress("", state.place)}>${t("place.start")}</a>${PAGES.map(
        (name) => html`
      <a href=${pageAddress(name, state.place)} aria-current=${name === here ? "page" : nothing}>${t(`place.${name}`)}</a>`,
      )}${more}</nav>`;
}

/**
 * The heading that says what is chosen, and chooses: written over a select, which cannot break its line.
 * @param {string} label @param {string} title @param {unknown} select
 */
export const titleMenu = (label, title, select) => html`
  <h1 style=${lettersOf(title)}><label class="choice"><span class="unseen">${label}</span><span class="chosen" aria-hidden="true">${title}</span>${select}${icon("chevron")}</label></h1>`;

/** How large a heading may be set depends on its length. @param {string} title */
export const lettersOf = (title) => `--letters:${title.length}`;

/** Into the editor with a copy of the scene, or with one's own; and out of it. @param {View} view */
export function pen({ state, session, editor, t }) {
  const { edit, scene } = state.place;
  const label = t(edit ? "editor.leave" : scene === OWN ? "editor.open" : "editor.copy");
  const press = () => {
    session.move({ edit: edit ? "" : "form", panel: "derivation" });
    if (!edit) editor?.copy();
  };
  return { label, press, pressed: String(edit !== ""), disabled: !state.scene && scene !== OWN };
}

/** @param {View} view */
function penTool(view) {
  const { label, press, pressed, disabled } = pen(view);
  return html`<button class="tool pen" title=${label} aria-label=${label} aria-pressed=${pressed} ?disabled=${disabled} @click=${press}>${icon("pen")}</button>`;
}

/** @param {View} view */
function penEntry(view) {
  const { label, press, disabled } = pen(view);
  return disabled ? nothing : action(label, press);
}

/** The built-in scenes, and the viewer's own if it is there. @param {View["state"]} state */
function entriesOf({ scenes, scene, derivation, place }) {
  if (place.scene !== OWN || !scene) return scenes;
  return [
    { id: OWN, title: scene.title, summary: scene.summary, degrees_of_freedom: degreesOf(scene, derivation) },
    ...scenes,
  ];
}

/** Whether a title may still come: nobody is asked to choose what has been chosen. @param {View["state"]} state */
const isComing = ({ scenes, failures }) => !scenes.length && !failures.page;

/** @param {View} view */
function sceneChooser({ state, session, t }) {
  const { lang, scene } = state.place;
  const shown = state.scene; // its title says how long a chain is
  const entries = entriesOf(state);
  const entry = entries.find((candidate) => candidate.id === scene);
  const leaveFor = (/** @type {string} */ id) => {
    session.move({ edit: "" });
    void session.choose(id);
  };
  const freedoms = shown ? degreesOf(shown, state.derivation) : (entry?.degrees_of_freedom ?? 0);
  const about = inLanguage(state.scene?.summary, lang);
  const titleOf = (/** @type {import("../model/types.js").SceneEntry} */ one) =>
    inLanguage((one.id === scene && shown?.title) || one.title, lang);
  const select = html`
    <select .value=${live(scene)} @change=${(/** @type {Event} */ e) => leaveFor(chosen(e))}>
      ${entry ? nothing : html`<option value=${scene} selected>${t("scene.choose")}</option>`}
      ${entries.map((one) => html`<option value=${one.id} ?selected=${one.id === scene}>${titleOf(one)}</option>`)}
    </select>`;
  return html`
    <div class="scene">
      ${titleMenu(t("scene.choose"), entry ? titleOf(entry) : isComing(state) ? "" : t("scene.choose"), select)}
      <p class="summary">${entry ? t("scene.freedoms", { count: freedoms }) : ""}
        ${entry && about ? html`<span class="more">${about}</span>` : nothing}</p>
    </div>
  `;
}

/** @param {Appearance} view */
export function appearance({ state, session, t }) {
  return html`
    <label class="choice theme" title=${t("theme.choose")}>
      <span class="unseen">${t("theme.choose")}</span>${icon("theme")}
      <select .value=${live(state.place.theme)} @change=${(/** @type {Event} */ e) => session.move({ theme: chosen(e) })}>
        ${THEMES.map((theme) => html`<option value=${theme} ?selected=${theme === state.place.theme}>${t(`theme.${theme}`)}</option>`)}
      </select>${icon("chevron")}
    </label>
  `;
}

/** @param {Appearance} view */
export function language({ state, session, t }) {
  return html`
    <div class="segments" role="group" aria-label=${t("language.choose")}>
      ${LANGUAGES.map(
        (lang) => html`
        <button aria-pressed=${String(state.place.lang === lang)} lang=${lang} title=${t(`language.${lang}`)}
          @click=${() => session.language(lang)}>${lang.toUpperCase()}</button>`,
      )}
    </div>
  `;
}
