/** The step h on a slider, the step of failure of each method predicted and measured or why not, and the failure to be played. */

import { html, nothing } from "lit-html";
import { live } from "lit-html/directives/live.js";
import { inline } from "../formula.js";
import { significant } from "../../model/numbers.js";
import { resultOf } from "../../model/labs/results.js";
import { stepRange } from "../../model/labs/step.js";

/** @typedef {import("./page.js").View} View */

/** @param {View} view */
export function failures(view) {
  const { bench, t } = view;
  const rows = resultOf(bench.result, "stability")?.methods ?? [];
  return html`
    <table class="numbers failures">
      <caption>${t("labs.stability.table")}</caption>
      <thead><tr><th scope="col">${t("labs.stability.method")}</th><th scope="col">${t("labs.stability.bound")}</th><th scope="col">${t("labs.stability.predicted")}</th>
        <th scope="col">${t("labs.stability.measured")}</th><th scope="col">${t("labs.stability.deviation")}</th><td></td></tr></thead>
      <tbody>${rows.map((row) => line(view, row))}</tbody>
    </table>
    ${untold(view, rows)}
    <p class="note">${t("labs.stability.note")}</p>`;
}

/** What stands for a step that cannot be told, and why. */
const DASH = "—";
/** @typedef {import("../../model/types.js").Contract["FailingStep"]} Row */

/** Why there is no figure in some places, or another end than growth: each once; a number in the table points here. @param {Row[]} rows */
const reasonsOf = (rows) =>
  [
    ...new Set(
      rows.flatMap(({ basis, reason, cause }) => [
        basis === "flow" ? "linearization-varies" : "",
        reason,
        cause === "newton_failed" ? cause : "",
      ]),
    ),
  ].filter(Boolean);

/** @param {View} view @param {Row[]} rows */
function untold({ bench, t, state }, rows) {
  const reasons = reasonsOf(rows);
  const { at = "", rest = true, varies = 0 } = resultOf(bench.result, "stability") ?? {};
  const percent = significant(100 * varies, 2, state.place.lang);
  return html`
    ${at === "rest" && !rest ? html`<p class="note">${t("labs.stability.no-rest")}</p>` : nothing}
    ${reasons.length ? html`<ol class="note reasons">${reasons.map((reason) => html`<li>${t(`labs.stability.reasons.${reason}`, { percent })}</li>`)}</ol>` : nothing}`;
}

/** @param {View} view */
export function slider({ bench, dial, turn, t, state }) {
  const [low, high] = stepRange(resultOf(bench.result, "stability")?.eigenvalues ?? []);
  const now = Math.min(Math.max(dial.step || low * 10, low), high);
  const place = Math.log(now / low) / Math.log(high / low);
  return html`
    <div class="dial">
      <label for="step">${inline("h")} = <output>${significant(now, 3, state.place.lang)} s</output></label>
      <input id="step" type="range" min="0" max="1" step="0.005" .value=${live(String(place))} aria-valuetext=${`${significant(now, 3, state.place.lang)} s`}
        aria-label=${t("labs.stability.step")} @input=${(/** @type {Event} */ e) => turn({ step: low * (high / low) ** Number(/** @type {HTMLInputElement} */ (e.target).value) })}>
    </div>`;
}

/** @param {View} view @param {Row} row */
function line({ methodTitle, t, state, watch, bench }, row) {
  const { lang } = state.place;
  const seconds = (/** @type {number | null} */ value) =>
    value === null
      ? t("labs.stability.never")
      : value === 0
        ? t("labs.stability.always")
        : `${significant(value, 3, lang)} s`;
  const reasons = reasonsOf(resultOf(bench.result, "stability")?.methods ?? []);
  const mark = (/** @type {string} */ reason) => html`<sup>${reasons.indexOf(reason) + 1}</sup>`;
  const none = (/** @type {string} */ reason, /** @type {number | null} */ limit = null) =>
    html`${limit === null ? DASH : t("labs.stability.from", { step: `${significant(limit, 2, lang)} s` })}${mark(reason)}`;
  const foretold = (/** @type {number | null} */ value) =>
    row.basis === "flow" ? none("linearization-varies") : seconds(value);
  const failing = row.measured ?? 0;
  const play = () =>
    watch({ method: row.method, step: 1.05 * failing, t_end: Math.min(200 * failing, bench.result?.t_end ?? 10) });
  return html`<tr>
    <th scope="row">${methodTitle(row.method)}</th>
    <td>${foretold(row.bound)}</td><td>${foretold(row.predicted)}</td><td>${row.reason ? none(row.reason, row.limit) : row.basis === "flow" && row.measured ? `≈ ${significant(row.measured, 2, lang)} s` : seconds(row.measured)}${row.cause === "newton_failed" ? mark(row.cause) : nothing}</td>
    <td>${row.deviation === null ? "" : `${significant(100 * row.deviation, 2, lang)} %`}</td>
    <td>${row.measured ? html`<button class="quiet small" @click=${play}>${t("labs.stability.play")}</button>` : nothing}</td>
  </tr>`;
}
