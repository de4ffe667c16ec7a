/** Play, scrub, speed. */

import { html } from "lit-html";
import { icon } from "./icons.js";

/** @typedef {import("./page.js").View} View */

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4];

/** @param {View} view */
export function player(view) {
  const { state, clock, t } = view;
  const label = clock.playing ? t("player.pause") : t("player.play");
  const valueOf = (/** @type {Event} */ e) => Number(/** @type {HTMLInputElement} */ (e.target).value);
  return html`
    <div class="player" role="group" aria-label=${t("player")}>
      <button class="round" title=${label} aria-label=${label} ?disabled=${!state.trajectory} @click=${view.togglePlay}>
        ${icon(clock.playing ? "pause" : "play")}</button>
      <input class="scrub" type="range" min="0" max=${clock.end || 1} step="any" aria-label=${t("player.time")}
        ?disabled=${!state.trajectory} @input=${(/** @type {Event} */ e) => view.scrub(valueOf(e))}>
      <output class="time" aria-live="off"></output>
      <label class="choice speed" title=${t("player.speed")}><span class="unseen">${t("player.speed")}</span>
        <select @change=${(/** @type {Event} */ e) => clock.setSpeed(valueOf(e))}>
          ${SPEEDS.map((s) => html`<option value=${s} ?selected=${s === clock.speed}>${s.toLocaleString(state.place.lang)}×</option>`)}
        </select>${icon("chevron")}</label>
    </div>
  `;
}
