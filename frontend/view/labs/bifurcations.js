/** The bifurcations that were found as a table, each to be opened as a motion of its scene. */

import { html, nothing } from "lit-html";
import { inUnicode } from "../../model/labs/symbols.js";
import { resultOf } from "../../model/labs/results.js";
import { significant } from "../../model/numbers.js";

/** @typedef {import("./page.js").View} View */
/** @typedef {import("../../model/types.js").Contract["FoundBifurcation"]} Bifurcation */

const COLUMNS = ["kind", "value", "error", "multiplier", "count"];

/** @param {View} view */
export function bifurcations(view) {
  const { bench, t } = view;
  const result = resultOf(bench.result, "bifurcation");
  if (!result) return nothing;
  const known = (bench.scene?.parameters ?? []).find(({ name }) => name === result.parameter);
  const symbol = inUnicode(known?.latex || result.parameter);
  const title = (/** @type {string} */ key) => (key === "value" ? `${symbol}` : t(`labs.bifurcation.${key}`));
  return html`
    <p class="purpose">${t("labs.bifurcation.click")}</p>
    ${
      result.bifurcations.length
        ? html`<details open><summary>${t("labs.bifurcation.table")} (${result.bifurcations.length})</summary>
    <table class="numbers failures">
      <thead><tr>${COLUMNS.map((key) => html`<th scope="col">${title(key)}</th>`)}<td></td></tr></thead>
      <tbody>${result.bifurcations.map((one) => line(view, result.parameter, one))}</tbody>
    </table></details>`
        : nothing
    }`;
}

/** @param {View} view @param {string} parameter @param {Bifurcation} found */
function line({ t, state, sceneFrom }, parameter, { kind, value, error, multipliers, folds, initial }) {
  const { lang } = state.place;
  const [[re, im]] = multipliers;
  const turning = Math.abs(im) > 1e-6 ? ` ± ${significant(Math.abs(im), 6, lang)} i` : "";
  return html`<tr>
    <th scope="row">${t(`labs.bifurcation.${kind}`)}</th>
    <td>${significant(value, 9, lang)}</td><td>${significant(error, 1, lang)}</td>
    <td>${significant(re, 6, lang)}${turning}</td><td>${folds}</td>
    <td><a href=${sceneFrom(initial, { [parameter]: value })}>${t("labs.bifurcation.open")}</a></td>
  </tr>`;
}
