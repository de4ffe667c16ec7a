/** What lies above the page: overview, jump, help, the black screen. */

import { html, nothing } from "lit-html";
import { prose } from "./formula.js";
import { icon } from "./icons.js";
import { keytable } from "./keytable.js";
import { meant } from "../model/lecture/stops.js";
import { pageAddress } from "../model/url.js";

/** @typedef {import("./steps.js").View & {state: Pick<import("./page.js").View["state"], "overlay">,
 *   session: Pick<import("./page.js").View["session"], "overlay">}} View  what overlays need of a page */

/** Opens a dialog that has just been put into the page; it takes the focus. @param {HTMLElement} root */
export function openDialog(root) {
  /** @type {HTMLDialogElement | null} */ (root.querySelector("dialog:not([open])"))?.showModal();
}

/** @param {View} view */
export function overlays(view) {
  const { overlay } = view.state;
  if (overlay === "black") return html`<div class="black" @click=${() => view.session.overlay("")}></div>`;
  if (overlay === "overview") return dialog("overview", overview(view), view);
  if (overlay === "jump") return dialog("jump", jump(view), view);
  if (overlay === "help") return dialog("help", help(view), view);
  return nothing;
}

/** @param {"overview" | "jump" | "help" | "share"} name @param {unknown} content @param {View} view */
export function dialog(name, content, { session, t }) {
  const close = () => session.overlay("");
  return html`
    <dialog class=${name} aria-label=${t(name)} @close=${close}
      @click=${(/** @type {Event} */ e) => e.target === e.currentTarget && close()}>
      <div class="heading"><h2>${t(name)}</h2>
        <button class="tool" aria-label=${t("close")} title=${t("close")} @click=${close}>${icon("close")}</button></div>
      ${content}
    </dialog>
  `;
}

/** @param {View} view */
function overview({ state, session, link, follow }) {
  return html`
    <div class="grid">
      ${(state.derivation?.chapters ?? []).map(
        (chapter, c) => html`
        <section>
          <h3><span class="ordinal">${c + 1}</span>${chapter.title}</h3>
          <ol>${chapter.steps.map(
            (step, s) => html`
            <li><a href=${link({ step: step.id })} aria-current=${step.id === state.place.step ? "step" : nothing}
              @click=${(/** @type {Event} */ e) => follow(e, () => session.goTo(step.id))}>
              <span class="number">${c + 1}.${s + 1}</span><span>${prose(step.title)}</span></a></li>`,
          )}</ol>
        </section>`,
      )}
    </div>
  `;
}

/** Steps by number or by a word of their title; Enter takes the first. @param {View} view */
function jump({ state, session, link, follow, t }) {
  const sought = (/** @type {Event} */ { target }) => {
    const field = /** @type {HTMLInputElement} */ (target);
    const found = new Set(meant(state.lines, field.value).map((line) => line.step.id));
    const list = /** @type {HTMLElement} */ (field.form);
    for (const entry of list.querySelectorAll("li")) entry.hidden = !found.has(entry.dataset.to ?? "");
    /** @type {HTMLElement} */ (list.querySelector(".none")).hidden = found.size > 0;
  };
  const take = (/** @type {Event} */ event) => {
    event.preventDefault();
    const first = /** @type {HTMLElement | null} */ (
      /** @type {HTMLElement} */ (event.target).querySelector("li:not([hidden])")
    );
    if (first) session.goTo(first.dataset.to ?? "");
  };
  return html`
    <form class="jump" @submit=${take}>
      <label>${t("jump.label")}<input type="search" autocomplete="off" autofocus @input=${sought}></label>
      <ol>${state.lines.map(
        ({ step, number }) => html`
        <li data-to=${step.id}><a href=${link({ step: step.id })} @click=${(/** @type {Event} */ e) => follow(e, () => session.goTo(step.id))}>
          <span class="number">${number}</span><span>${prose(step.title)}</span></a></li>`,
      )}</ol>
      <p class="none" role="status" hidden>${t("jump.none")}</p>
    </form>`;
}

/** @param {View} view */
function help({ state, t }) {
  return html`${keytable(t)}<p><a href=${pageAddress("help", state.place)}>${t("place.help")}</a></p>`;
}
