/** What is to be measured: scene, span, what each lab asks besides, and the scene's own values. */

import { html, nothing } from "lit-html";
import { live } from "lit-html/directives/live.js";
import { inLanguage } from "../../model/catalog.js";
import { inUnicode } from "../../model/labs/symbols.js";
import { perSecond, unitText } from "../../model/numbers.js";
import { OWN } from "../../model/own.js";
import { dotted } from "../../model/values.js";
import { inline } from "../formula.js";
import { settled } from "../settled.js";

/** @typedef {import("./page.js").View} View */
/** @typedef {import("../../model/types.js").Scene} Scene */

const STEPS = [1e3, 1e4, 1e5, 1e6];

/** @param {Event} event */
const textOf = (event) => /** @type {HTMLInputElement} */ (event.target).value;

/** @param {View} view */
export function form(view) {
  const { bench, benches, t } = view;
  const submit = (/** @type {Event} */ event) => {
    event.preventDefault();
    if (bench.running) benches.stop();
    else void benches.start();
  };
  return html`
    <form class="question" @submit=${submit}>
      ${sceneOf(view)}
      ${(OPTIONS[bench.question.lab] ?? [duration]).map((option) => option(view))}
      <button class="main" type="submit" ?disabled=${!bench.scene && !bench.running}>${t(bench.running ? "labs.stop" : bench.result ? "labs.again" : "labs.start")}</button>
      ${bench.scene ? values(view, bench.scene) : nothing}
    </form>`;
}

/** @param {View} view */
function sceneOf({ bench, benches, scenes, t, state }) {
  const { scene } = bench.question;
  return html`
    <label class="field"><span>${t("labs.scene")}</span>
      <select .value=${live(scene)} @change=${(/** @type {Event} */ e) => benches.choose(textOf(e))}>
        ${scene === OWN ? html`<option value=${OWN} selected>${inLanguage(bench.scene?.title, state.place.lang) || t("labs.own")}</option>` : nothing}
        ${scenes.map(({ id, title }) => html`<option value=${id} ?selected=${id === scene}>${inLanguage(title, state.place.lang)}</option>`)}
      </select></label>`;
}

/** @param {View} view @param {string} label @param {unknown} control */
const field = ({ t }, label, control) => html`<label class="field"><span>${t(`labs.${label}`)}</span>${control}</label>`;

/** @param {number | ""} value @param {(value: number) => void} put @param {{min?: number, max?: number, step?: string, placeholder?: string}} [bounds] */
function number(value, put, { min, max, step = "any", placeholder = "" } = {}) {
  const changed = (/** @type {Event} */ e) => textOf(e) !== "" && Number.isFinite(Number(textOf(e))) && put(Number(textOf(e)));
  return html`<input type="number" inputmode="decimal" step=${step} min=${min ?? nothing} max=${max ?? nothing} placeholder=${placeholder} .value=${settled(String(value))} @change=${changed}>`;
}

/** @param {View} view */
function duration(view) {
  const usual = view.bench.question.lab === "chaos" ? 30 : 10;
  return field(view, "duration", number(view.bench.question.duration || usual, (duration) => view.benches.edit({ duration }), { min: 0.1, max: 1000 }));
}

/** @param {View} view */
function peers({ bench, benches, t }) {
  return html`<label class="tick"><input type="checkbox" .checked=${live(bench.question.peers)} @change=${() => benches.edit({ peers: !bench.question.peers })}>${t("labs.peers")}</label>`;
}

/** @param {View} view */
function flips({ bench, benches, t }) {
  return html`<label class="tick"><input type="checkbox" .checked=${live(bench.question.flips)} @change=${() => benches.edit({ flips: !bench.question.flips })}>${t("labs.flips")}</label>`;
}

/** @param {View} view */
function steps(view) {
  const { bench, benches, state } = view;
  const chosen = bench.question.steps || 1e5;
  return field(view, "steps", html`<select .value=${live(String(chosen))} @change=${(/** @type {Event} */ e) => benches.edit({ steps: Number(textOf(e)) })}>
    ${STEPS.map((count) => html`<option value=${count} ?selected=${count === chosen}>${count.toLocaleString(state.place.lang)}</option>`)}</select>`);
}

/** @param {View} view */
function at(view) {
  const { bench, benches, t } = view;
  return field(view, "at", html`<select .value=${live(bench.question.at)} @change=${(/** @type {Event} */ e) => benches.edit({ at: /** @type {"state" | "rest"} */ (textOf(e)) })}>
    ${["state", "rest"].map((place) => html`<option value=${place} ?selected=${place === bench.question.at}>${t(`labs.at-${place}`)}</option>`)}</select>`);
}

/** @param {View} view */
function allowed(view) {
  return field(view, "fidelity.tolerance", number(view.bench.question.allowed, (percent) => view.benches.edit({ allowed: percent }), { min: 1e-6, max: 100 }));
}

