/** The h-slider: x + h v beside x, and the difference quotient on its way to the derivative and past it. */

import { html, nothing, svg } from "lit-html";
import { live } from "lit-html/directives/live.js";
import { inline } from "../formula.js";
import { significant } from "../../model/numbers.js";
import { curvesChart, errorChart, sizeAt } from "../../model/variations/charts.js";
import { namesIn, textOf } from "../../model/variations/question.js";
import { field } from "./field.js";

/** @typedef {import("./page.js").VariationsView} VariationsView */
/** @typedef {import("../../model/variations/charts.js").Tick} Tick */

const KINDS = /** @type {const} */ (["one_sided", "central"]);

/** @param {VariationsView} view */
export function slider(view) {
  const { asking, t } = view;
  // It comes together with the steps above it, so that it need not make way for them.
  if (!asking.answer) return nothing;
  const vector = Array.isArray(asking.answer.result.first_variation.plain);
  return html`
    <section class="slide" data-step="slide" aria-labelledby="slide-title">
      <h2 id="slide-title" class="chapter">${t("variations.slide")}</h2>
      <p class="prose">${t(vector ? "variations.slide-vector" : "variations.slide-text")}</p>
      ${vector ? nothing : html`${concrete(view)}${asking.quotient ? shown(view, asking.quotient) : html`<div class="charts empty"></div>`}`}
    </section>`;
}

/** The concrete functions. @param {VariationsView} view */
function concrete(view) {
  const { asking, lab, t } = view;
  const { question } = asking;
  const put =
    (/** @type {"samples" | "along" | "values"} */ table, /** @type {string} */ name) => (/** @type {string} */ text) =>
      lab.edit({ [table]: { ...question[table], [name]: text } });
  const directions = namesIn(question.direction);
  return html`
    <div class="fields concrete">
      ${namesIn(question.functions).map(
        (name, i) => html`
        ${field(view, `/numeric/functions/${name}`, html`<span class="q-${i}">${name}(t)</span>`, textOf(question, "samples", name), put("samples", name), { className: "expression" })}
        ${field(view, `/numeric/direction/${name}`, html`<span class="q-${i}">${directions[i] ?? `δ${name}`}(t)</span>`, textOf(question, "along", name), put("along", name), { className: "expression" })}`,
      )}
      ${namesIn(question.parameters).map((name) => field(view, `/numeric/parameters/${name}`, name, textOf(question, "values", name), put("values", name), { className: "narrow" }))}
      ${question.kind === "expression" ? field(view, "/numeric/t", t("variations.instant"), question.t, (text) => lab.edit({ t: text }), { className: "narrow" }) : nothing}
    </div>`;
}

/** @param {VariationsView} view @param {import("../../model/variations/lab.js").Quotient} quotient */
function shown(view, quotient) {
  const { asking, lab, t, state } = view;
  const { lang } = state.place;
  const size = Math.min(asking.size, quotient.h.length - 1);
  const h = quotient.h[size];
  const last = quotient.h.length - 1;
  return html`
    <div class="dial">
      <label for="h">${inline("h")} = <output>${significant(h, 2, lang)}</output></label>
      <input id="h" type="range" min="0" max=${last} step="1" .value=${live(String(last - size))} style=${`--filled:${1 - size / last}`}
        aria-valuetext=${t("variations.moment", spoken(quotient, size, lang))}
        @input=${(/** @type {Event} */ e) => lab.show(last - Number(/** @type {HTMLInputElement} */ (e.target).value))}>
      ${table(quotient, size, view)}
    </div>
    <div class="charts">${curves(view, quotient, h)}${errors(view, quotient, size)}</div>`;
}

/** @param {import("../../model/variations/lab.js").Quotient} quotient @param {number} size @param {string} lang */
function spoken({ h, one_sided, central, derivative }, size, lang) {
  const write = (/** @type {number | null} */ value) => significant(value ?? NaN, 6, lang);
  return {
    h: significant(h[size], 2, lang),
    one: write(one_sided.quotient[size]),
    central: write(central.quotient[size]),
    derivative: write(derivative),
  };
}

/** @param {import("../../model/variations/lab.js").Quotient} quotient @param {number} size @param {VariationsView} view */
function table(quotient, size, { t, state }) {
  const { lang } = state.place;
  const number = (/** @type {number | null} */ value, digits = 12) => significant(value ?? NaN, digits, lang);
  return html`
    <table class="numbers">
      <thead><tr><td></td><th scope="col">${t("variations.value")}</th><th scope="col">${t("variations.error")}</th></tr></thead>
      <tbody>
        ${KINDS.map((kind) => html`<tr><th scope="row" class=${kind}>${t(`variations.${kind}`)}</th><td>${number(quotient[kind].quotient[size])}</td><td>${number(quotient[kind].error[size], 2)}</td></tr>`)}
        <tr><th scope="row">${t("variations.derivative")}</th><td>${number(quotient.derivative)}</td><td></td></tr>
      </tbody>
    </table>`;
}

