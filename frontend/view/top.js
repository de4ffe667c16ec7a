/** The top of a page: the way past it, where one is, the ways to other pages, and what every page has. */

import { html, nothing } from "lit-html";
import { appearance, brand, language, places } from "./header.js";

/** @param {string} title @param {string} summary */
export const titled = (title, summary) =>
  html`<div class="scene"><h1>${title}</h1><p class="summary">${summary}</p></div>`;

/**
 * @param {import("./header.js").Appearance} view
 * @param {{main: string, skip?: string, here?: string, heading?: unknown, menu?: unknown, tools?: unknown}} page
 *   `main` is the id of what the page is about; `skip` the text of the way there; `menu` and `tools` are its own besides
 */
export function top(
  view,
  { main, skip = view.t("skip.content"), here = "", heading = nothing, menu = nothing, tools = nothing },
) {
  return html`
    <a class="skip" href=${`#${main}`}>${skip}</a>
    <header class="top">
      ${brand(view)}${heading}${places(view, here, menu)}<div class="tools">${language(view)}${appearance(view)}${tools}</div>
    </header>`;
}
