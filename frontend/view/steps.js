/** The derivation as a list of steps, all up to the current one. */

import { html, nothing } from "lit-html";
import { repeat } from "lit-html/directives/repeat.js";
import { displayed, fitSeen, prose, typesetWithin } from "./formula.js";
import { icon } from "./icons.js";
import { missingIn } from "../model/derivations.js";
import { indexOf } from "../model/reveal.js";

/** @typedef {import("../model/types.js").Step} Step */
/** @typedef {import("../model/reveal.js").Line} Line */
/** @typedef {{state: Pick<import("./page.js").View["state"], "place" | "lines" | "derivation">,
 *   session: Pick<import("./page.js").View["session"], "go" | "goTo">,
 *   why?: import("./page.js").View["why"], integrals?: import("./page.js").View["integrals"], link: (patch: {step: string}) => string, follow: import("./page.js").View["follow"], t: import("./page.js").View["t"]}} View  what steps need of a page */

/** So many steps before the current one are laid out at once, so that scrolling to it arrives; those before when they are seen. */
const NEAR = 3;

/** A far step or its formula has been scrolled to or left, or details have been opened. @param {Event} event */
function comesIntoView(event) {
  if (/** @type {{skipped?: boolean}} */ (event).skipped) return fitSeen(event.target, true);
  typesetWithin(/** @type {Node} */ (event.currentTarget));
  fitSeen(event.target);
}

/** @param {View} view */
export function steps(view) {
  const { state, t } = view;
  if (!state.derivation)
    return html`<div class="steps waiting" role="status">${skeleton()}<span class="unseen">${t("derivation.loading")}</span></div>`;
  if (!state.lines.length) return html`<p class="notice">${t("empty.steps")}</p>`;
  const current = indexOf(state.lines, state.place.step);
  const shown = state.lines.slice(0, current + 1);
  return html`<ol class="steps">
    ${repeat(
      shown,
      (line) => line.step.id,
      (line) => step(line, line.index === current, view, line.index < current - NEAR),
    )}
  </ol>`;
}

const skeleton = () => [62, 88, 74].map((width) => html`<div class="bone" style="width:${width}%"></div>`);

/** @param {Line} line @param {boolean} current @param {Pick<View, "link" | "follow" | "session" | "t" | "why" | "integrals">} view @param {boolean} [far] from the current one */
export function step(line, current, view, far = false) {
  const opens = line.number.endsWith(".1");
  const { step: content, number } = line;
  return html`
    <li class="step ${opens ? "opens" : ""} ${far ? "far" : ""}" data-step=${content.id} aria-current=${current ? "step" : nothing} @contentvisibilityautostatechange=${comesIntoView}>
      ${opens ? html`<h2 class="chapter"><span class="ordinal">${line.chapterIndex + 1}</span>${line.chapter.title}</h2>` : nothing}
      <h3 class="title">
        <a class="number" href=${view.link({ step: content.id })} title=${view.t("step.link")}
          @click=${(/** @type {Event} */ event) => view.follow(event, () => view.session.goTo(content.id))}>${number}</a>
        <span>${prose(content.title, far)}</span>
        ${verdict(content, view)}${view.why?.button(content)}
      </h3>
      ${view.why?.panel(content)}
      ${content.text ? html`<p class="prose">${prose(content.text, far)}</p>` : nothing}
      ${formulaOf(content, view, far)}
      ${view.integrals?.actions(content)}
      ${content.substeps.length ? substeps(content, view) : nothing}
    </li>
  `;
}

/** The marked form carries the colours; some steps are words only. @param {Step} content @param {Pick<View, "why">} view @param {boolean} later */
function formulaOf(content, { why }, later) {
  const latex = why?.formula(content) ?? (content.marked || content.latex);
  return latex ? displayed(latex, later, content) : nothing;
}

const GROUNDS = { exact: "step.exact-why", sampled: "step.sampled-why", stated: "step.stated-why" };

/** How it is known that a step holds. @param {Step} step @param {Pick<View, "t">} view */
export function grounds({ verified, evidence: { kind, points, digits } }, { t }) {
  return verified ? t(GROUNDS[kind], { points, digits }) : t("step.unverified-why");
}

