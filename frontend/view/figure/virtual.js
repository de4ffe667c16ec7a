/** The variation to be seen: sliders for δq, a ghost of the drawing, arrows δr and dr, and the work of each load. */

import { html } from "lit-html";
import { live } from "lit-html/directives/live.js";
import { inline } from "../formula.js";
import { numberField } from "../number-field.js";
import { layerIn } from "./layer.js";
import { called } from "../../model/catalog.js";
import { placed } from "../../model/drawing/placing.js";
import { decimalsOf, fixed, unitText, withUnit } from "../../model/numbers.js";
import { differences, LONGEST, reachOf, readChoice, writeChoice } from "../../model/virtual/choice.js";
import { virtualFigure } from "../../model/virtual/figure.js";
import { scaled, virtualOf } from "../../model/virtual/virtual.js";

/** @typedef {import("../page.js").View} View */
/** @typedef {import("./open.js").Bench} Bench */

const NOTHING = { shapes: [], labels: [] };

/** @param {Bench} bench */
export function createVirtual(bench) {
  const {
    frame,
    parts: { drawing },
    state,
    session,
  } = bench;
  const [under, over] = ["under", "over"].map((name) => layerIn(frame, name));
  let shown = false;

  const free = () => {
    const { scene } = state();
    const guided = new Set((scene?.guides ?? []).map(({ coordinate }) => coordinate));
    return (scene?.coordinates ?? []).filter(({ name }) => !guided.has(name));
  };
  const choice = () => readChoice(state().place.vary, free());
  /** @param {import("../../model/virtual/choice.js").Choice} next */
  const choose = (next) => session.move({ vary: writeChoice(next) });

  function clear() {
    if (!shown) return;
    [under, over].forEach(({ draw }) => draw(NOTHING));
    frame.classList.remove("varied");
    shown = false;
  }

  function compute() {
    const [kinematics, now] = [bench.kinematics(), bench.now()];
    if (!kinematics || !now || !state().scene) return null;
    return virtualOf(
      kinematics,
      now,
      (state().scene?.bodies ?? []).map(({ name }) => name),
      choice(),
    );
  }

  function move() {
    const { stage } = drawing;
    const found = state().place.vary && stage ? compute() : null;
    if (!stage || !found) return clear();
    shown = true;
    frame.classList.add("varied");
    const figure = virtualFigure(stage, found);
    under.draw(figure.under, stage.size);
    over.draw(placed(stage, figure.over, bench.clock.time, drawing.ground), stage.size);
    weigh(found);
  }

  /** Each load's work as a bar to the right or left. @param {import("../../model/virtual/virtual.js").Virtual} virtual */
  function weigh({ works, total }) {
    const { lang } = state().place;
    const largest = Math.max(...works.map(({ work }) => Math.abs(work)), Math.abs(total), 1e-12);
    for (const { load, work } of [...works, { load: "", work: total }]) {
      const bar = /** @type {HTMLElement | null} */ (document.querySelector(`.bars [data-load="${CSS.escape(load)}"]`));
      if (!bar) continue;
      /** @type {HTMLElement} */ (bar.querySelector(".fill")).style.transform = `scaleX(${work / largest})`;
      /** @type {HTMLElement} */ (bar.querySelector(".number")).textContent = `${fixed(work, 3, lang)} J`;
    }
  }

  /** The motion's own change of the coordinates in dt. */
  function follow() {
    const [now, { dt }] = [bench.now(), choice()];
    if (now) choose({ delta: scaled(now.rates, dt), dt });
  }

  return {
    move,
    /** The coordinates as varied. */
    varied: () => compute()?.varied.coordinates ?? null,
    /** Where a place stands when varied. @param {string} place @returns {import("../../model/types.js").Pixel} */
    where: (place) => drawing.stage?.project(compute()?.varied.positions[place] ?? []) ?? [0, 0],
    /** Varies the coordinates to these values. @param {import("../../model/kinematics/expression.js").Values} q */
    vary(q) {
      const now = bench.now();
      if (now) choose({ ...choice(), delta: differences(free(), now.coordinates, q) });
    },
    /** @param {View} view */
    panel: (view) =>
      panel(view, free(), choice(), { choose, follow, loads: compute()?.works.map(({ load }) => load) ?? [] }),
  };
}

/**
 * @param {View} view @param {import("../../model/types.js").Coordinate[]} free
 * @param {import("../../model/virtual/choice.js").Choice} choice
 * @param {{choose: (next: import("../../model/virtual/choice.js").Choice) => void, follow: () => void, loads: string[]}} actions
 */
