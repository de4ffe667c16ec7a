/** The page "Variations": the question to the left, the answer and the h-slider to the right. */

import { html } from "lit-html";
import { form } from "./form.js";
import { contents, derivation, summary, understood } from "./result.js";
import { slider } from "./slider.js";
import { addEntry, addTool, titleOfPlace } from "../lectures/adding.js";
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
  const title = () => titleOfPlace(t("place.variations"), view.asking.question.expression);
  return html`
    ${top(view, { main: "answer", here: "variations", heading: titled(t("place.variations"), t("variations.subtitle")), menu: addEntry(title, t), tools: addTool(title, t) })}
    <main class="variations">
      <div class="asking">${form(view)}${understood(view)}${summary(view)}</div>
      <div class="answer" id="answer" tabindex="-1">
        ${contents(view)}
        ${derivation(view)}
        ${slider(view)}
      </div>
    </main>`;
}