/** Axes with numbers and names. @param {import("../../model/variations/charts.js").Frame} frame @param {Tick[]} across @param {Tick[]} up @param {(value: string | number) => string} write @param {[string, string]} names @param {number} em */
function axes({ left, right, top, bottom }, across, up, write, [below, beside], em) {
  return svg`
    ${up.map(({ at, text }) => svg`<path class="grid" d="M${left} ${at}H${right}"/><text class="tick" x=${left - 0.4 * em} y=${at + 0.3 * em} text-anchor="end">${write(text)}</text>`)}
    ${across.map(({ at, text }) => svg`<path class="grid" d="M${at} ${top}V${bottom}"/><text class="tick" x=${at} y=${bottom + 1.1 * em} text-anchor="middle">${write(text)}</text>`)}
    <text class="axis" x=${(left + right) / 2} y=${bottom + 2.3 * em} text-anchor="middle">${below}</text>
    <text class="axis" transform=${`translate(${0.8 * em} ${(top + bottom) / 2}) rotate(-90)`} text-anchor="middle">${beside}</text>`;
}

/** @param {VariationsView} view @param {import("../../model/variations/lab.js").Quotient} quotient @param {number} h */
function curves(view, quotient, h) {
  const { size, t, state, asking } = view;
  const chart = curvesChart(quotient, h, size);
  const names = Object.keys(quotient.curves.functions);
  const directions = namesIn(asking.question.direction);
  const { top, bottom } = chart.frame;
  const number = (/** @type {string | number} */ value) =>
    String(value)
      .replace(".", state.place.lang === "de" ? "," : ".")
      .replace("-", "−");
  return html`
    <figure style="width:${size.width}px">
      <figcaption class="legend">${names.map(
        (name, i) => html`
        <span class="key q-${i}"><i class="plain"></i>${name}(t)</span><span class="key q-${i}"><i class="neighbour"></i>${name}(t) + h ${directions[i] ?? `δ${name}`}(t)</span>`,
      )}</figcaption>
      <svg width=${size.width} height=${size.height} role="img" aria-label=${t("variations.curves-label")}>
        ${axes(chart.frame, chart.across, chart.up, number, ["t", t("variations.functions-axis")], size.em)}
        ${chart.at === null ? nothing : svg`<path class="instant" d="M${chart.at} ${top}V${bottom}"/>`}
        ${[...chart.between, ...chart.lines].map(({ className, d }) => svg`<path class="curve ${className}" d=${d}/>`)}
      </svg>
    </figure>`;
}

/** @param {VariationsView} view @param {import("../../model/variations/lab.js").Quotient} quotient @param {number} index */
function errors(view, quotient, index) {
  const { size, t, lab, state } = view;
  const chart = errorChart(quotient, size);
  const { top, bottom } = chart.frame;
  const x = chart.x(quotient.h[index]);
  const seek = (/** @type {PointerEvent} */ event) => {
    const box = /** @type {Element} */ (event.currentTarget).getBoundingClientRect();
    if (event.buttons & 1) lab.show(sizeAt(quotient.h, event.clientX - box.left, size));
  };
  const power = (/** @type {string | number} */ value) =>
    significant(10 ** Number(value), 1, state.place.lang).replace(/^1·/, "");
  return html`
    <figure style="width:${size.width}px">
      <figcaption class="legend">${KINDS.map((kind) => html`<span class="key ${kind}"><i class="dot"></i>${t(`variations.${kind}`)}</span>`)}
        <span class="key"><i class="law"></i>${t("variations.law")}</span><span class="key"><i class="best"></i>${t("variations.best")}</span></figcaption>
      <svg class="errors" width=${size.width} height=${size.height} role="img" aria-label=${t("variations.errors-label")} @pointerdown=${seek} @pointermove=${seek}>
        ${axes(chart.frame, chart.across, chart.up, power, ["h", t("variations.error-axis")], size.em)}
        ${chart.optima.map(({ className, x: at }) => svg`<path class="best ${className}" d="M${at} ${top}V${bottom}"/>`)}
        ${chart.truncation.map(({ className, d }) => svg`<path class="law ${className}" d=${d}/>`)}
        <path class="law rounding" d=${chart.rounding}/>
        ${chart.dots.map(({ className, points }) => points.map((point, i) => (point ? svg`<circle class="${className} ${i === index ? "now" : ""}" cx=${point[0]} cy=${point[1]} r=${(i === index ? 0.38 : 0.16) * size.em}/>` : nothing)))}
        ${chart.notes.map(({ className, x: at, y, text }) => svg`<text class="note ${className}" x=${at + (className === "rounding" ? 0.5 : -0.5) * size.em} y=${y - 0.6 * size.em} text-anchor=${className === "rounding" ? "start" : "end"}>${text}</text>`)}
        <path class="cursor" d="M${x} ${top}V${bottom}"/>
      </svg>
    </figure>`;
}