function panel({ state, session, t }, free, { delta, dt }, { choose, follow, loads }) {
  const { lang } = state.place;
  // Parts of δr have their letters here, since in the drawing there may be no room for them.
  const varied = free.filter(({ name }) => delta[name]);
  const index = (/** @type {string} */ name) => state.scene?.coordinates.findIndex((each) => each.name === name);
  return html`
    <section class="values virtual-panel" aria-label=${t("virtual")}>
      <div class="heading"><h2>${t("virtual.frozen")}</h2>
        <button class="quiet small" @click=${() => session.move({ vary: "" })}>${t("virtual.close")}</button></div>
      ${free.map((each) =>
        row(lang, {
          className: `q-${index(each.name)}`,
          key: each.name,
          latex: `\\delta ${each.latex || each.name}`,
          unit: each.unit,
          label: t("virtual.delta", { name: each.name }),
          value: delta[each.name] ?? 0,
          reach: reachOf(each),
          least: -reachOf(each),
          set: (value) => choose({ delta: { ...delta, [each.name]: value }, dt }),
        }),
      )}
      <div class="heading"><h2>${t("virtual.running")}</h2>
        <button class="quiet small" title=${t("virtual.follow-help")} ?disabled=${!dt} @click=${follow}>${inline("\\delta q = \\dot q\\,\\mathrm dt")}</button></div>
      ${row(lang, { className: "time-term", key: "dt", latex: "\\mathrm dt", unit: "s", label: t("virtual.dt"), value: dt, reach: LONGEST, least: 0, set: (value) => choose({ delta, dt: value }) })}
      <ul class="arrows">
        <li><span class="swatch virtual"></span>${inline("\\delta\\mathbf r")}<span>${t("virtual.variation")}</span></li>
        ${varied.length > 1 ? varied.map(({ name, latex }) => html`<li class=${`q-${index(name)}`}><span class="swatch"></span>${inline(`\\tfrac{\\partial\\mathbf r}{\\partial ${latex || name}}\\,\\delta ${latex || name}`)}<span>${t("virtual.part")}</span></li>`) : ""}
        ${
          dt
            ? html`<li><span class="swatch actual"></span>${inline("\\mathrm d\\mathbf r")}<span>${t("virtual.differential")}</span></li>
          <li class="time-term"><span class="swatch"></span>${inline("\\tfrac{\\partial\\mathbf r}{\\partial t}\\mathrm dt")}<span>${state.scene?.guides?.length ? t("virtual.explicit") : t("virtual.no-explicit")}</span></li>`
            : ""
        }
      </ul>
      <div class="heading"><h2>${t("virtual.work")} ${inline("\\mathbf F\\cdot\\delta\\mathbf r")}</h2></div>
      <div class="bars">
        ${loads.map((load) => bar(load, called(state.scene?.labels, load, lang, t), `load-${load}`))}
        ${bar("", inline("\\delta W"), "whole")}
      </div>
    </section>
  `;
}

/** @param {string} lang @param {{className: string, key: string, latex: string, unit: string, label: string, value: number, reach: number, least: number, set: (value: number) => void}} given */
function row(lang, { className, key, latex, unit, label, value, reach, least, set }) {
  const put = (/** @type {number} */ asked) => {
    const held = Math.max(least, Math.min(reach, asked));
    set(held);
    return held;
  };
  const changed = (/** @type {Event} */ e) => put(Number(/** @type {HTMLInputElement} */ (e.target).value));
  const step = reach / 100;
  const decimals = Math.max(2, decimalsOf(step));
  return html`
    <div class="row ${className}" data-slider=${`delta-${key}`}>
      <span class="symbol" title=${label}>${inline(latex)}</span>
      <input type="range" aria-label=${label} min=${least} max=${reach} step=${step} style="--filled:${(value - least) / (reach - least)}"
        aria-valuetext=${`${fixed(value, decimals, lang)} ${unitText(unit)}`.trim()} .value=${live(String(value))} @input=${changed}>
      ${numberField({ value: Number(value.toFixed(decimals)), lang, put, label: withUnit(label, unit), step, least })}
      <span class="unit">${unitText(unit)}</span>
    </div>`;
}

/** @param {string} load @param {unknown} name @param {string} className */
const bar = (load, name, className) => html`
  <div class="bar ${className}" data-load=${load}><span class="name">${name}</span><span class="rail"><span class="fill"></span></span><span class="number"></span></div>`;
