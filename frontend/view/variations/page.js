/** The page "Variations": the question to the left, the answer and the h-slider to the right. */

import { html } from "lit-html";
import { form } from "./form.js";
import { contents, derivation, summary, understood } from "./result.js";
import { slider } from "./slider.js";
import { titled, top } from "../top.js";

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
    ${top(view, { main: "answer", here: "variations", heading: titled(t("place.variations"), t("variations.subtitle")) })}
    <main class="variations">
      <div class="asking">${form(view)}${understood(view)}${summary(view)}</div>
      <div class="answer" id="answer" tabindex="-1">
        ${contents(view)}
        ${derivation(view)}
        ${slider(view)}
      </div>
    </main>`;
}
