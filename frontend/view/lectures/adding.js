/** "Add this place to my lecture": a button of every page that a lecture can stop at. */

import { html } from "lit-html";
import { icon } from "../icons.js";

/** Milliseconds that what was done is told. */
const TOLD = 6000;
let telling = 0;

/**
 * What is shown becomes a stop of the lecture that this browser keeps.
 * @param {string} title @param {import("../../model/catalog.js").Translate} t
 */
export async function add(title, t) {
  const part = await import("./append.js").catch(() => null);
  if (!part) return tell(t("adding.missed"), t);
  const number = part.append(title);
  tell(number ? t("adding.added", { number }) : t("adding.failed"), t);
}

/** Said aloud, and shown for a while with the way to the lecture. @param {string} words @param {import("../../model/catalog.js").Translate} t */
function tell(words, t) {
  document.querySelector(".added")?.remove();
  const note = document.createElement("p");
  const link = document.createElement("a");
  const { lang, dataset } = document.documentElement;
  link.href = `/lecture?lang=${lang}${dataset.theme === "projector" ? "&theme=projector" : ""}`;
  link.textContent = t("adding.open");
  note.className = "added";
  note.setAttribute("role", "status");
  note.append(`${words} `, link);
  document.body.append(note);
  clearTimeout(telling);
  telling = window.setTimeout(() => note.remove(), TOLD);
}

/** @param {() => string} titleOf @param {import("../../model/catalog.js").Translate} t */
export const addTool = (titleOf, t) => html`
  <button class="tool" title=${t("adding.add")} aria-label=${t("adding.add")} @click=${() => void add(titleOf(), t)}>${icon("add")}</button>`;

/** The same in the menu of a narrow page. @param {() => string} titleOf @param {import("../../model/catalog.js").Translate} t */
export const addEntry = (titleOf, t) => html`
  <button class="action" popovertarget="places" popovertargetaction="hide" @click=${() => void add(titleOf(), t)}>${t("adding.add")}</button>`;

/** What is shown, and of what. @param {...(string | undefined)} parts */
export const titleOfPlace = (...parts) => parts.filter(Boolean).join(" · ");
