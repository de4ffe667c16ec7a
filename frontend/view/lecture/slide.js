/** One step filling the screen: what it rests on, its substeps as far as they have been shown, and its result below them. */

import { html, nothing } from "lit-html";
import { keyed } from "lit-html/directives/keyed.js";
import { displayed, prose } from "../formula.js";
import { icon } from "../icons.js";
import { missing } from "../steps.js";
import { question } from "./asking.js";
import { called } from "../../model/catalog.js";
import { isUnderWay } from "../../model/derivations.js";
import { indexOf } from "../../model/reveal.js";
import { numberedIn, numberingBy } from "../../model/lecture/numbering.js";
import { premisesOf } from "../../model/lecture/premises.js";
import { isConcluded, partsOf, within } from "../../model/lecture/stops.js";

/** @typedef {import("../steps.js").View & {fullscreen: () => void, session: Pick<import("../page.js").View["session"], "goTo" | "move" | "overlay">}} Shown  what a slide needs of a page */
/** @typedef {import("../../model/types.js").Step} Step */
/** @typedef {import("./open.js").Lecturing} Lecturing */

/** Of the size of the newest formula that those before it have. */
const OLDER = 0.7;

/** @param {Shown} view @param {Lecturing} lecture */
export function slide(view, lecture) {
  const { state, t } = view;
  const line = state.lines[indexOf(state.lines, state.place.step)];
  return html`
    <section class="derivation slide" id="derivation" aria-label=${t("derivation")} aria-busy=${isUnderWay(state.derivation)}
      @touchstart=${lecture.touch.start} @touchend=${lecture.touch.end}>
      ${line ? sheet(line, view, lecture) : html`<p class="where"></p><div class="given"></div><div class="scroll"><p class="notice" role="status">${t("derivation.loading")}</p></div><div class="reason"></div>`}
      ${bar(view, lecture)}
    </section>`;
}

/** @param {import("../../model/reveal.js").Line} line @param {Shown} view @param {Lecturing} lecture */
function sheet(line, view, { asking }) {
  const { step, number, chapter, chapterIndex } = line;
  const stop = within(view.state.lines, view.state.place, 0).part;
  const parts = partsOf(step).slice(0, stop);
  const concluded = isConcluded(step, stop);
  return html`
    <p class="where"><span class="ordinal">${chapterIndex + 1}</span>${chapter.title}${numbers(line, view)}</p>
    ${given(line, view)}
    <div class="scroll" tabindex="0" role="region" aria-label=${view.t("derivation")}>
      ${keyed(
        step.id,
        html`
        <article class="step" data-step=${step.id} aria-current="step">
          <h1 class="title"><span class="number">${number}</span><span>${prose(step.title)}${view.why?.button(step)}</span></h1>
          ${step.text ? html`<p class="prose">${prose(step.text)}</p>` : nothing}
          ${parts.map((one, i) => part(one, i, !concluded && i === parts.length - 1, view))}
          ${
            concluded
              ? html`<section class="result ${stop ? "newest" : ""}" data-terms=${step.id}>${question(asking, view.t, numberingIn(view).short)}
            ${asking.veiled() ? nothing : html`${formulaOf(step, view)}${legend(step, view)}`}</section>`
              : nothing
          }
        </article>`,
      )}
      ${more(step, stop, view)} ${missing(view.state)}
    </div>
    <div class="reason">${view.why?.panel(step)}</div>`;
}

/** The bodies that are called by numbers; a proof has none. @param {Pick<Shown, "state" | "t">} view */
export function bodiesOf({ state, t }) {
  const { scene } = /** @type {{scene?: import("../../model/types.js").Scene | null}} */ (state);
  return numberedIn(scene, (body) => called(scene?.labels, body, state.place.lang, t));
}

/** How bodies are called in formulas. @param {Pick<Shown, "state" | "t">} view */
const numberingIn = (view) => numberingBy(bodiesOf(view));

/** Which body each number in a slide's formulas stands for. @param {import("../../model/reveal.js").Line} line @param {Shown} view */
function numbers(line, view) {
  const steps = [line.step, ...partsOf(line.step).map(({ step }) => step)];
  const latex = [...steps.map(written), ...premisesOf(view.state.lines, line).map((premise) => premise.latex)];
  return numberingIn(view)
    .within(latex)
    .map(({ number, name }) => html`<span class="numbered"><b>${number}</b> ${name}</span>`);
}

