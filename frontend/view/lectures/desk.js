/** What stands in the presenter's window of a hall. */

import { html, nothing } from "lit-html";
import { live } from "lit-html/directives/live.js";
import { prose } from "../formula.js";
import { icon } from "../icons.js";
import { plainly } from "../../model/prose.js";
import { clockText, elapsed } from "../../model/lecture/timer.js";
import { pointIn } from "../../model/lectures/ink.js";
import { palette } from "./hall.js";
import { inking } from "./inking.js";

/** @typedef {import("../../model/lecture/timer.js").Timer} Timer */
/** @typedef {{timer: Timer, now: number, pen: {colour: number, erase: boolean} | null, spotted: boolean}} Tools */
/** @typedef {Tools & {standing: import("../../model/lectures/line.js").Standing, lecture: import("../../model/lectures/lecture.js").Lecture}} Shown */
/**
 * @typedef {Pick<import("./hall.js").Acts, "go" | "to" | "blacken" | "takePen" | "colour" | "erase" | "wipe" | "spot" | "ink"> & {
 *   shine: (at: import("../../model/lectures/ink.js").Point | null) => void, toggleTimer: () => void, resetTimer: () => void}} Acts
 */
/** @typedef {import("../../model/catalog.js").Translate} Translate */

/** @param {Shown | null} shown @param {Tools} tools @param {Acts} acts @param {Translate} t */
export function desk(shown, tools, acts, t) {
  return html`
    <main class="hall-desk" aria-label=${t("presenter")}>
      <header>${times(tools, acts, t)}<h1>${shown ? shown.lecture.title : t("presenter")}</h1></header>
      ${shown ? at(shown, acts, t) : html`<p class="notice" role="status">${t("hall.waiting")}</p>`}
    </main>`;
}

/** @param {Tools} tools @param {Acts} acts @param {Translate} t */
function times({ timer, now }, { toggleTimer, resetTimer }, t) {
  const label = t(timer.since === null ? "presenter.start" : "presenter.pause");
  return html`
    <div class="times">
      <span title=${t("presenter.clock")}>${new Date(now).toLocaleTimeString(document.documentElement.lang, { hour: "2-digit", minute: "2-digit" })}</span>
      <span class="elapsed" role="timer" aria-live="off" title=${t("presenter.elapsed")}>${clockText(elapsed(timer, now))}</span>
      <button class="tool" title=${label} aria-label=${label} @click=${toggleTimer}>${icon(timer.since === null ? "play" : "pause")}</button>
      <button class="quiet small" @click=${resetTimer}>${t("presenter.reset")}</button>
    </div>`;
}

/** @param {Shown} shown @param {Acts} acts @param {Translate} t */
function at(shown, acts, t) {
  const { standing, lecture, pen, spotted } = shown;
  const { index, phase, ink, spot, black } = standing;
  const stop = lecture.stops[index];
  const next = lecture.stops[index + 1];
  const shine = (/** @type {PointerEvent} */ { clientX, clientY, currentTarget }) =>
    acts.shine(pointIn(clientX, clientY, /** @type {Element} */ (currentTarget).getBoundingClientRect()));
  return html`
    <section class="now" aria-labelledby="now">
      <h2 id="now">${index + 1} / ${lecture.stops.length} · ${prose(stop.title)} ${black ? html`<strong>${t("presenter.black")}</strong>` : nothing}
        ${phase === "asked" ? html`<strong>${t(stop.poll ? "hall.asked" : "lectures.hidden")}</strong>` : nothing}</h2>
      <div class="preview"><div class="small-stage" @pointermove=${spotted ? shine : nothing} @pointerleave=${() => acts.shine(null)}>
        <div class="frames" aria-hidden="true"></div>
        ${inking({ ink, spot, pen }, acts.ink)}</div></div>
    </section>
    <section class="notes" aria-labelledby="notes" tabindex="0">
      <h2 id="notes">${t("hall.notes")}</h2>
      ${(stop.notes ?? "").split(/\n+/).map((text) => (text.trim() ? html`<p>${prose(text)}</p>` : nothing))}
      ${stop.poll ? html`<h3>${prose(stop.poll.question)}</h3><ol type="A">${stop.poll.choices.map((choice, i) => html`<li ?data-right=${stop.poll?.right === i + 1}>${prose(choice)}${stop.poll?.right === i + 1 ? html` <span aria-label=${t("hall.right")}>✓</span>` : nothing}</li>`)}</ol>` : nothing}
    </section>
    <section class="next" aria-labelledby="next"><h2 id="next">${t("presenter.next")}</h2>
      <p>${next ? prose(next.title) : t("hall.end")}</p></section>
    <footer>
      <button class="quiet" @click=${() => acts.go(-1)}>${icon("previous")}${t("step.previous")}</button>
      <button class="main" @click=${() => acts.go(1)}>${t("step.next")}${icon("next")}</button>
      <label class="choice"><span class="unseen">${t("hall.stops")}</span>
        <select .value=${live(String(index))} @change=${(/** @type {Event} */ { target }) => acts.to(Number(/** @type {HTMLSelectElement} */ (target).value))}>
          ${lecture.stops.map((one, i) => html`<option value=${i} ?selected=${i === index}>${i + 1} ${plainly(one.title)}</option>`)}
        </select>${icon("chevron")}</label>
      <button class="quiet" aria-pressed=${String(pen !== null)} @click=${acts.takePen}>${icon("pen")}${t("hall.pen-short")}</button>
      ${pen ? palette(pen, acts, t) : nothing}
      <button class="quiet" aria-pressed=${String(spotted)} @click=${acts.spot}>${icon("spot")}${t("hall.spot-short")}</button>
      <button class="quiet" aria-pressed=${String(black)} @click=${acts.blacken}>${icon("black")}${t("presenter.blacken")}</button>
    </footer>`;
}
