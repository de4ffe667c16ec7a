/** The page "Variations": the question to the left, the answer and the h-slider to the right. */

import { html } from "lit-html";
import { appearance, brand, language, places } from "../header.js";
import { form } from "./form.js";
import { contents, derivation, summary, understood } from "./result.js";
import { slider } from "./slider.js";

/**
 * @typedef {import("../header.js").Appearance & {asking: import("../../model/variations/lab.js").Asking,
 *   lab: import("../../model/variations/lab.js").Lab, size: import("../../model/variations/charts.js").Size,
 *   link: (patch: {step: string}) => string, follow: import("../page.js").View["follow"],
 *   session: {go: (by: number) => void, goTo: (step: string) => void}}} VariationsView
 */

/** @param {VariationsView} view */
export function page(view) {
  const { t } = view;
  return html`
    <a class="skip" href="#answer">${t("skip")}</a>
    <header class="top">
      ${brand(view)}
      <div class="scene"><h1>${t("place.variations")}</h1><p class="summary">${t("variations.subtitle")}</p></div>
      ${places(view, "variations")}
      <div class="tools">${language(view)}${appearance(view)}</div>
    </header>
    <main class="variations">
      <div class="asking">${form(view)}${understood(view)}${summary(view)}</div>
      <div class="answer" id="answer" tabindex="-1">
        ${contents(view)}
        ${derivation(view)}
        ${slider(view)}
      </div>
    </main>`;
}
