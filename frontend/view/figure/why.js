/** Why a step is allowed, and what it changes: its law with the source, what it comes from, and its terms compared with those before. */

import { html, nothing } from "lit-html";
import { prose } from "../formula.js";
import { grounds } from "../steps.js";
import { called } from "../../model/catalog.js";
import { CHANGES, originsOf } from "../../model/figure/origins.js";

/** @typedef {import("../page.js").View} View */
/** @typedef {import("../../model/types.js").Step} Step */
/** @typedef {import("../../model/figure/origins.js").Origins} Origins */

/** @param {() => import("../../model/state.js").State} state */
export function createWhy(state) {
  /** @type {WeakMap<Step, Origins>} */
  const found = new WeakMap();
  /** @type {WeakMap<Step, string>} */
  const formulas = new WeakMap();

  /** A step is compared when it becomes the current one. @param {Step} step */
  function compare(step) {
    const { lines, place } = state();
    const index = lines.findIndex((line) => line.step === step);
    if (index < 0 || found.has(step) || step.id !== (place.step || lines[0]?.step.id)) return;
    const origins = originsOf(lines, index);
    found.set(step, origins);
    origins.formulas.forEach((latex, part) => formulas.set(part, latex));
  }

  /** @param {Omit<View, "why">} view */
  return (view) => ({
    /** The formula of a step with its terms marked, once it has been compared. @param {Step} step */
    formula(step) {
      compare(step);
      return formulas.get(step);
    },
    /** @param {Step} step */
    button(step) {
      const { state, session, t } = view;
      if (!state.catalog.figure) return nothing;
      const shown = state.place.why === step.id;
      return html`<button class="why quiet small" aria-expanded=${String(shown)} @click=${() => session.move({ why: shown ? "" : step.id })}>${t("why")}</button>`;
    },
    /** What the marks on its terms mean, for those who do not ask. @param {Step} step */
    legend(step) {
      return changes(found.get(step), view.state.lines.find((line) => line.step === step)?.number, view);
    },
    /** @param {Step} step */
    panel(step) {
      if (view.state.place.why !== step.id) return nothing;
      view.session.need("laws");
      const laws = /** @type {Record<string, {law: string, source: string}>} */ (view.state.catalog.laws ?? {});
      const { law, source } = laws[step.rule] ?? { law: "", source: "" };
      return html`
        <div class="law" role="note">
          <p>${prose(law)}</p>
          <p class="source">${source}</p>
          <p class="evidence">${grounds(step, view)}</p>
          ${premises(step, view)}
          ${step.sources.length ? html`<p class="sources">${view.t("why.sources")} ${step.sources.map((name) => chip(name, view))}</p>` : nothing}
          ${changes(found.get(step), view.state.lines.find((line) => line.step === step)?.number, view)}
        </div>`;
    },
  });
}

/** A body or load by name; pointed at or focused, it lights up everywhere. @param {string} name "load:weight" @param {Omit<View, "why">} view */
function chip(name, { state, t }) {
  const [kind, id] = name.split(":");
  return html`<button class="source-chip quiet small ${kind}-${id}">${called(state.scene?.labels, id, state.place.lang, t)}</button>`;
}

/** The steps that a step rests on, each once. @param {Step} step @param {Omit<View, "why">} view */
function premises(step, view) {
  const lines = new Set(step.premises.map((id) => lineOf(id, view)));
  const own = [...lines].some((line) => line?.step === step);
  const others = [...lines]
    .filter((line) => line && line.step !== step)
    .map((line) => toStep(line?.step.id ?? "", view));
  if (!own && !others.length) return nothing;
  return html`<p class="premises">${view.t("why.premises")} ${own ? html`${view.t("why.within")} ` : nothing}${others}</p>`;
}

/** The line of a step, also of an intermediate one. @param {string} id @param {Omit<View, "why">} view */
function lineOf(id, { state }) {
  const holds = (/** @type {Step} */ step) => step.id === id || step.substeps.some(holds);
  return state.lines.find((line) => holds(line.step));
}

/** A step that has been made before, by its number. @param {string} id @param {Omit<View, "why">} view */
function toStep(id, view) {
  const line = lineOf(id, view);
  if (!line) return nothing;
  const go = (/** @type {Event} */ event) => view.follow(event, () => view.session.goTo(line.step.id));
  return html`<a href=${view.link({ step: line.step.id })} title=${line.step.title} @click=${go}>${line.number}</a> `;
}

/** What the marks on the terms mean, and from which steps they come. @param {Origins | undefined} origins @param {string | undefined} own number of the step @param {Omit<View, "why">} view */
function changes(origins, own, view) {
  const shown = CHANGES.filter((change) => origins?.from.has(change));
  if (!shown.length) return nothing;
  const step = (/** @type {string} */ number) =>
    number === own
      ? html`(${view.t("why.within")}) `
      : toStep(view.state.lines.find((line) => line.number === number)?.step.id ?? "", view);
  return html`<ul class="changes">${shown.map(
    (change) => html`
    <li><span class="term-${change}">${view.t(`why.${change}`)}</span> ${change === "gone" ? nothing : origins?.from.get(change)?.map(step)}</li>`,
  )}</ul>`;
}
