/** The handout on a sheet of paper: title, picture, values, and every step. */

import { html, nothing } from "lit-html";
import { failure } from "../failure.js";
import { displayed, inline, prose } from "../formula.js";
import { appearance, brand, language, places } from "../header.js";
import { icon } from "../icons.js";
import { history } from "./history.js";
import { SECONDS } from "../../model/handout.js";
import { inLanguage } from "../../model/catalog.js";
import { indeterminateIn } from "../../model/indeterminate.js";
import { partsOf } from "../../model/lecture/stops.js";
import { brief, perSecond, unitText } from "../../model/numbers.js";
import { caveatsOf } from "../../model/trajectory.js";
import { dotted, readChanges } from "../../model/values.js";

/** @typedef {import("../../model/types.js").Step} Step */
/**
 * @typedef {import("../../model/handout.js").Sheet & import("../header.js").Appearance & {print: () => void, address: string,
 *   session: ReturnType<typeof import("../../model/handout.js").createHandout>}} HandoutView
 */

/** @param {HandoutView} view */
export function page(view) {
  const { session, substeps, t } = view;
  return html`
    <a class="skip" href="#sheet">${t("skip")}</a>
    <header class="top">
      ${brand(view)}${places(view, "")}
      <div class="tools">
        <label class="check"><input type="checkbox" .checked=${substeps} @change=${session.toggleSubsteps}>${t("handout.substeps")}</label>
        <button class="main" @click=${view.print}>${icon("print")}${t("handout.print")}</button>
        ${language(view)}${appearance(view)}
      </div>
    </header>
    <main class="handout" id="sheet" tabindex="-1">
      ${view.failure ? failure(view.failure, t("failure.derivation"), () => void session.load(), t) : sheet(view)}
    </main>`;
}

/** @param {HandoutView} view */
function sheet(view) {
  const { lines, t } = view;
  if (!lines.length) return html`<p class="notice" role="status">${t("derivation.loading")}</p>`;
  return html`
    <article class="paper">
      ${opening(view)}
      ${lines.map((line) => step(line, view))}
      <footer>${t("handout.source")} <a href=${view.address}>${view.address.length < 160 ? view.address : location.origin}</a></footer>
    </article>`;
}

/** What it is about: a scene with its picture and values, or what is proven. @param {HandoutView} view */
function opening(view) {
  const { scene, trajectory, state, t } = view;
  if (!scene) return html`<h1>${t("place.proof")}</h1><p class="summary">${t("proof.subtitle")}</p>`;
  const { lang } = state.place;
  const title = inLanguage(scene.title, lang);
  return html`
    <h1>${title}</h1>
    <p class="summary">${inLanguage(scene.summary, lang)}</p>
    <div class="given">
      <div class="drawing"><svg role="img" aria-label=${t("drawing.still", { title })}></svg><div class="labels" aria-hidden="true"></div></div>
      ${values(view)}
    </div>
    ${trajectory ? caveatsOf(trajectory, t).map((sentence) => html`<p class="caveat">${sentence}</p>`) : nothing}
    ${trajectory ? indeterminateIn(trajectory, scene, t, lang).map((sentence) => html`<p class="caveat">${prose(sentence)}</p>`) : nothing}
    ${trajectory?.t.length ? history({ scene, trajectory, lang, title: t("handout.motion", { seconds: SECONDS }), label: t("handout.curves") }) : nothing}`;
}

/** @param {HandoutView} view */
function values({ scene, state, t }) {
  if (!scene) return nothing;
  const { parameters, initial } = readChanges(state.place.set);
  const guided = new Set((scene.guides ?? []).map((guide) => guide.coordinate));
  const rows = [
    ...scene.parameters.map(({ name, latex, value, unit }) => ({
      latex: latex || name,
      value: parameters[name] ?? value,
      unit,
    })),
    ...scene.coordinates
      .filter(({ name }) => !guided.has(name))
      .flatMap(({ name, latex, value, rate, unit }) => [
        { latex: `${latex || name}(0)`, value: initial[name]?.value ?? value, unit },
        { latex: `${dotted(latex || name)}(0)`, value: initial[name]?.rate ?? rate, unit: perSecond(unit) },
      ]),
  ];
  return html`
    <table><caption>${t("handout.values")}</caption>
      <tbody>${rows.map(({ latex, value, unit }) => html`<tr><th scope="row">${inline(latex)}</th><td>${brief(value, 8, state.place.lang)} ${unitText(unit)}</td></tr>`)}</tbody></table>`;
}

/** @param {import("../../model/reveal.js").Line} line @param {HandoutView} view */
function step({ step, number, chapter, chapterIndex }, { substeps }) {
  const parts = substeps ? partsOf(step) : [];
  return html`
    ${number.endsWith(".1") ? html`<h2><span class="ordinal">${chapterIndex + 1}</span>${chapter.title}</h2>` : nothing}
    <section class="step" data-step=${step.id}>
      <h3><span class="number">${number}</span>${prose(step.title)}</h3>
      ${words(step)}
      ${parts.map(
        ({ step: part, depth }, i) => html`
        <section class="part" style="--depth:${depth}">
          ${part.title ? html`<h4><span class="number">${number}.${i + 1}</span>${prose(part.title)}</h4>` : nothing}${words(part)}</section>`,
      )}
    </section>`;
}

/** @param {Step} step */
const words = ({ text, marked, latex, spoken, spoken_terms }) => html`
  ${text ? html`<p>${prose(text)}</p>` : nothing}
  ${marked || latex ? displayed(marked || latex, false, { spoken, spoken_terms }) : nothing}`;
