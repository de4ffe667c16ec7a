/** The page as a whole: derivation beside drawing, plots and values. */

import { html, nothing } from "lit-html";
import { chapters, isAtEnd, missing, pager, steps } from "./steps.js";
import { failure } from "./failure.js";
import { header, pen } from "./header.js";
import { player } from "./player.js";
import { caveats, report } from "./report.js";
import { values } from "./values.js";
import { icon } from "./icons.js";
import { inLanguage } from "../model/catalog.js";
import { isUnderWay, missingIn } from "../model/derivations.js";
import { OWN } from "../model/own.js";
import { FORMULATIONS, oneOf } from "../model/url.js";

/**
 * @typedef {object} View  what views may know and do
 * @property {import("../model/session.js").State} state
 * @property {import("../model/session.js").Session} session
 * @property {import("../model/clock.js").Clock} clock
 * @property {import("../model/catalog.js").Translate} t
 * @property {(id: string) => string} methodTitle
 * @property {(patch: Partial<import("../model/types.js").Place>) => string} link
 * @property {(event: Event, go: () => void) => void} follow
 * @property {() => void} togglePlay
 * @property {(t: number) => void} scrub
 * @property {(factor: number) => void} setSpeed
 * @property {() => void} fullscreen
 * @property {() => void} reload
 * @property {((view: View) => unknown) | undefined} overlays  once one has been asked for
 * @property {ReturnType<ReturnType<typeof import("./figure/why.js").createWhy>>} [why]  with the instruments
 * @property {ReturnType<ReturnType<typeof import("./figure/integrals.js").createIntegrals>>} [integrals]  with the instruments
 * @property {import("./figure/open.js").Instruments | null} instruments  once they have been fetched
 * @property {{view: (view: View) => unknown, copy: () => void} | null} editor  once it has been opened
 * @property {() => void} enterLecture
 * @property {import("./lecture/open.js").Lecture | null} lecture  while lecture mode is on
 * @property {(t: import("../model/catalog.js").Translate) => unknown} missed  the tools that could not be fetched
 */

const PANELS = /** @type {const} */ (["derivation", "plots", "values"]);

/** @param {View} view */
export function page(view) {
  const { state, t } = view;
  const { failures } = state;
  return html`
    <a class="skip" href="#derivation">${t("skip")}</a>
    ${header(view)}
    <main class="desk" data-panel=${state.place.panel} data-view=${view.lecture ? "lecture" : nothing} data-beside=${state.place.beside} ?data-lost=${isLost(state)}>
      ${state.place.edit ? writing(view) : view.lecture ? view.lecture.slide(view) : reading(view)}
      <section class="figure ${failures.simulation && !isKept(state) ? "failed" : ""}" aria-label=${t("drawing")}>
        ${drawing(view)}
        ${player(view)}
        ${(state.place.vary && view.instruments?.panel(view)) || values(view)}
        <div class="plots" role="group" aria-label=${t("plots")}>
          <div class="canvas" role="img" aria-label=${t("plots.description")}></div><div class="rows"></div><div class="beyond" hidden></div>
          <div class="ghost" hidden></div><div class="cursor"></div><div class="plot-tools">${view.instruments?.plotTools(view)}</div>
        </div>
        ${report(view)}
      </section>
    </main>
    ${panels(view)}
    ${view.overlays?.(view)} ${view.missed(t)}
  `;
}

/** Whether there is nothing to draw, nor a scene being written that will be. @param {View["state"]} state */
const isLost = ({ scene, failures, place }) => !scene && !place.edit && Boolean(failures.page ?? failures.scene);

/** @param {View} view */
function reading(view) {
  const { t } = view;
  return html`
    <section class="derivation" id="derivation" aria-label=${t("derivation")} aria-busy=${isUnderWay(view.state.derivation)}>
      <div class="contents">${formulation(view)}${release(view)}${chapters(view)}</div>
      <div class="scroll" tabindex="0" role="region" aria-label=${t("derivation")}>
        ${trouble(view) ?? steps(view)} ${missing(view.state)} ${canonical(view)}
      </div>
      ${pager(view)}
    </section>`;
}

/** Behind the last step: opens the chapter of Hamilton's canonical equations. @param {View} view */
const canonical = ({ state, session, t }) =>
  isAtEnd(state) && !state.place.more && !missingIn(state.derivation)
    ? html`<button class="quiet small further" @click=${() => session.tellMore("canonical")}>${t("canonical.open")}</button>`
    : nothing;

/** Which formulation leads to the equations. @param {View} view */
function formulation({ state, session, t }) {
  const chosen = (/** @type {Event} */ { target }) =>
    session.formulate(oneOf(FORMULATIONS, /** @type {HTMLSelectElement} */ (target).value, state.place.formulation));
  return html`
    <label class="choice formulation" title=${t("formulation.choose")}>
      <span class="unseen">${t("formulation.choose")}</span>
      <select @change=${chosen}>
        ${FORMULATIONS.map((id) => html`<option value=${id} ?selected=${id === state.place.formulation}>${t(`formulation.${id}`)}</option>`)}
      </select>${icon("chevron")}
    </label>`;
}

/** What the scene holds fixed, each with the way to the force that holds it. @param {View} view */
function release({ state, session, t }) {
  const { place, derivation } = state;
  const held = derivation?.result?.releasable ?? [];
  const chosen = (/** @type {Event} */ { target }) => session.release(/** @type {HTMLSelectElement} */ (target).value);
  if (!held.length) return nothing;
  const now = held.find(({ name }) => name === place.release);
  return html`
    <label class="choice release" title=${t("release.choose")}>
      <span class="unseen">${t("release.choose")}</span>
      <span class="chosen" aria-hidden="true">${now ? t(`release.${now.kind}`, { name: now.name }) : t("release.none")}</span>
      <select @change=${chosen}>
        <option value="" ?selected=${!place.release}>${t("release.choose")}</option>
        ${held.map(({ name, kind }) => html`<option value=${name} ?selected=${name === place.release}>${t(`release.${kind}`, { name })}</option>`)}
      </select>${icon("chevron")}
    </label>`;
}