/** What the step rests on, pinned above it. @param {import("../../model/reveal.js").Line} line @param {Shown} view */
function given(line, view) {
  const { state, session, link, follow, t } = view;
  const { short } = numberingIn(view);
  const premises = premisesOf(state.lines, line).filter(({ latex }) => latex);
  if (!premises.length) return html`<div class="given"></div>`;
  const one = (/** @type {import("../../model/lecture/premises.js").Premise} */ { step, line: from, latex }) => html`
    <li data-terms=${step.id}><a class="from" href=${link({ step: from.step.id })} title=${step.title || from.step.title}
      @click=${(/** @type {Event} */ event) => follow(event, () => session.goTo(from.step.id))}>${from.number}</a>${displayed(short(latex), false, step)}</li>`;
  return html`<details class="given" open><summary>${icon("chevron")}<span>${t("lecture.given")}</span></summary><ul>${premises.map(one)}</ul></details>`;
}

/** Its terms are marked by what became of them. @param {Step} step */
const written = (step) => step.marked || step.latex;

/** @param {Step} step @param {Pick<Shown, "why" | "state" | "t">} view */
const latexOf = (step, view) => numberingIn(view).short(view.why?.formula(step) ?? written(step));

/** @param {Step} step @param {Pick<Shown, "why" | "state" | "t">} view */
function formulaOf(step, view) {
  const latex = latexOf(step, view);
  return latex ? displayed(latex, false, step) : nothing;
}

/** What the hatching of terms means stands where they are seen; with the reason open it stands there. @param {Step} step @param {Shown} view */
const legend = (step, { why, state }) =>
  why && state.place.why !== step.id ? html`<div class="meanings">${why.legend(step)}</div>` : nothing;

/** The formulas that are shown, the one that is talked about first. @param {Shown} view @param {boolean} veiled  the result is hidden @returns {import("./filled.js").Shown[]} */
export function formulas(view, veiled) {
  const { state } = view;
  const line = state.lines[indexOf(state.lines, state.place.step)];
  if (!line) return [];
  const stop = within(state.lines, state.place, 0).part;
  const concluded = isConcluded(line.step, stop);
  const parts = partsOf(line.step).slice(0, stop);
  const shown = parts.map(({ step, depth }, i) => ({
    latex: latexOf(step, view),
    share: !concluded && i === parts.length - 1 ? 1 : OLDER,
    depth: depth + 1,
  }));
  return [
    ...(concluded && !veiled ? [{ latex: latexOf(line.step, view), share: 1, depth: 0 }] : []),
    ...shown.reverse(),
  ].filter(({ latex }) => latex);
}

/** @param {{step: Step, depth: number}} shown @param {number} place @param {boolean} newest @param {Pick<Shown, "why" | "state" | "t">} view */
function part({ step, depth }, place, newest, view) {
  return html`
    <section class="part ${newest ? "newest" : ""}" data-part=${place + 1} data-terms=${step.id} style="--depth:${depth}">
      ${step.title ? html`<h2>${prose(step.title)}</h2>` : nothing}
      ${step.text ? html`<p class="prose">${prose(step.text)}</p>` : nothing}
      ${formulaOf(step, view)}
    </section>`;
}

/** How many substeps there are to see yet, and the result after them. @param {Step} step @param {number} stop @param {Shown} view */
function more(step, stop, { state, session, t }) {
  const count = partsOf(step).length;
  if (!count || stop > count) return nothing;
  const show = () => session.goTo(step.id, within(state.lines, state.place, 1).part);
  return html`<button class="quiet more" @click=${show}>${icon("chevron")}${t("lecture.substeps", { shown: stop, count })}</button>`;
}

/** @param {Shown} view @param {Lecturing} lecture */
function bar(view, { go, present, leave, spot, spotted, asking }) {
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
      ${tool("help", t("lecture.ask"), asking.toggle, asking.on)}
      ${tool("spot", t("lecture.spot"), spot, spotted)}
      ${tool("overview", t("tool.overview"), () => session.overlay("overview"))}
      ${tool("black", t("lecture.black"), () => session.overlay("black"))}
      ${tool("presenter", t("lecture.presenter"), present)}
      ${tool("fullscreen", t("tool.fullscreen"), view.fullscreen)}
      ${tool("close", t("lecture.leave"), leave)}
    </footer>`;
}
