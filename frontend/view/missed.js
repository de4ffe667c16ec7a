/** What was wanted and could not be fetched, each with another try. */

import { html } from "lit-html";

/** @typedef {{says: string, later: import("../model/later.js").Retried, wanted: boolean}} Missable  says: the key of its sentence; wanted: what it would show is asked for now */

/** @param {Missable[]} tools @returns {Missable[]} */
export const missedOf = (tools) => tools.filter(({ later, wanted }) => wanted && later.failed);

/** @param {Missable[]} tools @param {import("../model/catalog.js").Translate} t */
export const missed = (tools, t) => html`
  <div class="missed">${missedOf(tools).map(
    ({ says, later }) => html`
    <p role="alert"><span>${t(says)}</span> <button class="quiet" @click=${() => void later.again()}>${t("retry")}</button></p>`,
  )}</div>`;
