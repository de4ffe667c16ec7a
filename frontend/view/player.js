/** Play, scrub, speed. */

import { html } from "lit-html";
import { icon } from "./icons.js";
import { atMost, digitsIn } from "./digits.js";
import { fixed } from "../model/numbers.js";
import { SPEEDS } from "../model/url.js";

/** @typedef {import("./page.js").View} View */

/** @param {{state: Pick<View["state"], "trajectory" | "place">} & Pick<View, "clock" | "t" | "togglePlay" | "scrub" | "setSpeed"> & Partial<Pick<View, "instruments">>} view */
export function player(view) {
  const { state, clock, t } = view;
  const label = clock.playing ? t("player.pause") : t("player.play");
  const valueOf = (/** @type {Event} */ e) => Number(/** @type {HTMLInputElement} */ (e.target).value);
  return html`
    <div class="player" role="group" aria-label=${t("player")}>
      <button class="round" title=${label} aria-label=${label} ?disabled=${!state.trajectory} @click=${view.togglePlay}>
        ${icon(clock.playing ? "pause" : "play")}</button>
      <span class="steppers">${view.instruments?.steppers(view)}</span>
      <span class="timeline"><span class="past"></span><span class="present"></span>
        <input class="scrub" type="range" min="0" max=${clock.end || 1} step="any" aria-label=${t("player.time")}
          ?disabled=${!state.trajectory} @input=${(/** @type {Event} */ e) => view.scrub(valueOf(e))}></span>
      <output class="time" aria-live="off"></output>
      <label class="choice speed" title=${t("player.speed")}><span class="unseen">${t("player.speed")}</span>
        <select @change=${(/** @type {Event} */ e) => view.setSpeed(valueOf(e))}>
          ${SPEEDS.map((s) => html`<option value=${s} ?selected=${s === clock.speed}>${s.toLocaleString(state.place.lang)}×</option>`)}
        </select>${icon("chevron")}</label>
    </div>
  `;
}

/** The slider's parts move by steps of this part of their way, about half a pixel: not every frame has one. */
const STRIDES = 500;
/** Milliseconds between two changes of the digits, and of the slider's value, while the motion runs. */
const DIGITS = 100;
const VALUE = 500;

/**
 * What follows the clock. The slider is drawn by parts that are only moved: its own thumb would cost a layout of the
 * whole page in every frame. Its value, for those who hear it, follows at leisure.
 * @param {HTMLElement} player
 */
export function createTransport(player) {
  const find = (/** @type {string} */ name) => /** @type {HTMLElement} */ (player.querySelector(`.${name}`));
  const [past, present, digits] = [find("past"), find("present"), digitsIn(find("time"))];
  const scrub = /** @type {HTMLInputElement} */ (find("scrub"));
  let shown = -1;
  const [sayNow, setNow] = [atMost(DIGITS), atMost(VALUE)];

  return {
    scrub,
    /** @param {number} t @param {import("../model/clock.js").Clock} clock @param {string} lang */
    move(t, { end, playing }, lang) {
      const part = end ? Math.round((t / end) * STRIDES) / STRIDES : 0;
      if (part !== shown) {
        past.style.transform = `scaleX(${part})`;
        present.style.transform = `translateX(${part * 100}%)`;
      }
      shown = part;
      if (!playing || sayNow()) digits.data = `${fixed(t, 2, lang)} s`;
      if (!playing || setNow()) scrub.value = String(t);
    },
  };
}
