/** The scene beside the task: its drawing in motion, the motion of the answer above it, and what is given. */

import { html, nothing } from "lit-html";
import { inLanguage } from "../../model/catalog.js";
import { parting } from "../../model/homework/motions.js";
import { caveatsOf } from "../../model/trajectory.js";
import { fixed, significant, unitText } from "../../model/numbers.js";
import { inline } from "../formula.js";
import { player } from "../player.js";

/** @typedef {import("./page.js").HomeworkView} HomeworkView */

/** @param {HomeworkView} view */
export function figure(view) {
  const { state, t, clock, togglePlay, scrub } = view;
  const { entry, answered, right } = state;
  const { place } = state.asked;
  const title = inLanguage(entry?.scene.title, place.lang);
  const summary = inLanguage(entry?.scene.summary, place.lang);
  return html`<section class="beside" aria-label=${t("drawing")}>
    <div class="stage">
      <div class="drawing right"><svg role="img" aria-label=${t("drawing.description", { title, summary })}></svg><div class="labels" aria-hidden="true"></div></div>
      <div class="drawing yours" ?hidden=${!answered}><svg aria-hidden="true"></svg><div class="labels" hidden></div></div>
      ${state.still ? html`<div class="patience" role="status">${t("failure.simulation")}<button type="button" class="quiet framed small" @click=${() => view.exercise.again()}>${t("retry")}</button></div>` : nothing}
      ${answered ? legend(view) : nothing}
    </div>
    ${player({ state: { trajectory: right, place }, clock, t, togglePlay, scrub, setSpeed: clock.setSpeed })}
    ${entry ? given(view) : nothing}
  </section>`;
}

/** @param {HomeworkView} view */
function legend({ state, t, exercise }) {
  const { answered, right, asked } = state;
  if (!answered || !right) return nothing;
  const apart = parting(answered, right);
  const { lang } = asked.place;
  const [caveat] = [...caveatsOf(answered, t), ...caveatsOf(right, t)];
  return html`<div class="motions" role="status">
    <span class="key yours"><i></i>${t("homework.motion-yours")}</span><span class="key right"><i></i>${t("homework.motion-right")}</span>
    <span class="apart">${caveat ?? (apart === null ? t("homework.motion-same") : t("homework.motion-apart", { time: fixed(apart, 2, lang) }))}</span>
    <button type="button" class="quiet framed small" @click=${() => exercise.part()}>${t("homework.motion-close")}</button></div>`;
}

/** The numbers that belong to the scene: what is prescribed, where it starts, and its parameters. @param {HomeworkView} view */
function given({ state, t }) {
  const { entry, guides, asked } = state;
  if (!entry) return nothing;
  const { lang } = asked.place;
  const { coordinates, parameters } = entry.scene;
  const guided = new Set((entry.scene.guides ?? []).map(({ coordinate }) => coordinate));
  const free = coordinates.flatMap(({ name, latex, unit }, index) =>
    guided.has(name) ? [] : [{ latex: latex || name, unit, index }],
  );
  return html`<div class="given"><h2>${t("homework.given")}</h2>
    <p class="about">${inLanguage(entry.scene.summary, lang)}</p>
    <dl>
      <div><dt>${t("homework.coordinates")}</dt><dd>${free.map(({ latex, unit, index }) => html`<span class="item">${inline(latex, `q-${index}`)}${unit ? html` <span class="unit">${unitText(unit)}</span>` : nothing}</span>`)}</dd></div>
      ${guides.length ? html`<div><dt>${t("homework.guides")}</dt><dd>${guides.map((guide) => html`<span class="item">${inline(guide)}</span>`)}</dd></div>` : nothing}
      <div><dt>${t("homework.parameters")}</dt><dd>${parameters.map(({ name, latex, unit, value }) => html`<span class="item">${inline(latex || name)} = ${significant(value, 3, lang)}${unit ? html` <span class="unit">${unitText(unit)}</span>` : nothing}</span>`)}</dd></div>
    </dl>
    <p class="so">${t("homework.symbols-help")}</p></div>`;
}
