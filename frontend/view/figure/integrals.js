/** Under the steps about integrals of motion: what their symmetry moves, in the drawing, and steady motions to be opened. */

import { html, nothing } from "lit-html";
import { icon } from "../icons.js";
import { writeChoice } from "../../model/virtual/choice.js";
import { shiftedBy, variationBy } from "../../model/virtual/symmetry.js";
import { UNCHANGED } from "../../model/values.js";

/** @typedef {import("../page.js").View} View */
/** @typedef {import("../../model/types.js").Step} Step */
/** @typedef {import("./open.js").Bench} Bench */

/** @param {Bench} bench */
export function createIntegrals({ state, session, clock, now }) {
  /** @param {NonNullable<ReturnType<typeof shiftedBy>>} integral */
  function show(integral) {
    const { scene, changes } = state();
    const here = now();
    if (!scene || !here) return;
    const guided = new Set((scene.guides ?? []).map(({ coordinate }) => coordinate));
    const parameters = Object.fromEntries(scene.parameters.map(({ name, value }) => [name, value]));
    const values = { ...parameters, ...changes.parameters, ...here.coordinates, t: here.t || 1 };
    const free = scene.coordinates.filter(({ name }) => !guided.has(name));
    clock.play(false);
    session.move({ vary: writeChoice(variationBy(integral, free, values)) });
  }

  /** @param {Step} step */
  const motionOf = (step) => state().derivation?.result?.relative_equilibria.find((each) => each.step === step.id);

  /** With the scene's own parameters, for which the rate was computed. @param {NonNullable<ReturnType<typeof motionOf>>} motion */
  function begin(motion) {
    session.move({ vary: "" });
    session.change({ ...UNCHANGED, initial: motion.initial });
    clock.seek(0);
    clock.play(true);
  }

  /** @param {Pick<View, "t">} view */
  return ({ t }) => ({
    /** @param {Step} step */
    actions(step) {
      const integral = shiftedBy(state().derivation?.result, step.id);
      const motion = motionOf(step);
      if (!integral && !motion) return nothing;
      return html`<p class="actions">
        ${integral ? html`<button class="quiet small" @click=${() => show(integral)}>${t("integral.show")}</button>` : nothing}
        ${motion ? html`<button class="quiet small" @click=${() => begin(motion)}>${icon("play")}<span>${t("steady.open")}</span></button>` : nothing}
      </p>`;
    },
  });
}
