/** The help: for lecturers, students and programs; and the keys. */

import { html, nothing } from "lit-html";
import { keytable } from "../keytable.js";
import { titled, top } from "../top.js";
import { GUIDE } from "../../model/guide.js";
import { pageAddress } from "../../model/url.js";

/** @typedef {import("../header.js").Appearance} GuideView */

/** @param {GuideView} view */
export function page(view) {
  const { t } = view;
  return html`
    ${top(view, { main: "guide", here: "help", heading: titled(t("guide.title"), t("guide.subtitle")) })}
    <main class="reference guide" id="guide" tabindex="-1">
      <nav aria-label=${t("guide.parts")}><ul>${[...GUIDE.map(({ id }) => id), "keys"].map((id) => html`<li><a href=${`#${id}`}>${t(`guide.${id}`)}</a></li>`)}</ul></nav>
      <div class="calls">${GUIDE.map((part) => section(part, view))}
        <section id="keys"><h2>${t("guide.keys")}</h2><p class="lead">${t("guide.keys.lead")}</p>${keytable(t)}</section></div>
    </main>`;
}

/** @param {import("../../model/guide.js").Part} part @param {GuideView} view */
const section = ({ id, entries }, view) => html`
  <section id=${id}><h2>${view.t(`guide.${id}`)}</h2><p class="lead">${view.t(`guide.${id}.lead`)}</p>
    ${entries.map((entry) => article(`guide.${id}.${entry.id}`, entry.to, view))}</section>`;

/** @param {string} key @param {string | undefined} to @param {GuideView} view */
const article = (key, to, { t, state }) => html`
  <article><h3>${t(key)}</h3><p>${written(t(`${key}.text`))}
    ${to ? html`<a href=${pageAddress(to, state.place)} aria-label=${`${t(key)}: ${t(`place.${to}`)}`}>→ ${t(`place.${to}`)}</a>` : nothing}</p></article>`;

/** Keys and code stand between backticks. @param {string} text */
const written = (text) => text.split("`").map((part, i) => (i % 2 ? html`<code>${part}</code>` : part));