/** @param {Scene | null} scene */
const parametersOf = (scene) => scene?.parameters ?? [];

/** @param {View} view */
function stiffness(view) {
  const { bench, benches, t } = view;
  const { stiffness: chosen } = bench.question;
  return field(view, "stiffness", html`<select .value=${live(chosen)} @change=${(/** @type {Event} */ e) => benches.edit({ stiffness: textOf(e) })}>
    <option value="">${t("labs.stiffness-usual")}</option>
    ${parametersOf(bench.scene).map(({ name, latex }) => html`<option value=${name} ?selected=${name === chosen}>${inUnicode(latex || name)}</option>`)}</select>`);
}

/** @param {"x" | "y"} key @returns {(view: View) => unknown} */
const side = (key) => (view) => {
  const { bench, benches, t } = view;
  const parameters = parametersOf(bench.scene);
  const now = bench.question[key] ?? usualSide(parameters, key);
  if (!now) return nothing;
  const put = (/** @type {Partial<import("../../model/labs/question.js").Side>} */ patch) => benches.edit({ [key]: { ...now, ...patch } });
  const choose = (/** @type {Event} */ e) => put(rangeOf(parameters.find(({ name }) => name === textOf(e)) ?? parameters[0]));
  return html`
    <fieldset class="side"><legend>${t(`labs.axis-${key}`)}</legend>
      <select aria-label=${t("labs.parameter")} .value=${live(now.parameter)} @change=${choose}>${parameters.map(({ name, latex }) => html`<option value=${name} ?selected=${name === now.parameter}>${inUnicode(latex || name)}</option>`)}</select>
      <label><span class="unseen">${t("labs.from")}</span>${number(now.from, (from) => put({ from }))}</label>
      <span aria-hidden="true">…</span>
      <label><span class="unseen">${t("labs.to")}</span>${number(now.to, (to) => put({ to }))}</label>
    </fieldset>`;
};

/** @param {import("../../model/types.js").Parameter} parameter @returns {import("../../model/labs/question.js").Side} */
const rangeOf = ({ name, value, min, max }) => ({ parameter: name, from: min ?? value / 2, to: max ?? value * 2 });

/** The last parameters of a driven scene are those that drive it. @param {import("../../model/types.js").Parameter[]} parameters @param {"x" | "y"} key */
function usualSide(parameters, key) {
  const found = parameters[parameters.length - (key === "x" ? 1 : 2)];
  return found ? rangeOf(found) : null;
}

/** The scene's numbers, as changed for this measurement. @param {View} view @param {Scene} scene */
function values(view, scene) {
  const { bench, benches, t } = view;
  const { parameters, initial } = bench.question;
  const guided = new Set((scene.guides ?? []).map((guide) => guide.coordinate));
  const changed = Object.keys(parameters).length + Object.keys(initial).length;
  const start = (/** @type {string} */ name, /** @type {object} */ patch) => benches.edit({ initial: { ...initial, [name]: { ...initial[name], ...patch } } });
  return html`
    <details class="numbers-of-scene" ?open=${changed > 0}><summary>${t("labs.values")}</summary>
      ${scene.parameters.map(({ name, latex, unit, value }) => html`<label class="field row"><span>${inline(latex || name)}</span>
        ${number(parameters[name] ?? value, (given) => benches.edit({ parameters: { ...parameters, [name]: given } }))}<span class="unit">${unitText(unit ?? "")}</span></label>`)}
      ${scene.coordinates.filter(({ name }) => !guided.has(name)).map(({ name, latex, unit, value, rate }) => html`
        <label class="field row"><span>${inline(`${latex || name}(0)`)}</span>${number(initial[name]?.value ?? value, (given) => start(name, { value: given }))}<span class="unit">${unitText(unit ?? "")}</span></label>
        <label class="field row"><span>${inline(`${dotted(latex || name)}(0)`)}</span>${number(initial[name]?.rate ?? rate, (given) => start(name, { rate: given }))}<span class="unit">${unitText(perSecond(unit ?? ""))}</span></label>`)}
    </details>`;
}

/** What each lab asks. @type {Record<string, ((view: View) => unknown)[]>} */
const OPTIONS = {
  "work-precision": [duration, peers],
  convergence: [duration],
  "energy-drift": [steps],
  stability: [at, stiffness, duration],
  "stability-map": [side("x"), side("y")],
  chaos: [duration, flips],
  fidelity: [duration, allowed],
};

/** The sides of a map as the form shows them, also while nobody has chosen. @param {Scene | null} scene @param {import("../../model/labs/question.js").Question} question */
export function withSides(scene, question) {
  const parameters = parametersOf(scene);
  return { ...question, x: question.x ?? usualSide(parameters, "x"), y: question.y ?? usualSide(parameters, "y") };
}
