/** Energy as bars that stand on zero: kinetic, potential, and what is kept of both. */

import { html, render } from "lit-html";
import { inline } from "../formula.js";

const KINDS = /** @type {const} */ ([
  ["kinetic", "E"],
  ["potential", "V"],
  ["balance", "E+V"],
]);

/** @param {import("./open.js").Bench} bench */
export function createEnergies({ frame, state, now }) {
  const box = document.createElement("div");
  box.className = "energies";
  box.setAttribute("aria-hidden", "true");
  let largest = 1;
  /** @type {HTMLElement[]} */
  let fills = [];
  /** @type {unknown} */
  let shownFor = null;

  return {
    show() {
      const { trajectory, place } = state();
      if (!place.with.includes("bars") || !trajectory?.energy || !trajectory.t.length) return box.remove();
      if (!box.isConnected) frame.append(box);
      if (shownFor === trajectory) return;
      shownFor = trajectory;
      const all = KINDS.flatMap(([key]) => trajectory.energy?.[key] ?? []).filter(Number.isFinite);
      const [low, high] = [Math.min(0, ...all), Math.max(0, ...all)];
      largest = high - low || 1;
      render(
        KINDS.map(
          ([key, latex]) => html`
        <span class="column energy-${key}"><span class="rail"><i class="zero" style="top:${(100 * high) / largest}%"></i><i class="fill" style="top:${(100 * high) / largest}%"></i></span>${inline(latex)}</span>`,
        ),
        box,
      );
      fills = [...box.querySelectorAll(".fill")].map((fill) => /** @type {HTMLElement} */ (fill));
    },
    move() {
      const energy = box.isConnected ? now()?.energy : null;
      if (!energy) return;
      fills.forEach((fill, i) => {
        fill.style.transform = `scaleY(${-energy[KINDS[i][0]] / largest})`;
      });
    },
  };
}
