/** A request that came to nothing: said in a line beside what was typed, which is still there. */

import { html, nothing } from "lit-html";

/** @param {import("./page.js").HomeworkView} view */
export function failureLine({ state, t }) {
  const { trouble, kept } = state;
  if (!trouble) return kept ? nothing : html`<p class="wrong" role="alert">${t("homework.not-kept")}</p>`;
  const said =
    trouble.status === 0 ? t("homework.unreachable") : trouble.problems[0]?.message || trouble.detail || trouble.title;
  return html`<p class="wrong" role="alert">${said}${trouble.status === 0 || trouble.status >= 500 ? html` <span class="so">${t("homework.safe")}</span>` : nothing}</p>`;
}
