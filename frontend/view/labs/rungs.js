/** The rungs of the ladder as a table, each to be opened as a scene, the least one that will do, and those that only seem to. */

import { html, nothing } from "lit-html";
import { inLanguage } from "../../model/catalog.js";
import { significant } from "../../model/numbers.js";
import { resultOf } from "../../model/labs/results.js";
import { titleOf } from "../../model/labs/ladder.js";

/** @typedef {import("../../model/types.js").Contract["LadderRung"]} Rung */
/** @typedef {import("../../model/types.js").Contract["FidelityAnswer"]} Fidelity */

/** @param {import("./page.js").View} view */
export function rungs(view) {
  const { bench, t, state } = view;
  const result = resultOf(bench.result, "fidelity");
  if (!result) return nothing;
  const { lang } = state.place;
  const title = (/** @type {Rung} */ rung) => titleOf(rung, t, result.names, lang);
  const fragile = result.measured
    .filter(({ survives }) => survives === false)
    .flatMap(({ rung, nudged }) => {
      const error =
        nudged === undefined || nudged === null
          ? t("labs.fidelity.fragile-ended")
          : `${significant(100 * nudged, 2, lang)} %`;
      return result.rungs.filter(({ id }) => id === rung).map((one) => `${title(one)} (${error})`);
    });
  const least = result.rungs.find(({ id }) => id === result.least);
  return html`
    ${least ? html`<p class="verdict">${t("labs.fidelity.least", { tolerance: significant(100 * result.tolerance, 2, lang), title: title(least) })}</p>` : nothing}
    ${until(view, result)}
    ${fragile.length ? html`<p class="purpose fragile">${t("labs.fidelity.fragile", { titles: fragile.join("; ") })}</p>` : nothing}
    <table class="numbers failures">
      <caption>${t("labs.fidelity.table")}</caption>
      <thead><tr><th scope="col">${t("labs.fidelity.rung")}</th>${["degrees", "operations", "time", "error"].map((key) => html`<th scope="col">${t(`labs.fidelity.${key}`)}</th>`)}<td></td></tr></thead>
      <tbody>${result.rungs.map((rung) => line(view, result, rung))}</tbody>
    </table>
    ${result.rungs.flatMap(({ refused }) => refused).map((reason) => html`<p class="purpose">${t("ladder.refused", { reason: why(view, result, reason) })}</p>`)}
    ${multipliers(view, result)}`;
}

/** Why there is no such rung. @param {import("./page.js").View} view @param {Fidelity} result @param {Rung["refused"][number]} reason */
function why({ t, state }, result, { code, parameters }) {
  const { lang } = state.place;
  const called = (/** @type {unknown} */ names) =>
    String(names)
      .split(", ")
      .map((name) => inLanguage(result.names[name] ?? name, lang))
      .join(", ");
  return t(
    `errors.${code}`,
    Object.fromEntries(Object.entries(parameters).map(([key, value]) => [key, called(value)])),
  );
}

/** How much alike both formulations move, and what a step costs in each. @param {import("./page.js").View} view @param {Fidelity} result */
function multipliers({ t, state, methodTitle }, result) {
  const found = result.multipliers;
  if (!found) return nothing;
  const { lang } = state.place;
  const most = (/** @type {readonly number[][]} */ columns) => significant(Math.max(...columns.flat()), 2, lang);
  const [apart, estimate, gap] = [found.apart, found.estimate, found.gap].map((column) => most([column]));
  const [error, bound] = [found.errors, found.estimates].map((columns) => most(Object.values(columns)));
  const micro = (/** @type {number} */ seconds) => `${significant(1e6 * seconds, 3, lang)} µs`;
  return html`
    <p class="verdict">${t("labs.fidelity.multipliers.verdict", { apart, estimate, gap, error, bound })}</p>
    <table class="numbers failures">
      <caption>${t("labs.fidelity.multipliers.table")}</caption>
      <thead><tr>${["method", "with", "without", "ratio"].map((key) => html`<th scope="col">${t(`labs.fidelity.multipliers.${key}`)}</th>`)}</tr></thead>
      <tbody>${found.steps.map(({ method, kept, minimal }) => html`<tr><th scope="row">${methodTitle(method)}</th><td>${micro(kept)}</td><td>${micro(minimal)}</td><td>${significant(kept / minimal, 2, lang)}</td></tr>`)}</tbody>
    </table>`;
}

/** How a run ended, also in a way that there are no words for yet. @param {string} status @param {import("./page.js").View["t"]} t */
function outcome(status, t) {
  const words = t(`labs.status.${status}`);
  return words === `labs.status.${status}` ? t("status.incomplete") : words;
}

/** That there is no verdict, or how far it goes, and why no further. @param {import("./page.js").View} view @param {Fidelity} result */
function until({ t, state }, result) {
  if (!result.ending) return nothing;
  const why = t(`labs.fidelity.ending.${result.ending}`);
  if (!result.least) return html`<p class="verdict">${t("labs.fidelity.none")}</p><p class="purpose">${why}</p>`;
  return html`<p class="purpose">${t("labs.fidelity.until", { time: significant(result.until, 3, state.place.lang) })} ${why}</p>`;
}

/** @param {import("./page.js").View} view @param {Fidelity} result @param {Rung} rung */
function line({ t, state, open }, result, rung) {
  const { lang } = state.place;
  const { scene } = rung;
  /** @type {Partial<Fidelity["measured"][number]>} */
  const one = result.measured.find((each) => each.rung === rung.id) ?? {};
  const failed = rung.refused.length
    ? t("labs.fidelity.refused")
    : one.status && one.status !== "ok"
      ? outcome(one.status, t)
      : "";
  return html`<tr class=${rung.id === result.least ? "least" : ""}>
    <th scope="row">${titleOf(rung, t, result.names, lang)}</th><td>${rung.degrees}</td><td>${one.operations?.total ?? ""}</td>
    <td>${one.time ? `${significant(1e3 * one.time[0], 3, lang)} ms` : ""}</td>
    <td>${one.error === undefined || one.error === null ? failed : `${significant(100 * one.error, 2, lang)} %`}${one.survives === false ? html`<br><small>${t("labs.fidelity.fragile-mark")}</small>` : nothing}</td>
    <td>${scene ? html`<button class="quiet small" @click=${() => open(scene)}>${t("labs.fidelity.open")}</button>` : nothing}</td>
  </tr>`;
}
