/** The buttons above the drawing. */

import { html, svg } from "lit-html";
import { icon } from "../icons.js";

/** @typedef {import("../page.js").View} View */

const PATHS = {
  bars: "M3 17h14M5 17V9h2.6v8M9 17V4h2.6v13M13 17v-6h2.6v6",
  paths: "M3 8c3 9 11 9 14 0M10 3v2M10 7v2M10 11v2",
  vectors: "M4 16m-1.6 0a1.6 1.6 0 1 0 3.2 0a1.6 1.6 0 1 0-3.2 0M5.2 14.8L15 5M9.5 5H15v5.5",
  phase: "M10 10m-7 0a7 5 0 1 0 14 0a7 5 0 1 0-14 0M10 2v16M2 10h16",
  keep: "M3 15C6 3 9 3 12 9M3 17C8 9 12 9 17 15M15 3v6M12 6h6",
};

/** @param {keyof typeof PATHS} name */
const picture = (name) =>
  html`<svg class="icon" viewBox="0 0 20 20" aria-hidden="true">${svg`<path d=${PATHS[name]} />`}</svg>`;

/** Seconds of the viewer's time that a step takes. */
const STEP = 0.04;

/** One picture back or on. @param {Pick<View, "clock" | "t" | "scrub">} view */
export function steppers({ clock, t, scrub }) {
  const button = (/** @type {"previous" | "next"} */ name, /** @type {1 | -1} */ by) => html`
    <button class="tool" title=${t(`player.${name}`)} aria-label=${t(`player.${name}`)} @click=${() => scrub(clock.time + by * STEP * clock.speed)}>${icon(name)}</button>`;
  return html`${button("previous", -1)}${button("next", 1)}`;
}

/** @param {View} view @param {{keep: () => void}} actions */
export function tools({ state, session, clock, t }, { keep }) {
  const { vary, with: shown, panel } = state.place;
  const vary1 = () => {
    if (!vary) clock.play(false);
    session.move({ vary: vary ? "" : "on", panel: vary ? panel : "values" });
  };
  const toggled = (/** @type {string} */ name) => {
    const names = shown.split(",").filter(Boolean);
    session.move({
      with: names.includes(name) ? names.filter((other) => other !== name).join() : [...names, name].join(),
    });
  };
  const switched = (/** @type {"bars" | "paths" | "vectors" | "phase"} */ name) => html`
    <button class="tool" aria-pressed=${String(shown.split(",").includes(name))} title=${t(`tools.${name}`)} aria-label=${t(`tools.${name}`)} @click=${() => toggled(name)}>${picture(name)}</button>`;
  return html`
    <button class="tool" aria-pressed=${String(Boolean(vary))} title=${t("virtual.open")} aria-label=${t("virtual.open")} @click=${vary1}><span class="math"><i>δ</i><b>r</b></span></button>
    ${switched("bars")}${switched("paths")}${switched("vectors")}${switched("phase")}
    <button class="tool" title=${t("runs.keep")} aria-label=${t("runs.keep")} ?disabled=${!state.trajectory} @click=${keep}>${picture("keep")}</button>`;
}
