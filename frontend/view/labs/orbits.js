/** The orbits of a section as a table, each to be opened as a motion of its scene: what a click on its points does, too. */

import { html, nothing } from "lit-html";
import { inUnicode } from "../../model/labs/symbols.js";
import { resultOf } from "../../model/labs/results.js";
import { significant } from "../../model/numbers.js";

/** @typedef {import("./page.js").View} View */
/** @typedef {import("../../model/types.js").Contract["Orbit"]} Orbit */

/** @param {View} view */
export function orbits(view) {
  const { bench, t } = view;
  const result = resultOf(bench.result, "poincare-section");
  if (!result) return nothing;
  return html`
    <p class="purpose">${t("labs.poincare-section.click")}</p>
    <details><summary>${t("labs.poincare-section.table")} (${result.orbits.length})</summary>
    <table class="numbers failures">
      <thead><tr>${["begin", "count", "verdict", "horizon"].map((key) => html`<th scope="col">${t(`labs.poincare-section.${key}`)}</th>`)}<td></td></tr></thead>
      <tbody>${result.orbits.map((orbit) => line(view, orbit))}</tbody>
    </table></details>`;
}

/** @param {View} view @param {Orbit} orbit */
function line({ bench, t, state, sceneFrom }, orbit) {
  const { lang } = state.place;
  const number = (/** @type {number} */ one) => significant(one, 3, lang);
  const symbols = Object.fromEntries(
    (bench.scene?.coordinates ?? []).map(({ name, latex }) => [name, inUnicode(latex || name)]),
  );
  const begin = Object.entries(orbit.initial).map(
    ([name, { value, rate }]) => `${symbols[name] ?? name}: ${number(value)}; ${number(rate)}`,
  );
  const verdict = orbit.chaotic === null ? "open" : orbit.chaotic ? "chaotic" : "regular";
  return html`<tr>
    <th scope="row">${orbit.own ? html`${t("labs.poincare-section.own")}<br>` : nothing}${begin.map((one) => html`${one}<br>`)}</th>
    <td>${orbit.t.length}</td><td>${t(`labs.poincare-section.verdict-${verdict}`)}</td>
    <td>${orbit.horizon === null ? "–" : `${number(orbit.horizon)} s`}</td>
    <td><a href=${sceneFrom(orbit.initial)}>${t("labs.poincare-section.open")}</a></td>
  </tr>`;
}
