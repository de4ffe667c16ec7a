/** What lies above the page: overview, help, the black screen. */

import { html, nothing } from "lit-html";
import { prose } from "./formula.js";
import { icon } from "./icons.js";

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
  if (overlay === "help") return dialog("help", help(view), view);
  return nothing;
}

/** @param {"overview" | "help"} name @param {unknown} content @param {View} view */
function dialog(name, content, { session, t }) {
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
      ${(state.derivation?.chapters ?? []).map((chapter, c) => html`
        <section>
          <h3><span class="ordinal">${c + 1}</span>${chapter.title}</h3>
          <ol>${chapter.steps.map((step, s) => html`
            <li><a href=${link({ step: step.id })} aria-current=${step.id === state.place.step ? "step" : nothing}
              @click=${(/** @type {Event} */ e) => follow(e, () => session.goTo(step.id))}>
              <span class="number">${c + 1}.${s + 1}</span><span>${prose(step.title)}</span></a></li>`)}</ol>
        </section>`)}
    </div>
  `;
}

const KEYS = [
  ["→ N Space PageDown", "help.next"],
  ["← P PageUp", "help.previous"],
  ["Home End", "help.ends"],
  ["E", "help.substeps"],
  ["K", "help.play"],
  ["F", "help.fullscreen"],
  ["B .", "help.black"],
  ["Esc O", "help.overview"],
  ["?", "help.help"],
];

/** @param {View} view */
function help({ t }) {
  return html`<dl class="keys">${KEYS.map(([keys, meaning]) => html`
    <div><dt>${keys.split(" ").map((key) => html`<kbd>${key}</kbd>`)}</dt><dd>${t(meaning)}</dd></div>`)}</dl>`;
}
