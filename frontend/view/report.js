/** How the motion is to be computed, and how it was. */

import { html, nothing } from "lit-html";
import { live } from "lit-html/directives/live.js";
import { prose } from "./formula.js";
import { icon } from "./icons.js";
import { indeterminateIn } from "../model/indeterminate.js";
import { duration, fixed, numberText, significant } from "../model/numbers.js";
import { caveatsOf, largestError } from "../model/trajectory.js";

/** @typedef {import("./page.js").View} View */

const DURATIONS = [5, 10, 20, 40, 60];

/** @param {View} view */
export function report(view) {
  return html`<div class="report">${numerics(view)}${status(view)}</div>`;
}

/** @param {View} view */
function numerics({ state, session, t, methodTitle }) {
  const chosen = (/** @type {Event} */ e) => /** @type {HTMLSelectElement} */ (e.target).value;
  const { lang, method, duration: seconds } = state.place;
  const durations = [...new Set([...DURATIONS, seconds])].sort((a, b) => a - b);
  return html`
    <div class="numerics" role="group" aria-label=${t("numerics")}>
      <label class="choice" title=${t("numerics.method")}><span class="unseen">${t("numerics.method")}</span>
        <select .value=${live(method)} @change=${(/** @type {Event} */ e) => session.resimulate({ method: chosen(e) })}>
          <option value="">${t("numerics.auto")}</option>
          ${state.methods.map((m) => html`<option value=${m.id} ?selected=${m.id === method}>${methodTitle(m.id)}</option>`)}
        </select>${icon("chevron")}</label>
      <label class="choice" title=${t("numerics.duration")}><span class="unseen">${t("numerics.duration")}</span>
        <select .value=${live(String(seconds))} @change=${(/** @type {Event} */ e) => session.resimulate({ duration: Number(chosen(e)) })}>
          ${durations.map((d) => html`<option value=${d} ?selected=${d === seconds}>${numberText(d, lang)} s</option>`)}
        </select>${icon("chevron")}</label>
    </div>
  `;
}

/** @param {View} view */
function status(view) {
  const { state, t } = view;
  const { trajectory } = state;
  if (!trajectory) return html`<p class="status">${state.simulating ? t("status.running") : nothing}</p>`;
  return html`
    ${warning(view)}
    ${indeterminate(view)}
    <p class="status ${state.simulating ? "busy" : ""}">${facts(trajectory, view).map((fact) => html`<span title=${fact.help ?? nothing}>${fact.text}</span>`)}</p>
  `;
}

/**
 * @param {import("../model/types.js").Trajectory} trajectory @param {View} view
 * @returns {{text: string, help?: string}[]}
 */
function facts(trajectory, { state, t, methodTitle }) {
  const { lang } = state.place;
  const { cost } = trajectory;
  const error = largestError(trajectory);
  const horizon = trajectory.error?.horizon ?? null;
  return [
    { text: methodTitle(trajectory.method) },
    ...(error === null
      ? []
      : [{ text: t("status.error", { error: significant(error, 2, lang) }), help: t("status.error-help") }]),
    ...(horizon !== null && horizon < state.place.duration
      ? [{ text: t("status.until", { time: fixed(horizon, 1, lang) }), help: t("status.until-help") }]
      : []),
    ...(cost?.steps === undefined
      ? []
      : [
          { text: t("status.steps", { count: cost.steps }), help: t("status.rejected", { count: cost.rejected ?? 0 }) },
        ]),
    ...(cost?.wall_time === undefined ? [] : [{ text: duration(cost.wall_time, lang), help: t("status.time-help") }]),
  ];
}

/** What is to be said of the motion, unless a better answer is on its way. @param {View} view */
export function caveats({ state, t }) {
  const { trajectory, simulating } = state;
  return trajectory ? caveatsOf(simulating ? { ...trajectory, coarse: false } : trajectory, t) : [];
}

/** Forces that the motion does not determine. @param {View} view */
function indeterminate({ state: { scene, trajectory, place }, t }) {
  const told = scene && trajectory ? indeterminateIn(trajectory, scene, t, place.lang) : [];
  return told.map((sentence) => html`<p class="note">${prose(sentence)}</p>`);
}

/** Why a motion is incomplete and what helps. @param {View} view */
function warning(view) {
  const [first, ...rest] = caveats(view);
  return first ? html`<p class="warning" role="alert"><strong>${first}</strong> ${rest.join(" ")}</p>` : nothing;
}
