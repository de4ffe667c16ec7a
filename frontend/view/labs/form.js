/** What is to be measured: scene, what the experiment asks besides, and the scene's own values. */

import { html, nothing } from "lit-html";
import { live } from "lit-html/directives/live.js";
import { inLanguage } from "../../model/catalog.js";
import { rangeOf } from "../../model/labs/options.js";
import { answered } from "../../model/labs/question.js";
import { inUnicode } from "../../model/labs/symbols.js";
import { perSecond, unitText } from "../../model/numbers.js";
import { OWN } from "../../model/own.js";
import { dotted } from "../../model/values.js";
import { inline } from "../formula.js";
import { numberField } from "../number-field.js";

/** @typedef {import("./page.js").View} View */
/** @typedef {import("../../model/labs/options.js").Option} Option */
/** @typedef {import("../../model/types.js").Scene} Scene */

/** @param {Event} event */
const textOf = (event) => /** @type {HTMLInputElement} */ (event.target).value;

/** @param {View} view */
export function form(view) {
  const { bench, benches, known, t } = view;
  const submit = (/** @type {Event} */ event) => {
    event.preventDefault();
    if (bench.running) benches.stop();
    else void benches.start();
  };
  return html`
    <form class="question" @submit=${submit}>
      ${sceneOf(view)}
      ${known.experiment(bench.question.lab).options.map((option) => CONTROLS[option.kind](view, option))}
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

/** The text of an option; the service's own sentence where the page has none. @param {View} view @param {Option} option */
export function labelOf({ t }, { label, description }) {
  const text = t(`labs.${label}`);
  return text === `labs.${label}` ? (description ?? text) : text;
}

/** @param {View} view @param {Option} option @param {unknown} control */
const field = (view, option, control) =>
  html`<label class="field"><span>${labelOf(view, option)}</span>${control}</label>`;

/** What is outside of its bounds the service refuses, in a sentence. @param {View} view @param {number | ""} value @param {(value: number) => void} put @param {number} [least] */
const number = ({ state }, value, put, least) => numberField({ value, lang: state.place.lang, put, least });

/** @param {View} view @param {Option} option */
function quantity(view, option) {
  const { bench, benches } = view;
  const { name, range, usual } = option;
  const answer = bench.question[name];
  const shown = answer === usual ? (range?.shown ?? "") : Number(answer);
  return field(
    view,
    option,
    number(view, shown, (given) => benches.edit({ [name]: given }), range?.min),
  );
}

/** @param {View} view @param {Option} option */
function tick(view, option) {
  const { bench, benches } = view;
  const { name } = option;
  return html`<label class="tick"><input type="checkbox" .checked=${live(bench.question[name])} @change=${() => benches.edit({ [name]: !bench.question[name] })}>${labelOf(view, option)}</label>`;
}

/** @param {View} view @param {Option} option */
function choice(view, option) {
  const { name, label, choices = [] } = option;
  const { bench, benches, state, t } = view;
  const chosen = bench.question[name];
  const said = (/** @type {string | number} */ one) => {
    const key = `labs.${label}-${one}`;
    return typeof one === "number" ? one.toLocaleString(state.place.lang) : t(key) === key ? one : t(key);
  };
  return field(
    view,
    option,
    html`<select .value=${live(String(chosen))} @change=${(/** @type {Event} */ e) => benches.edit({ [name]: choices.find((one) => String(one) === textOf(e)) })}>
    ${choices.map((one) => html`<option value=${one} ?selected=${one === chosen}>${said(one)}</option>`)}</select>`,
  );
}

/** An expression as it is typed. @param {View} view @param {Option} option */
function written(view, option) {
  const { bench, benches, t } = view;
  const { name } = option;
  return field(
    view,
    option,
    html`<input type="text" spellcheck="false" autocapitalize="off" autocomplete="off" maxlength="2000" placeholder=${t(`labs.${name}-usual`)}
      .value=${live(String(bench.question[name] ?? ""))} @change=${(/** @type {Event} */ e) => benches.edit({ [name]: textOf(e).trim() })}>`,
  );
}

/** @param {View} view */
const parametersOf = ({ bench }) => bench.scene?.parameters ?? [];
/** @param {import("../../model/types.js").Parameter[]} parameters @param {string} chosen */
const entries = (parameters, chosen) =>
  parameters.map(
    ({ name, latex }) => html`<option value=${name} ?selected=${name === chosen}>${inUnicode(latex || name)}</option>`,
  );

/** @param {View} view @param {Option} option */
function parameter(view, option) {
  const { name, label } = option;
  const { bench, benches, t } = view;
  const chosen = String(bench.question[name]);
  return field(
    view,
    option,
    html`<select .value=${live(chosen)} @change=${(/** @type {Event} */ e) => benches.edit({ [name]: textOf(e) })}>
    <option value="">${t(`labs.${label}-usual`)}</option>${entries(parametersOf(view), chosen)}</select>`,
  );
}

/** @param {View} view @param {Option} option */
function side(view, { name, label, values: usual }) {
  const { bench, benches, t } = view;
  const parameters = parametersOf(view);
  const now = /** @type {import("../../model/labs/options.js").Side | null} */ (
    answered(bench.question, bench.scene, view.known)[name]
  );
  if (!now) return nothing;
  const put = (/** @type {object} */ patch) => benches.edit({ [name]: { ...now, ...patch } });
  const choose = (/** @type {Event} */ e) =>
    put(rangeOf(parameters.find((one) => one.name === textOf(e)) ?? parameters[0]));
  const count = () =>
    html`<label class="field row count"><span>${t("labs.count")}</span>${number(view, now.count ?? usual ?? "", (given) => put({ count: given }), 0)}</label>`;
  return html`
    <fieldset class="side"><legend>${t(`labs.${label}`)}</legend>
      <select aria-label=${t("labs.parameter")} .value=${live(now.parameter)} @change=${choose}>${entries(parameters, now.parameter)}</select>
      <label><span class="unseen">${t("labs.from")}</span>${number(view, now.from, (from) => put({ from }))}</label>
      <span aria-hidden="true">…</span>
      <label><span class="unseen">${t("labs.to")}</span>${number(view, now.to, (to) => put({ to }))}</label>
      ${usual ? count() : nothing}
    </fieldset>`;
}

/** How each kind of option is asked. @type {Record<Option["kind"], (view: View, option: Option) => unknown>} */
const CONTROLS = { number: quantity, tick, choice, text: written, parameter, side };

/** The scene's numbers, as changed for this measurement. @param {View} view @param {Scene} scene */
function values(view, scene) {
  const { bench, benches, t } = view;
  const { parameters, initial } = bench.question;
  const guided = new Set((scene.guides ?? []).map((guide) => guide.coordinate));
  const changed = Object.keys(parameters).length + Object.keys(initial).length;
  const start = (/** @type {string} */ name, /** @type {object} */ patch) =>
    benches.edit({ initial: { ...initial, [name]: { ...initial[name], ...patch } } });
  return html`
    <details class="numbers-of-scene" ?open=${changed > 0}><summary>${t("labs.values")}</summary>
      ${scene.parameters.map(
        ({ name, latex, unit, value }) => html`<label class="field row"><span>${inline(latex || name)}</span>
        ${number(view, parameters[name] ?? value, (given) => benches.edit({ parameters: { ...parameters, [name]: given } }))}<span class="unit">${unitText(unit ?? "")}</span></label>`,
      )}
      ${scene.coordinates
        .filter(({ name }) => !guided.has(name))
        .map(
          ({ name, latex, unit, value, rate }) => html`
        <label class="field row"><span>${inline(`${latex || name}(0)`)}</span>${number(view, initial[name]?.value ?? value, (given) => start(name, { value: given }))}<span class="unit">${unitText(unit ?? "")}</span></label>
        <label class="field row"><span>${inline(`${dotted(latex || name)}(0)`)}</span>${number(view, initial[name]?.rate ?? rate, (given) => start(name, { rate: given }))}<span class="unit">${unitText(perSecond(unit ?? ""))}</span></label>`,
        )}
    </details>`;
}