/** @param {View} view */
function writing(view) {
  return html`
    <section class="derivation editor" id="derivation" aria-label=${view.t("editor")}>
      ${view.editor ? view.editor.view(view) : html`<p class="notice" role="status">…</p>`}
    </section>`;
}

/** What stands in the derivation's place when there is none. @param {View} view */
function trouble(view) {
  const { page, scene, derivation } = view.state.failures;
  const { reload, t } = view;
  if (page) return failure(page, t("failure.page"), reload, t);
  if (scene?.status === 404) return unknownScene(view);
  if (scene) return failure(scene, t("failure.page"), reload, t, nearestMember(view));
  return derivation && failure(derivation, t("failure.derivation"), reload, t, mending(view));
}

/** The way into the editor from one's own scene, which the service has refused. @param {View} view */
function mending(view) {
  if (view.state.place.scene !== OWN || !view.state.failures.derivation?.problems.length) return nothing;
  const { label, press } = pen(view);
  return html`<button class="main" @click=${press}>${label}</button>`;
}

/** The way to the nearest member there is of a family, where the address asks for another. @param {View} view */
function nearestMember({ state, link, follow, session, t }) {
  const { scene, n } = state.place;
  const family = state.scenes.find(({ id }) => id === scene)?.family;
  if (!family || !n) return nothing;
  const nearest = Math.min(family.max, Math.max(family.min, n));
  return html`<a class="main" href=${link({ n: nearest, step: "" })}
    @click=${(/** @type {Event} */ event) => follow(event, () => session.choose(scene, "", nearest))}>${t("failure.family", { parameter: family.parameter, n: nearest })}</a>`;
}

/** An unknown scene is answered with those there are. @param {View} view */
function unknownScene({ state, link, follow, session, t }) {
  return html`
    <div class="failure" role="alert">
      <h2>${t("failure.scene")}</h2>
      <ul>${state.scenes.map(
        ({ id, title }) => html`<li><a href=${link({ scene: id, step: "" })}
        @click=${(/** @type {Event} */ event) => follow(event, () => session.choose(id))}>${inLanguage(title, state.place.lang)}</a></li>`,
      )}</ul>
    </div>
  `;
}

/** @param {View} view */
function drawing(view) {
  const { state, t, instruments } = view;
  const { lang } = state.place;
  const title = inLanguage(state.scene?.title, lang);
  const summary = inLanguage(state.scene?.summary, lang);
  const waiting = !state.trajectory && !state.failures.simulation;
  return html`
    <div class="drawing ${waiting ? "waiting" : ""}">
      <svg role="img" aria-label=${t("drawing.description", { title, summary })} aria-describedby="motion"></svg>
      <div class="labels" aria-hidden="true"></div>
      <div class="readouts" aria-hidden="true"></div>
      <div class="figure-tools">${instruments?.tools(view)}</div>
      <p class="unseen" id="motion" role="status"></p>
      ${waiting ? html`<p class="patience" role="status">${patience(view)}</p>` : nothing}
      ${ended(view)}
      ${isKept(state) ? nothing : unmoved(view)}
    </div>
    ${told(view)}
  `;
}

/** What is to be said of the motion that is seen: below the drawing, of which it covers nothing. @param {View} view */
const told = (view) => (isKept(view.state) ? html`<div class="told">${doubt(view)}${unmoved(view)}</div>` : nothing);

/** Whether there is a motion to be seen, be it of the values before. @param {Pick<View["state"], "trajectory">} state */
const isKept = ({ trajectory }) => Boolean(trajectory?.t.length);

/** What went wrong with the motion. The one that was computed before stays in sight, and is said to be that. @param {View} view */
function unmoved({ state, session, t }) {
  const { simulation, scene } = state.failures;
  if (!simulation || scene) return nothing;
  const heading = t(isKept(state) ? "failure.kept" : "failure.simulation");
  return failure(simulation, heading, () => session.resimulate({}), t);
}

/** What is to be said of the motion, in short, where there is no report of it. @param {View} view */
function doubt(view) {
  const [first] = caveats(view);
  return first ? html`<p class="doubt" role="status">${first}</p>` : nothing;
}

/** What is to be said of a motion that ended before there was anything to draw. @param {View} view */
function ended(view) {
  const [first, ...rest] = caveats(view);
  if (!first || isKept(view.state)) return nothing;
  return html`<div class="failure" role="alert"><h2>${view.t("failure.simulation")}</h2>${[first, ...rest].map((sentence) => html`<p>${sentence}</p>`)}</div>`;
}

/** What keeps the motion waiting: the scene, or its computation. @param {View} view */
function patience({ state, t }) {
  if (state.place.scene === OWN && !state.scene) return t("drawing.unwritten");
  return html`${t("drawing.loading")} <small>${t("drawing.first-start")}</small>`;
}

/** Which part a narrow screen shows below the drawing. @param {View} view */
function panels({ state, session, t }) {
  return html`
    <nav class="panels" aria-label=${t("panel.choose")}>
      ${PANELS.map(
        (panel) => html`
        <button aria-pressed=${String(state.place.panel === panel)} @click=${() => session.move({ panel })}>${t(panel === "derivation" && state.place.edit ? "editor" : `panel.${panel}`)}</button>`,
      )}
    </nav>
  `;
}
