/** One step filling the screen, its substeps below it as far as they have been shown. */

import { html, nothing } from "lit-html";
import { keyed } from "lit-html/directives/keyed.js";
import { displayed, prose } from "../formula.js";
import { icon } from "../icons.js";
import { missing } from "../steps.js";
import { isUnderWay } from "../../model/derivations.js";
import { indexOf } from "../../model/reveal.js";
import { partsOf, within } from "../../model/lecture/stops.js";

/** @typedef {import("../steps.js").View & {fullscreen: () => void, session: Pick<import("../page.js").View["session"], "goTo" | "move" | "overlay">}} Shown  what a slide needs of a page */
/** @typedef {import("../../model/types.js").Step} Step */
/** @typedef {import("./open.js").Lecturing} Lecturing */

/** @param {Shown} view @param {Lecturing} lecture */
export function slide(view, lecture) {
  const { state, t } = view;
  const line = state.lines[indexOf(state.lines, state.place.step)];
  return html`
    <section class="derivation slide" id="derivation" aria-label=${t("derivation")} aria-busy=${isUnderWay(state.derivation)}
      @touchstart=${lecture.touch.start} @touchend=${lecture.touch.end}>
      ${line ? sheet(line, view) : html`<p class="where"></p><div class="scroll"><p class="notice" role="status">${t("derivation.loading")}</p></div>`}
      ${bar(view, lecture)}
    </section>`;
}

/** @param {import("../../model/reveal.js").Line} line @param {Shown} view */
function sheet({ step, number, chapter, chapterIndex }, view) {
  const shown = within(view.state.lines, view.state.place, 0).part;
  return html`
    <p class="where"><span class="ordinal">${chapterIndex + 1}</span>${chapter.title}</p>
    <div class="scroll" tabindex="0" role="region" aria-label=${view.t("derivation")}>
      ${keyed(
        step.id,
        html`
        <article class="step" data-step=${step.id} aria-current="step">
          <h1 class="title"><span class="number">${number}</span><span>${prose(step.title)}${view.why?.button(step)}</span></h1>
          ${view.why?.panel(step)}
          ${words(step, view)}
          ${partsOf(step)
            .slice(0, shown)
            .map((one, i) => part(one, i, view))}
        </article>`,
      )}
      ${more(step, shown, view)} ${missing(view.state)}
    </div>`;
}

/** @param {Step} step @param {Pick<Shown, "why">} view */
function words(step, { why }) {
  const latex = why?.formula(step) ?? (step.marked || step.latex);
  return html`${step.text ? html`<p class="prose">${prose(step.text)}</p>` : nothing}${latex ? displayed(latex, false, step) : nothing}`;
}

/** @param {{step: Step, depth: number}} shown @param {number} place @param {Pick<Shown, "why">} view */
function part({ step, depth }, place, view) {
  return html`
    <section class="part" data-part=${place + 1} style="--depth:${depth}">
      ${step.title ? html`<h2>${prose(step.title)}</h2>` : nothing}
      ${words(step, view)}
    </section>`;
}

/** How many substeps there are to see yet. @param {Step} step @param {number} shown @param {Shown} view */
function more(step, shown, { state, session, t }) {
  const count = partsOf(step).length;
  if (shown >= count) return nothing;
  const show = () => session.goTo(step.id, within(state.lines, state.place, 1).part);
  return html`<button class="quiet more" @click=${show}>${icon("chevron")}${t("lecture.substeps", { shown, count })}</button>`;
}

/** @param {Shown} view @param {Lecturing} lecture */
function bar(view, { go, present, leave, spot, spotted }) {
  const { state, session, t } = view;
  const { place, lines } = state;
  const total = lines.length;
  const position = indexOf(lines, place.step) + 1;
  const tool = (
    /** @type {Parameters<typeof icon>[0]} */ name,
    /** @type {string} */ label,
    /** @type {() => void} */ press,
    /** @type {boolean | null} */ pressed = null,
  ) => html`
    <button class="tool" title=${label} aria-label=${label} aria-pressed=${pressed === null ? nothing : String(pressed)} @click=${press}>${icon(name)}</button>`;
  return html`
    <footer class="pager lecturing">
      ${tool("previous", t("lecture.back"), () => go(-1))}
      ${tool("next", t("lecture.on"), () => go(1))}
      <div class="progress" aria-label=${t("step.progress", { position, total })} role="img">
        <span class="track"><span class="done" style="transform:scaleX(${total ? position / total : 0})"></span></span>
        <span class="count">${total ? `${position} / ${total}` : ""}</span>
      </div>
      ${tool("steps", t("lecture.pace"), () => session.move({ pace: place.pace ? "" : "substeps" }), place.pace !== "")}
      ${tool("spot", t("lecture.spot"), spot, spotted)}
      ${tool("overview", t("tool.overview"), () => session.overlay("overview"))}
      ${tool("black", t("lecture.black"), () => session.overlay("black"))}
      ${tool("presenter", t("lecture.presenter"), present)}
      ${tool("fullscreen", t("tool.fullscreen"), view.fullscreen)}
      ${tool("close", t("lecture.leave"), leave)}
    </footer>`;
}
