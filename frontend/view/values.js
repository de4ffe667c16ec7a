/** Sliders for parameters and initial values. */

import { html, nothing } from "lit-html";
import { live } from "lit-html/directives/live.js";
import { inline } from "./formula.js";
import { numberField } from "./number-field.js";
import { heldAt, isChanged, rangeText, slidersOf } from "../model/values.js";
import { brief, fixed, unitText, withUnit } from "../model/numbers.js";

/** @typedef {import("./page.js").View} View */
/** @typedef {import("../model/values.js").Slider} Slider */

/** @param {View} view */
export function values(view) {
  const { state, session, t } = view;
  if (!view.state.scene) return html`<section class="values" aria-label=${t("values")}></section>`;
  const { family } = state.scenes.find(({ id }) => id === state.place.scene) ?? {};
  const sliders = slidersOf(view.state.scene, state.changes);
  const group = (/** @type {string} */ name) =>
    sliders.filter((slider) => slider.group === name).map((slider) => row(slider, view));
  return html`
    <section class="values" aria-label=${t("values")}>
      ${family ? size({ ...family, value: state.place.n || family.value }, view) : nothing}
      <div class="heading"><h2>${t("values.initial")}</h2>
        <button class="quiet small" ?disabled=${!isChanged(state.changes)} @click=${session.reset}>${t("values.reset")}</button></div>
      ${group("initial")}
      <div class="heading"><h2>${t("values.parameters")}</h2></div>
      ${group("parameter")}
    </section>
  `;
}

/** How many members a chain has: another number is another scene. @param {import("../model/types.js").Family} family @param {View} view */
function size({ parameter, min, max, value }, { state, session, t }) {
  const choose = (/** @type {number} */ asked) => {
    const count = Math.max(min, Math.min(max, Math.round(asked)));
    void session.choose(state.place.scene, "", count);
    return count;
  };
  return html`
    <div class="row" data-slider="size">
      <span class="symbol">${inline(parameter)}</span>
      <input type="range" aria-label=${t("values.parameter", { name: parameter })} min=${min} max=${max} step="1"
        style="--filled:${(value - min) / (max - min)}" .value=${live(String(value))} @change=${(/** @type {Event} */ e) => choose(Number(/** @type {HTMLInputElement} */ (e.target).value))}>
      ${numberField({ value, lang: state.place.lang, label: parameter, least: min, put: choose })}
      <span class="unit"></span>
    </div>
  `;
}

/** @param {Slider} slider @param {View} view */
function row(slider, { state, session, t }) {
  const kind =
    slider.group === "parameter" ? "values.parameter" : slider.field === "rate" ? "values.rate" : "values.value";
  const label = t(kind, { name: slider.name });
  const filled = Math.max(0, Math.min(1, (slider.value - slider.min) / (slider.max - slider.min || 1)));
  const moved = (/** @type {Event} */ e) =>
    session.slide(slider, Number(/** @type {HTMLInputElement} */ (e.target).value));
  const typed = (/** @type {number} */ asked) => {
    session.slide(slider, asked);
    return shown(slider, heldAt(slider, asked));
  };
  const { lang } = state.place;
  const hint = hintOf(slider, state, t);
  return html`
    <div class="row ${slider.className}" data-slider=${slider.key}>
      <span class="symbol" title=${label}>${inline(slider.latex)}</span>
      <input type="range" aria-label=${label} min=${slider.min} max=${slider.max} step=${slider.step}
        aria-valuetext=${`${fixed(slider.value, slider.decimals, lang)} ${unitText(slider.unit)}`.trim()} style="--filled:${filled}" .value=${live(String(slider.value))} @input=${moved}>
      ${numberField({ value: shown(slider, slider.value), lang, put: typed, label: withUnit(label, slider.unit), hint: hint && `hint-${slider.key}`, step: slider.step, least: slider.least })}
      <span class="unit">${unitText(slider.unit)}</span>
      <span class="hint" id=${`hint-${slider.key}`} role="status">${hint}</span>
    </div>
  `;
}

/** As many digits as there is room for. @param {Slider} slider @param {number} value */
const shown = ({ decimals }, value) => Number(value.toFixed(Math.max(decimals, 2)));

/** A number beyond what the scene allows: typed, it is held; given by a link, it is taken as it is. Either is told. @param {Slider} slider @param {View["state"]} state @param {View["t"]} t */
function hintOf(slider, { held, place: { lang } }, t) {
  const range = rangeText(slider, lang);
  if (held?.key === slider.key) return t("values.held", { asked: brief(held.asked, 6, lang), range });
  return heldAt(slider, slider.value) === slider.value ? "" : t("values.outside", { range });
}
