/** The cheapest method for the error that is wanted, while the wish is dragged. */

import { html } from "lit-html";
import { live } from "lit-html/directives/live.js";
import { cheapestFor } from "../../model/labs/figure.js";
import { resultOf } from "../../model/labs/results.js";
import { significant } from "../../model/numbers.js";

/** @param {import("./page.js").View} view */
export function tolerance({ bench, dial, turn, t, methodTitle, state }) {
  const { lang } = state.place;
  const best = cheapestFor(resultOf(bench.result, "work-precision")?.cheapest ?? [], dial.tolerance);
  const write = (/** @type {number} */ value) => significant(value, 2, lang);
  const told = best
    ? t("labs.work-precision.cheapest", {
        tolerance: write(dial.tolerance),
        method: methodTitle(best.method),
        milliseconds: write(1e3 * best.time),
        setting: settingOf(best, t, write),
      })
    : t("labs.work-precision.none");
  return html`
    <div class="dial">
      <label for="tolerance">${t("labs.wanted")}</label>
      <input id="tolerance" type="range" min="1" max="13" step="0.25" .value=${live(String(-Math.log10(dial.tolerance)))} aria-valuetext=${write(dial.tolerance)}
        @input=${(/** @type {Event} */ e) => turn({ tolerance: 10 ** -Number(/** @type {HTMLInputElement} */ (e.target).value) })}>
      <output for="tolerance" aria-live="polite">${told}</output>
    </div>`;
}

/** @param {import("../../model/types.js").Contract["CheapestRun"]} best @param {import("./page.js").View["t"]} t @param {(value: number) => string} write */
const settingOf = (best, t, write) =>
  typeof best.step === "number"
    ? t("labs.hover.step", { value: write(best.step) })
    : t("labs.hover.tolerance", { value: write(best.tolerance ?? 0) });
