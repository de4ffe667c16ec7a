/** The cheapest method for the error that is wanted, while the wish is dragged. */

import { html } from "lit-html";
import { live } from "lit-html/directives/live.js";
import { cheapestFor } from "../../model/labs/figure.js";
import { significant } from "../../model/numbers.js";

/** @param {import("./page.js").View} view */
export function tolerance({ bench, dial, turn, say, methodTitle, state }) {
  const { lang } = state.place;
  const best = cheapestFor(bench.result?.cheapest ?? [], dial.tolerance);
  const write = (/** @type {number} */ value) => significant(value, 2, lang);
  const told = best
    ? say("work-precision.cheapest", { tolerance: write(dial.tolerance), method: methodTitle(best.method), milliseconds: write(1e3 * best.time), setting: settingOf(best, say, write) })
    : say("work-precision.none");
  return html`
    <div class="dial">
      <label for="tolerance">${say("wanted")}</label>
      <input id="tolerance" type="range" min="1" max="13" step="0.25" .value=${live(String(-Math.log10(dial.tolerance)))} aria-valuetext=${write(dial.tolerance)}
        @input=${(/** @type {Event} */ e) => turn({ tolerance: 10 ** -Number(/** @type {HTMLInputElement} */ (e.target).value) })}>
      <output for="tolerance" aria-live="polite">${told}</output>
    </div>`;
}

/** @param {any} best @param {import("./page.js").View["say"]} say @param {(value: number) => string} write */
const settingOf = (best, say, write) => ("step" in best ? say("hover.step", { value: write(best.step) }) : say("hover.tolerance", { value: write(best.tolerance) }));
