/** The keys, each with what it does. */

import { html } from "lit-html";
import { KEYS, labelOf } from "../model/keys.js";

/** @param {import("../model/catalog.js").Translate} t */
export const keytable = (t) =>
  html`<dl class="keys">${KEYS.map(
    ([names, meaning]) => html`
  <div><dt>${names.map((name) => html`<kbd>${labelOf(name, t)}</kbd>`)}</dt><dd>${t(meaning)}</dd></div>`,
  )}</dl>`;
