/** The page of the general proof: its steps, like those of any derivation, without a scene beside them. */

import { html, nothing } from "lit-html";
import { failure } from "./failure.js";
import { appearance, brand, language, places } from "./header.js";
import { icon } from "./icons.js";
import { overlays } from "./overlays.js";
import { chapters, pager, steps } from "./steps.js";

/**
 * @typedef {{state: import("../model/proof.js").Reading, session: import("../model/proof.js").Proof,
 *   link: (patch: {step: string}) => string, follow: import("./page.js").View["follow"],
 *   t: import("../model/catalog.js").Translate, fullscreen: () => void}} ProofView
 */

/** @param {ProofView} view */
export function page(view) {
  const { state, session, t } = view;
  return html`
    <a class="skip" href="#derivation">${t("skip")}</a>
    <header class="top">
      ${brand(view)}
      <div class="scene"><h1>${t("place.proof")}</h1><p class="summary">${t("proof.subtitle")}</p></div>
      ${places(view, "proof")}
      <div class="tools">
        ${language(view)}${appearance(view)}
        <button class="tool" title=${t("tool.overview")} aria-label=${t("tool.overview")} @click=${() => session.overlay("overview")}>${icon("overview")}</button>
        <button class="tool wide-only" title=${t("tool.fullscreen")} aria-label=${t("tool.fullscreen")} @click=${view.fullscreen}>${icon("fullscreen")}</button>
        <button class="tool wide-only" title=${t("tool.help")} aria-label=${t("tool.help")} @click=${() => session.overlay("help")}>${icon("help")}</button>
      </div>
    </header>
    <main class="derivation proof" id="derivation">
      ${chapters(view)}
      <div class="scroll" tabindex="0" role="region" aria-label=${t("place.proof")}>
        ${state.failure ? failure(state.failure, t("failure.derivation"), () => void session.load(), t) : steps(view)}
      </div>
      ${state.failure ? nothing : pager(view)}
    </main>
    ${overlays(view)}`;
}
