/** The API to be read: calls by subject. Calls and fields are described in English, as the API describes itself. */

import { html, nothing } from "lit-html";
import { failure } from "../failure.js";
import { toClipboard } from "../files.js";
import { titled, top } from "../top.js";
import { pageAddress } from "../../model/url.js";

/** @typedef {import("../../model/reference.js").Call} Call */
/**
 * @typedef {import("../header.js").Appearance & {groups: import("../../model/reference.js").Group[], version: string,
 *   failure: import("../../model/types.js").Failure | null, reload: () => void, sample: string, choose: (sample: string) => void}} ReferenceView
 */

const TRIAL = "docs/try";

/** @param {ReferenceView} view */
export function page(view) {
  const { groups, t } = view;
  return html`
    ${top(view, { main: "reference", here: "docs", heading: titled(t("place.docs"), t("reference.subtitle", { version: view.version })) })}
    <main class="reference" id="reference" tabindex="-1">
      ${view.failure ? failure(view.failure, t("failure.page"), view.reload, t) : nothing}
      <nav aria-label=${t("reference.subjects")}><ul>${groups.map(({ subject }) => html`<li><a href=${`#${subject}`}>${titleOf(subject, t)}</a></li>`)}</ul>
        <p><a href=${pageAddress(TRIAL, view.state.place)}>${t("reference.try")}</a></p><p><a href="/api/v1/openapi.json">${t("reference.openapi")}</a></p><p><a href=${pageAddress("problems", view.state.place)}>${t("place.problems")}</a></p></nav>
      <div class="calls">
        <p>${described(t("reference.lead"))}</p><p>${t("reference.english")}</p>
        ${languages(view)}
        ${groups.map(({ subject, text, calls }) => html`<section id=${subject}><h2>${titleOf(subject, t)}</h2><p>${told(`reference.about.${subject}`, text, t)}</p>${calls.map((call) => article(call, view))}</section>`)}
      </div>
    </main>`;
}

/** What the catalog says, else what the API says of itself. @param {string} key @param {string} otherwise @param {ReferenceView["t"]} t */
const told = (key, otherwise, t) => (t(key) === key ? otherwise : t(key));

/** @param {string} subject @param {ReferenceView["t"]} t */
const titleOf = (subject, t) => told(`reference.subject.${subject}`, subject, t);

/** In which language the samples are. @param {ReferenceView} view */
function languages({ groups, sample, choose, t }) {
  const known = groups.flatMap(({ calls }) => calls)[0]?.samples ?? [];
  return html`<div class="segments" role="group" aria-label=${t("reference.samples")}>${known.map(
    ({ lang }) => html`
    <button type="button" aria-pressed=${lang === sample} @click=${() => choose(lang)}>${lang}</button>`,
  )}</div>`;
}

/** Names stand between backticks. @param {string} text */
const described = (text) => text.split("`").map((part, i) => (i % 2 ? html`<code>${part}</code>` : part));

/** A sample goes to the clipboard, and beside the button it is said. @param {string} source @param {string} call @param {string} lang @param {ReferenceView["t"]} t */
function copying(source, call, lang, t) {
  const copy = async (/** @type {Event} */ { currentTarget }) => {
    const told = /** @type {HTMLElement} */ (/** @type {HTMLElement} */ (currentTarget).nextElementSibling);
    told.textContent = t((await toClipboard(source)) ? "trial.copied" : "trial.copy-by-hand");
  };
  return html`<button type="button" class="quiet small" lang=${lang} aria-label=${`${t("trial.copy")}: ${call}`} @click=${copy}>${t("trial.copy")}</button><small role="status"></small>`;
}

/** @param {Call} call @param {ReferenceView} view */
function article({ id, method, path, text, fields, samples, answers }, { t, state, sample }) {
  const written = samples.filter(({ lang }) => lang === sample);
  return html`
    <article id=${id} lang="en">
      <h3><span class="method">${method}</span> <code>${path}</code>
        <a class="try" lang=${state.place.lang} href=${`${pageAddress(TRIAL, state.place)}#${id}`} aria-label=${`${t("trial.try")}: ${method} ${path}`}>${t("trial.try")}</a>
        ${written.map(({ source }) => copying(source, `${method} ${path}`, state.place.lang, t))}</h3>
      <p>${described(text)}</p>
      ${
        fields.length
          ? html`
        <dl>${fields.map(
          ({ name, kind, text: meaning, required }) => html`
          <div><dt><code>${name}</code>${required ? html` <span lang=${state.place.lang}>${t("reference.required")}</span>` : nothing}</dt>
            <dd><span class="kind">${kind}</span> ${meaning}</dd></div>`,
        )}</dl>`
          : nothing
      }
      ${written.map(({ lang, source }) => html`<pre tabindex="0" aria-label=${lang}><code>${source}</code></pre>`)}
      <p class="answers">${answers.map(({ status, text: meaning }) => html`<span><b>${status}</b> ${meaning}</span>`)}</p>
    </article>`;
}
