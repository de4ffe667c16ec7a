/** The buttons above the drawing. */

import { html } from "lit-html";

/** @param {import("../page.js").View} view */
export function tools({ state, session, clock, t }) {
  const { vary } = state.place;
  const toggle = () => {
    if (!vary) clock.play(false);
    session.move({ vary: vary ? "" : "on", panel: vary ? state.place.panel : "values" });
  };
  return html`<button class="quiet small" aria-pressed=${String(Boolean(vary))} title=${t("virtual.open")} @click=${toggle}>
    <span class="math"><i>δ</i><b>r</b></span>&nbsp;${t("virtual")}</button>`;
}
