/** The page of the general proof: its steps, like those of any derivation, without a scene beside them. */

import { html, nothing } from "lit-html";
import { failure } from "./failure.js";
import { actions, buttons } from "./header.js";
import { chapters, pager, steps } from "./steps.js";
import { titled, top } from "./top.js";

/**
 * @typedef {{state: import("../model/proof.js").Reading, session: import("../model/proof.js").Proof,
 *   link: (patch: Partial<import("../model/types.js").Place>) => string, follow: import("./page.js").View["follow"],
 *   t: import("../model/catalog.js").Translate, fullscreen: () => void, enterLecture: () => void,
 *   lecture: import("./lecture/open.js").Lecture | null, above: (view: ProofView) => unknown}} ProofView  lecture: while lecture mode is on
 */

/** @param {ProofView} view */
export function page(view) {
  const { t } = view;
  return html`
    ${top(view, { main: "derivation", here: "proof", heading: titled(t("place.proof"), t("proof.subtitle")), menu: actions(view), tools: buttons(view) })}
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
