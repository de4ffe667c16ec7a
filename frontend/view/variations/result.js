/** The answer: what was understood, the two routes side by side, then what follows for integrals. */

import { html, nothing } from "lit-html";
import { repeat } from "lit-html/directives/repeat.js";
import { displayed, inline } from "../formula.js";
import { step } from "../steps.js";
import { linesOf } from "../../model/reveal.js";

/** @typedef {import("./page.js").VariationsView} VariationsView */
/** @typedef {import("../../model/reveal.js").Line} Line */

const ROUTES = ["variation-by-definition", "variation-by-chain-rule"];

/** What the server has read, as it is typed. @param {VariationsView} view */
export function understood({ asking, t }) {
  const formula = asking.answer?.chapters[0]?.steps[0];
  return html`
    <section class="understood ${asking.verdict === "refused" ? "stale" : ""}" aria-label=${t("variations.understood")}>
      <h2>${t("variations.understood")}</h2>
      <div class="room">${formula ? displayed(formula.marked || formula.latex, false, formula) : nothing}</div>
    </section>`;
}

/** @param {VariationsView} view */
export function summary({ asking, t }) {
  const result = asking.answer?.result;
  if (!result) return nothing;
  const terms = result.boundary_terms ?? [];
  return html`
    <section class="outcome ${asking.verdict === "refused" ? "stale" : ""}" aria-label=${t("variations.result")}>
      <h2>${t("variations.result")}</h2>
      <dl>
        <div><dt>${t("variations.first-variation")}</dt><dd>${displayed(result.first_variation.latex, false, result.first_variation)}</dd></div>
        ${terms.length ? html`<div><dt>${t("variations.boundary")}</dt>${terms.map((term) => html`<dd>${boundaryTerm(term, t)}</dd>`)}</div>` : nothing}
        ${result.euler_lagrange?.length ? html`<div><dt>${t("variations.euler")}</dt>${result.euler_lagrange.map((one) => html`<dd>${displayed(one.latex, false, one)}</dd>`)}</div>` : nothing}
        ${result.first_integrals?.length ? html`<div><dt>${t("variations.first-integrals")}</dt>${result.first_integrals.map((one) => html`<dd>${displayed(one.latex, false, one)}</dd>`)}</div>` : nothing}
      </dl>
    </section>`;
}

/** @param {import("../../model/types.js").Contract["BoundaryTerm"]} term @param {import("../../model/catalog.js").Translate} t */
function boundaryTerm(term, t) {
  return term.condition
    ? html`${inline(term.latex)} <span class="so">${t("variations.natural", { at: term.at.join(", ") })}</span> ${inline(term.condition.latex)}`
    : html`${inline(`${term.latex} = 0`)} <span class="so">${t("variations.vanishes")}</span>`;
}

/** The chapters and the h-slider as a line of links. @param {VariationsView} view */
export function contents({ asking, t, link, follow, session }) {
  const chapters = asking.answer?.chapters ?? [];
  const to = (/** @type {string} */ id) => (/** @type {Event} */ event) => follow(event, () => session.goTo(id));
  return html`
    <nav class="chapters" aria-label=${t("chapters")}><ol>
      ${chapters.map(({ title, steps }, i) => html`<li><a href=${link({ step: steps[0].id })} @click=${to(steps[0].id)}><span class="ordinal">${i + 1}</span>${title}</a></li>`)}
      ${chapters.length ? html`<li><a href=${link({ step: "slide" })} @click=${to("slide")}>${t("variations.slide")}</a></li>` : nothing}
    </ol></nav>`;
}

/** @param {VariationsView} view */
export function derivation(view) {
  const lines = linesOf(view.asking.answer?.chapters ?? []);
  if (!lines.length && view.asking.verdict !== "waiting") return nothing;
  if (!lines.length)
    return html`<div class="steps waiting" role="status"><div class="bone"></div><div class="bone"></div></div>`;
  const [first, left, right, rest] = [
    [lines[0]],
    ...ROUTES.map((id) => lines.filter((line) => line.chapter.id === id)),
    lines.filter((line) => line !== lines[0] && !ROUTES.includes(line.chapter.id)),
  ];
  return html`
    <div class="${view.asking.verdict === "refused" ? "stale" : ""}">
      ${list(first, view)}
      <div class="routes">${list(left, view)}${list(right, view)}</div>
      ${list(rest, view)}
    </div>`;
}

/** @param {Line[]} lines @param {VariationsView} view */
const list = (lines, view) =>
  html`<ol class="steps">${repeat(
    lines,
    (line) => line.step.id,
    (line) => step(line, line.step.id === view.state.place.step, view),
  )}</ol>`;
