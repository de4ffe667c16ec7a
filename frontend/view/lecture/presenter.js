/** The presenter's window: the step that is shown, the one that comes, notes and the time. */

import { html, nothing } from "lit-html";
import { live } from "lit-html/directives/live.js";
import { displayed, prose } from "../formula.js";
import { appearance, brand, language, lettersOf } from "../header.js";
import { icon } from "../icons.js";
import { inLanguage } from "../../model/catalog.js";
import { numberingBy } from "../../model/lecture/numbering.js";
import { noteOf } from "../../model/lecture/notes.js";
import { isConcluded, onwards, partsOf, within } from "../../model/lecture/stops.js";
import { clockText, elapsed } from "../../model/lecture/timer.js";
import { indexOf } from "../../model/reveal.js";

/**
 * @typedef {import("../header.js").Appearance & {here: import("../../model/lecture/link.js").Here | null,
 *   lines: import("../../model/reveal.js").Line[], notes: import("../../model/lecture/notes.js").Notes,
 *   timer: import("../../model/lecture/timer.js").Timer, now: number,
 *   session: {wish: (wish: import("../../model/lecture/link.js").Wish) => void, write: (text: string) => void,
 *   toggleTimer: () => void, resetTimer: () => void}}} PresenterView
 */
/** @typedef {import("../../model/types.js").Step} Step */

/** @param {PresenterView} view */
export function page(view) {
  const { here, lines, t, state } = view;
  const title = here ? inLanguage(here.title, state.place.lang) : t("presenter");
  return html`
    <header class="top">
      ${brand(view)}
      <div class="scene"><h1 style=${lettersOf(title)}>${title}</h1></div>
      ${times(view)}
      <div class="tools">${language(view)}${appearance(view)}</div>
    </header>
    <main class="presenter">${here && lines.length ? desk(here, view) : html`<p class="notice" role="status">${t("presenter.waiting")}</p>`}</main>`;
}

/** @param {PresenterView} view */
function times({ timer, now, session, state, t }) {
  const label = t(timer.since === null ? "presenter.start" : "presenter.pause");
  return html`
    <div class="times">
      <span title=${t("presenter.clock")}>${new Date(now).toLocaleTimeString(state.place.lang, { hour: "2-digit", minute: "2-digit" })}</span>
      <span class="elapsed" role="timer" aria-live="off" title=${t("presenter.elapsed")}>${clockText(elapsed(timer, now))}</span>
      <button class="tool" title=${label} aria-label=${label} @click=${session.toggleTimer}>${icon(timer.since === null ? "play" : "pause")}</button>
      <button class="quiet small" @click=${session.resetTimer}>${t("presenter.reset")}</button>
    </div>`;
}

/** @param {import("../../model/lecture/link.js").Here} here @param {PresenterView} view */
function desk(here, view) {
  const { lines, notes, session, t } = view;
  const { place } = here;
  const index = indexOf(lines, place.step);
  const { part } = within(lines, place, 0);
  const next = onwards(lines, { step: lines[index].step.id, part }, 1, place.pace);
  const numbering = numberingBy(here.bodies);
  const last = next.step === lines[index].step.id && next.part === part;
  return html`
    <section class="now" aria-labelledby="now">
      <h2 id="now">${t("presenter.now")} <span class="count">${index + 1} / ${lines.length}</span>
        ${here.overlay === "black" ? html`<strong>${t("presenter.black")}</strong>` : nothing}</h2>
      ${sheet(lines[index], part, numbering)}
    </section>
    <section class="next" aria-labelledby="next">
      <h2 id="next">${t("presenter.next")}</h2>
      ${last ? html`<p class="notice">${t("presenter.end")}</p>` : sheet(lines[indexOf(lines, next.step)], next.part, numbering)}
    </section>
    <section class="notes" aria-labelledby="notes">
      <h2 id="notes">${t("presenter.notes")}</h2>
      <textarea aria-labelledby="notes" placeholder=${t("presenter.notes-hint")} .value=${live(noteOf(notes, place.scene, place.step))}
        @input=${(/** @type {Event} */ { target }) => session.write(/** @type {HTMLTextAreaElement} */ (target).value)}></textarea>
    </section>
    <footer class="pager">
      <button class="quiet" @click=${() => session.wish({ kind: "go", by: -1 })}>${icon("previous")}${t("step.previous")}</button>
      <button class="main" @click=${() => session.wish({ kind: "go", by: 1 })}>${t("step.next")}${icon("next")}</button>
      <button class="quiet" @click=${() => session.wish({ kind: "within", by: 1 })}>${icon("chevron")}${t("presenter.substep")}</button>
      <label class="choice jumpto"><span class="unseen">${t("jump")}</span>
        <select .value=${live(lines[index].step.id)} @change=${(/** @type {Event} */ { target }) => session.wish({ kind: "goTo", step: /** @type {HTMLSelectElement} */ (target).value })}>
          ${lines.map(({ step, number }) => html`<option value=${step.id} ?selected=${step.id === lines[index].step.id}>${number} ${step.title.replaceAll("$", "")}</option>`)}
        </select>${icon("chevron")}</label>
      <button class="quiet" aria-pressed=${String(here.overlay === "black")} @click=${() => session.wish({ kind: "overlay", name: "black" })}>${icon("black")}${t("presenter.blacken")}</button>
    </footer>`;
}

/**
 * A step as far as it is shown, in the order of the slide: its substeps, and below them its result.
 * @param {import("../../model/reveal.js").Line} line @param {number} part @param {import("../../model/lecture/numbering.js").Numbering} numbering
 */
function sheet({ step, number }, part, { short, within: numbersIn }) {
  const parts = partsOf(step).slice(0, part);
  const written = (/** @type {Step} */ one) => one.marked || one.latex;
  const formula = (/** @type {Step} */ one) => (written(one) ? displayed(short(written(one)), false, one) : nothing);
  const numbers = numbersIn([step, ...parts.map(({ step: one }) => one)].map(written));
  const words = (/** @type {Step} */ { text }) => (text ? html`<p class="prose">${prose(text)}</p>` : nothing);
  return html`
    <div class="sheet" tabindex="0" role="region" aria-label=${number}>
      <h3 class="title"><span class="number">${number}</span><span>${prose(step.title)}</span></h3>
      ${numbers.length ? html`<p class="numbers">${numbers.map((one) => html`<span class="numbered"><b>${one.number}</b> ${one.name}</span> `)}</p>` : nothing}
      ${words(step)}
      ${parts.map(({ step: one }) => html`${one.title ? html`<h4>${prose(one.title)}</h4>` : nothing}${words(one)}${formula(one)}`)}
      ${isConcluded(step, part) ? formula(step) : nothing}
    </div>`;
}
