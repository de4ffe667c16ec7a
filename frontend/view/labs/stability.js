/** The step h on a slider, the step of failure of each method predicted and measured, and the failure to be played. */

import { html, nothing } from "lit-html";
import { live } from "lit-html/directives/live.js";
import { inline } from "../formula.js";
import { significant } from "../../model/numbers.js";
import { stepRange } from "../../model/labs/step.js";

/** @typedef {import("./page.js").View} View */

/** @param {View} view */
export function failures(view) {
  const { bench, t } = view;
  const rows = bench.result?.methods ?? [];
  return html`
    <table class="numbers failures">
      <caption>${t("labs.stability.table")}</caption>
      <thead><tr><th scope="col">${t("labs.stability.method")}</th><th scope="col">${t("labs.stability.bound")}</th><th scope="col">${t("labs.stability.predicted")}</th>
        <th scope="col">${t("labs.stability.measured")}</th><th scope="col">${t("labs.stability.deviation")}</th><td></td></tr></thead>
      <tbody>${rows.map((/** @type {any} */ row) => line(view, row))}</tbody>
    </table>
    <p class="note">${t("labs.stability.note")}</p>`;
}

/** @param {View} view */
export function slider({ bench, dial, turn, t, state }) {
  const [low, high] = stepRange(bench.result?.eigenvalues ?? []);
  const now = Math.min(Math.max(dial.step || low * 10, low), high);
  const place = Math.log(now / low) / Math.log(high / low);
  return html`
    <div class="dial">
      <label for="step">${inline("h")} = <output>${significant(now, 3, state.place.lang)} s</output></label>
      <input id="step" type="range" min="0" max="1" step="0.005" .value=${live(String(place))} aria-valuetext=${`${significant(now, 3, state.place.lang)} s`}
        aria-label=${t("labs.stability.step")} @input=${(/** @type {Event} */ e) => turn({ step: low * (high / low) ** Number(/** @type {HTMLInputElement} */ (e.target).value) })}>
    </div>`;
}

/** @param {View} view @param {any} row */
function line({ methodTitle, t, state, watch, bench }, row) {
  const { lang } = state.place;
  const seconds = (/** @type {number | null} */ value, /** @type {string} */ never) => (value === null ? t(never) : value === 0 ? t("labs.stability.always") : `${significant(value, 3, lang)} s`);
  const play = () => watch({ method: row.method, step: 1.05 * row.measured, t_end: Math.min(200 * row.measured, bench.result?.t_end ?? 10) });
  return html`<tr>
    <th scope="row">${methodTitle(row.method)}</th>
    <td>${seconds(row.bound, "labs.stability.never")}</td><td>${seconds(row.predicted, "labs.stability.never")}</td><td>${seconds(row.measured, "labs.stability.never")}</td>
    <td>${row.deviation === null ? "" : `${significant(100 * row.deviation, 2, lang)} %`}</td>
    <td>${row.measured ? html`<button class="quiet small" @click=${play}>${t("labs.stability.play")}</button>` : nothing}</td>
  </tr>`;
}
