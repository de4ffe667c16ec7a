/** The API to be tried: a call, its request to be written and sent, and what comes back. */

import { html, nothing } from "lit-html";
import { live } from "lit-html/directives/live.js";
import { failure } from "../failure.js";
import { toClipboard } from "../files.js";
import { icon } from "../icons.js";
import { titled, top } from "../top.js";
import { curlOf } from "../../model/trial.js";
import { pageAddress } from "../../model/url.js";

/** @typedef {import("../../model/reference.js").Call} Call */
/** @typedef {import("../../model/reference.js").Input} Input */
/** @typedef {{state: "empty" | "waiting" | "stopped" | "unreachable"} | {state: "answered", answer: import("../../model/trial.js").Answer}} Coming */
/**
 * @typedef {import("../header.js").Appearance & {groups: import("../../model/reference.js").Group[], call: Call | null,
 *   draft: import("../../model/trial.js").Draft, coming: Coming, failure: import("../../model/types.js").Failure | null, reload: () => void,
 *   choose: (id: string) => void, write: (patch: Partial<import("../../model/trial.js").Draft>) => void, show: (example: number) => void,
 *   send: () => void, stop: () => void, origin: string}} TrialView
 */

/** @param {Event} event */
const valueOf = ({ target }) => /** @type {HTMLInputElement} */ (target).value;

/** @param {TrialView} view */
export function page(view) {
  const { t } = view;
  return html`
    ${top(view, { main: "trial", here: "docs", heading: titled(t("trial"), t("trial.subtitle")) })}
    <main class="trial" id="trial" tabindex="-1">
      ${view.failure ? failure(view.failure, t("failure.page"), view.reload, t) : nothing}
      ${view.call ? html`${request(view.call, view)}${answer(view)}` : nothing}
    </main>`;
}

/** @param {Call} call @param {TrialView} view */
function request(call, view) {
  const { draft, write, t } = view;
  const submit = (/** @type {Event} */ event) => {
    event.preventDefault();
    view.send();
  };
  const press = (/** @type {KeyboardEvent} */ event) => {
    if (event.key === "Enter" && (event.ctrlKey || event.metaKey))
      /** @type {HTMLFormElement} */ (event.currentTarget).requestSubmit();
  };
  return html`
    <form @submit=${submit} @keydown=${press}>
      ${chooser(call, view)}
      <p class="meaning"><span lang="en">${call.text}</span> <a href=${`${pageAddress("docs", view.state.place)}#${call.id}`}>${t("trial.fields")}</a></p>
      ${call.inputs.map((input) => inputField(input, view))}
      ${
        call.type
          ? html`
        <label class="body"><span>${t("trial.body", { type: call.type })}</span>
          <textarea spellcheck="false" autocapitalize="off" autocomplete="off" rows=${Math.min(24, Math.max(6, draft.body.split("\n").length + 1))}
            .value=${live(draft.body)} @input=${(/** @type {Event} */ event) => write({ body: valueOf(event) })}></textarea></label>`
          : nothing
      }
      <div class="acts">
        <button class="main">${t("trial.send")}</button>
        ${view.coming.state === "waiting" ? html`<button type="button" class="quiet" @click=${view.stop}>${t("trial.stop")}</button>` : html`<span class="hint">${t("trial.hint")}</span>`}
        ${examples(call, view)}
      </div>
      ${commandLine(call, view)}
    </form>`;
}

/** @param {Call} call @param {TrialView} view */
const chooser = (call, { groups, choose, t }) => html`
  <label class="called"><span>${t("trial.call")}</span>
    <span class="choice"><select @change=${(/** @type {Event} */ event) => choose(valueOf(event))}>
      ${groups.map(
        ({ subject, calls }) =>
          html`<optgroup label=${subject}>${calls.map(
            ({ id, method, path }) => html`
        <option value=${id} ?selected=${id === call.id}>${method} ${path}</option>`,
          )}</optgroup>`,
      )}</select>${icon("chevron")}</span></label>`;

/** @param {Input} input @param {TrialView} view */
function inputField({ name, text, required, choices }, { draft, write, t }) {
  const changed = (/** @type {Event} */ event) => write({ values: { ...draft.values, [name]: valueOf(event) } });
  const field = choices.length
    ? html`<select @change=${changed}>${[...(required ? [] : [""]), ...choices].map((one) => html`<option value=${one} ?selected=${one === draft.values[name]}>${one || t("trial.any")}</option>`)}</select>`
    : html`<input ?required=${required} autocomplete="off" autocapitalize="off" spellcheck="false" .value=${live(draft.values[name])} @input=${changed}>`;
  return html`<label class="input"><span><code>${name}</code> ${required ? html`<small>${t("reference.required")}</small>` : nothing}</span>${field}
    ${text ? html`<small lang="en">${text}</small>` : nothing}</label>`;
}

/** @param {Call} call @param {TrialView} view */
function examples(call, { show, t }) {
  if (!call.type && !call.inputs.length) return nothing;
  const numbers = call.examples.length ? call.examples.map((_, i) => i) : [0];
  return html`<span class="examples" role="group" aria-label=${t("trial.examples")}>${numbers.map(
    (i) => html`
    <button type="button" class="quiet" @click=${() => show(i)}>${t("trial.example", { number: i + 1 })}</button>`,
  )}</span>`;
}

/** @param {Call} call @param {TrialView} view */
function commandLine(call, { draft, origin, t }) {
  const line = `DELTAQ=${origin}\n${curlOf(call, draft)}`;
  const copy = async (/** @type {Event} */ { currentTarget }) => {
    const told = /** @type {HTMLElement} */ (/** @type {HTMLElement} */ (currentTarget).previousElementSibling);
    told.textContent = t((await toClipboard(line)) ? "trial.copied" : "trial.copy-by-hand");
  };
  return html`
    <section class="line"><h2>${t("trial.line")}</h2>
      <span class="hint" role="status"></span><button type="button" class="quiet" @click=${copy}>${t("trial.copy")}</button>
      <pre tabindex="0" role="region" aria-label=${t("trial.line")}><code>${line}</code></pre></section>`;
}

const SILENCE = {
  empty: "trial.empty",
  waiting: "trial.waiting",
  stopped: "trial.stopped",
  unreachable: "trial.unreachable",
};

/** @param {TrialView} view */
function answer({ coming, state, t }) {
  return html`
    <section class="answer ${coming.state}" aria-labelledby="answer"><h2 id="answer">${t("trial.answer")}</h2>
      <p class="outcome" role="status">${coming.state === "answered" ? outcome(coming.answer, state.place.lang, t) : t(SILENCE[coming.state])}</p>
      ${
        coming.state === "answered"
          ? html`
        <pre tabindex="0" role="region" aria-labelledby="answer"><code>${coming.answer.text}</code></pre>
        ${coming.answer.cut ? html`<p class="hint">${t("trial.cut", { count: coming.answer.cut })}</p>` : nothing}`
          : nothing
      }
    </section>`;
}

/** @param {import("../../model/trial.js").Answer} answer @param {string} lang @param {import("../../model/catalog.js").Translate} t */
const outcome = ({ status, milliseconds, bytes }, lang, t) =>
  html`<span class="status ${status < 400 ? "good" : "bad"}">${t("trial.status", {
    status,
    milliseconds: Math.round(milliseconds),
    size: (bytes / 1000).toLocaleString(lang, { maximumSignificantDigits: 3 }),
  })}</span>`;
