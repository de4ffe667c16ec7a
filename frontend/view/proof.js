/** The page of the general proof: its steps, like those of any derivation, without a scene beside them. */

import { html, nothing } from "lit-html";
import { failure } from "./failure.js";
import { actions, appearance, brand, language, places } from "./header.js";
import { icon } from "./icons.js";
import { chapters, pager, steps } from "./steps.js";

/**
 * @typedef {{state: import("../model/proof.js").Reading, session: import("../model/proof.js").Proof,
 *   link: (patch: Partial<import("../model/types.js").Place>) => string, follow: import("./page.js").View["follow"],
 *   t: import("../model/catalog.js").Translate, fullscreen: () => void, enterLecture: () => void,
 *   lecture: import("./lecture/open.js").Lecture | null, above: (view: ProofView) => unknown}} ProofView  lecture: while lecture mode is on
 */

/** @param {ProofView} view */
export function page(view) {
  const { session, t } = view;
  return html`
    <a class="skip" href="#derivation">${t("skip")}</a>
    <header class="top">
      ${brand(view)}
      <div class="scene"><h1>${t("place.proof")}</h1><p class="summary">${t("proof.subtitle")}</p></div>
      ${places(view, "proof", actions(view))}
      <div class="tools">
        ${language(view)}${appearance(view)}
        <button class="tool" title=${t("tool.share")} aria-label=${t("tool.share")} @click=${() => session.overlay("share")}>${icon("share")}</button>
        <button class="tool" title=${t("tool.overview")} aria-label=${t("tool.overview")} @click=${() => session.overlay("overview")}>${icon("overview")}</button>
        <button class="tool wide-only" title=${t("tool.lecture")} aria-label=${t("tool.lecture")} @click=${view.enterLecture}>${icon("lecture")}</button>
        <button class="tool wide-only" title=${t("tool.help")} aria-label=${t("tool.help")} @click=${() => session.overlay("help")}>${icon("help")}</button>
      </div>
    </header>
    ${view.lecture ? html`<main class="desk" data-view="lecture" data-beside="nothing">${view.lecture.slide(view)}</main>` : reading(view)}
    ${view.above(view)}`;
}

/** @param {ProofView} view */
function reading(view) {
  const { state, session, t } = view;
  return html`
    <main class="derivation proof" id="derivation">
      ${chapters(view)}
      <div class="scroll" tabindex="0" role="region" aria-label=${t("place.proof")}>
        ${state.failure ? failure(state.failure, t("failure.derivation"), () => void session.load(), t) : steps(view)}
      </div>
      ${state.failure ? nothing : pager(view)}
    </main>`;
}