/** Nothing of a step of words alone that says what is left out. @param {Step} content @param {Pick<View, "t">} view */
function verdict(content, view) {
  if (content.evidence.kind === "stated" && !content.latex) return nothing;
  return content.verified
    ? html`<span class="verdict" title=${grounds(content, view)}>${icon("verified")}<span>${view.t("step.verified")}</span></span>`
    : html`<span class="verdict doubtful" title=${grounds(content, view)}><span>${view.t("step.unverified")}</span></span>`;
}

/** @param {Step} content @param {Pick<View, "t" | "why">} view @returns {import("lit-html").TemplateResult} */
function substeps(content, view) {
  const count = content.substeps.length;
  return html`
    <details class="substeps" @toggle=${comesIntoView}>
      <summary>${icon("chevron")}${view.t("step.substeps", { count })}</summary>
      <ol>
        ${content.substeps.map(
          (part) => html`
          <li>
            <p class="prose">${part.title ? html`<b>${prose(part.title, true)}</b>` : nothing} ${prose(part.text, true)}</p>
            ${formulaOf(part, view, true)}
            ${part.substeps?.length ? substeps(part, view) : nothing}
          </li>`,
        )}
      </ol>
    </details>
  `;
}

/** A browser leaves what has the focus half cut off. @param {Event} event */
const seen = ({ target }) => /** @type {Element} */ (target).scrollIntoView({ block: "nearest", inline: "nearest" });

/** Chapters as navigation. @param {View} view */
export function chapters(view) {
  const { state, t } = view;
  const current = state.lines[indexOf(state.lines, state.place.step)];
  return html`
    <nav class="chapters" aria-label=${t("chapters")} @focusin=${seen}>
      <ol>
        ${(state.derivation?.chapters ?? [])
          .filter((chapter) => chapter.steps.length)
          .map(
            (chapter) => html`
          <li>
            <a href=${view.link({ step: chapter.steps[0].id })} aria-current=${chapter === current?.chapter ? "true" : nothing}
              @click=${(/** @type {Event} */ event) => view.follow(event, () => view.session.goTo(chapter.steps[0].id))}>
              <span class="ordinal">${(state.derivation?.chapters ?? []).indexOf(chapter) + 1}</span>${chapter.title}</a>
          </li>`,
          )}
      </ol>
    </nav>
  `;
}

/** Back, where we are, on; all steps are a task of their own, after what the press itself costs. @param {View} view */
export function pager(view) {
  const { state, session, t } = view;
  const total = state.lines.length;
  const position = indexOf(state.lines, state.place.step) + 1;
  const last = position >= total;
  return html`
    <footer class="pager">
      <button class="quiet" aria-label=${t("step.previous")} ?disabled=${position <= 1} @click=${() => session.go(-1)}>${icon("previous")}<span>${t("step.previous")}</span></button>
      <div class="progress" aria-label=${t("step.progress", { position, total })} role="img">
        <span class="track"><span class="done" style="transform:scaleX(${total ? position / total : 0})"></span></span>
        <span class="count">${total ? `${position} / ${total}` : ""}</span>
      </div>
      <button class="quiet minor" ?disabled=${last} @click=${() => setTimeout(session.go, 0, total)}>${t("step.all")}</button>
      <button class="main" ?disabled=${last} @click=${() => session.go(1)}><span>${t("step.next")}</span>${icon("next")}</button>
    </footer>
  `;
}

/** Whether all steps that there are have been shown. @param {Pick<import("../model/session.js").State, "derivation" | "lines" | "place">} state */
export const isAtEnd = ({ derivation, lines, place }) =>
  Boolean(derivation && lines.length) && lines.at(-1) === lines[indexOf(lines, place.step)];

/** Behind the last step: that the last chapter follows, or why there is none. @param {Pick<import("../model/session.js").State, "derivation" | "lines" | "place">} state */
export function missing(state) {
  const left = isAtEnd(state) && missingIn(state.derivation);
  return left ? html`<p class="notice missing" role="status" data-reason=${left.reason}>${left.text}</p>` : nothing;
}
