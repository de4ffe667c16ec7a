/** The hall: a stop over the whole screen, its poll above it, and a line of buttons below. */

import { html, nothing } from "lit-html";
import { prose } from "../formula.js";
import { icon } from "../icons.js";
import { COLOURS } from "../../model/lectures/ink.js";
import { inking } from "./inking.js";

/** @typedef {import("../../model/lectures/lecture.js").Lecture} Lecture */
/** @typedef {import("../../model/lectures/giving.js").Given} Given */
/** @typedef {import("./inking.js").Inked & {lecture: Lecture, given: Given, black: boolean, overview: boolean, covered: boolean, chosen: number, ready: number, count: number, spotted: boolean}} Shown */
/**
 * @typedef {object} Acts
 * @property {(by: 1 | -1) => void} go
 * @property {(index: number) => void} to
 * @property {(choice: number) => void} choose
 * @property {() => void} overview
 * @property {() => void} blacken
 * @property {() => void} takePen
 * @property {(colour: number) => void} colour
 * @property {() => void} erase
 * @property {() => void} wipe
 * @property {() => void} spot
 * @property {() => void} present
 * @property {() => void} fullscreen
 * @property {() => void} leave
 * @property {(strokes: import("../../model/lectures/ink.js").Stroke[]) => void} ink
 */
/** @typedef {import("../../model/catalog.js").Translate} Translate */

const LETTERS = "ABCD";

/** @param {Shown} shown @param {Acts} acts @param {Translate} t */
export function hall(shown, acts, t) {
  const stop = shown.lecture.stops[shown.given.index];
  return html`
    <main class="hall" aria-label=${shown.lecture.title}>
      <div class="stage" tabindex="-1">
        <div class="frames"></div>
        ${shown.covered ? html`<div class="cover"><h1>${prose(stop.title)}</h1></div>` : nothing}
        ${inking(shown, acts.ink)}
        ${stop.poll && shown.given.phase !== "shown" ? poll(stop.poll, shown, acts, t) : nothing}
        ${shown.black ? html`<div class="black" @click=${acts.blacken}></div>` : nothing}
      </div>
      ${bar(shown, acts, t)}
      ${shown.overview ? overview(shown, acts, t) : nothing}
    </main>`;
}

/** The question, and with the key its answer. @param {import("../../model/lectures/lecture.js").Poll} asked @param {Pick<Shown, "given" | "chosen">} shown @param {Pick<Acts, "choose">} acts @param {Translate} t */
function poll(asked, { given, chosen }, { choose }, t) {
  const answered = given.phase === "answered";
  return html`
    <section class="poll" aria-labelledby="poll-question">
      <h2 id="poll-question">${prose(asked.question)}</h2>
      <ol>${asked.choices.map((choice, i) => {
        const right = answered && asked.right === i + 1;
        return html`
        <li><button ?data-right=${right} ?data-chosen=${answered && chosen === i} ?disabled=${answered} @click=${() => choose(i)}>
          <span class="letter">${LETTERS[i]}</span><span>${prose(choice)}</span>${right ? html`${icon("verified")}<span class="unseen">${t("hall.right")}</span>` : nothing}</button></li>`;
      })}</ol>
    </section>`;
}

/** @param {Shown} shown @param {Acts} acts @param {Translate} t */
function bar({ lecture, given, pen, spotted, ready, count }, acts, t) {
  const total = lecture.stops.length;
  const tool = (
    /** @type {Parameters<typeof icon>[0]} */ name,
    /** @type {string} */ label,
    /** @type {() => void} */ press,
    /** @type {boolean | null} */ pressed = null,
  ) => html`
    <button class="tool" title=${label} aria-label=${label} aria-pressed=${pressed === null ? nothing : String(pressed)} @click=${press}>${icon(name)}</button>`;
  return html`
    <footer class="hall-bar">
      ${tool("previous", t("hall.back"), () => acts.go(-1))}
      ${tool("next", t("hall.on"), () => acts.go(1))}
      <p class="at"><span class="count">${given.index + 1} / ${total}</span> <span class="title">${prose(lecture.stops[given.index].title)}</span></p>
      <p class="ready" role="status">${ready < count ? t("hall.loading", { ready, count }) : nothing}</p>
      ${pen ? palette(pen, acts, t) : nothing}
      ${tool("pen", t("hall.pen"), acts.takePen, pen !== null)}
      ${tool("spot", t("hall.spot"), acts.spot, spotted)}
      ${tool("overview", t("hall.overview"), acts.overview)}
      ${tool("black", t("hall.black"), acts.blacken)}
      ${tool("presenter", t("hall.presenter"), acts.present)}
      ${tool("fullscreen", t("hall.fullscreen"), acts.fullscreen)}
      ${tool("close", t("hall.leave"), acts.leave)}
    </footer>`;
}

/** Colours, the eraser, and all of it away. @param {{colour: number, erase: boolean}} pen @param {Pick<Acts, "colour" | "erase" | "wipe">} acts @param {Translate} t */
export function palette(pen, acts, t) {
  return html`
    <span class="palette" role="group" aria-label=${t("hall.pen")}>
      ${Array.from({ length: COLOURS }, (_, i) => {
        const label = t("hall.colour", { number: i + 1 });
        return html`<button class="tool colour" title=${label} aria-label=${label} aria-pressed=${String(!pen.erase && pen.colour === i)} @click=${() => acts.colour(i)}><span class=${`dot ink-${i}`}></span></button>`;
      })}
      <button class="quiet small" aria-pressed=${String(pen.erase)} @click=${acts.erase}>${t("hall.erase")}</button>
      <button class="quiet small" @click=${acts.wipe}>${t("hall.wipe")}</button>
    </span>`;
}

/** @param {Shown} shown @param {Acts} acts @param {Translate} t */
function overview({ lecture, given }, { to, overview: close }, t) {
  return html`
    <dialog class="hall-overview" aria-label=${t("hall.stops")} @close=${close} @click=${(/** @type {Event} */ e) => e.target === e.currentTarget && close()}>
      <div class="heading"><h2>${lecture.title}</h2><button class="tool" aria-label=${t("close")} title=${t("close")} @click=${close}>${icon("close")}</button></div>
      <ol>${lecture.stops.map(
        (stop, i) => html`
        <li><button ?autofocus=${i === given.index} aria-current=${i === given.index ? "step" : nothing} @click=${() => to(i)}><span class="number">${i + 1}</span><span>${prose(stop.title)}</span></button></li>`,
      )}</ol>
    </dialog>`;
}
