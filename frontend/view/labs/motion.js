/** A motion that a chart points at, played below it: a point of a map, or a method at the step where it fails. */

import { html, nothing } from "lit-html";
import { createClock } from "../../model/clock.js";
import { endOf } from "../../model/trajectory.js";
import { createDrawing } from "../drawing.js";

/** @param {import("./page.js").View} view */
export function motion({ play, t }) {
  if (!play) return nothing;
  return html`
    <section class="motion" aria-label=${t("labs.motion")}>
      <h2>${play.title} ${play.address ? html`<a class="open" href=${play.address}>${t("labs.open-scene")}</a>` : nothing}</h2>
      <div class="drawing"><svg role="img" aria-label=${play.title}></svg><div class="labels" aria-hidden="true"></div></div>
      ${play.status ? html`<p class="note" role="status">${play.status}</p>` : nothing}
    </section>`;
}

/** The moving drawing; it finds its frame when there is one. @param {HTMLElement} root @param {() => boolean} still */
export function createMotion(root, still) {
  const clock = createClock();
  /** @type {{frame: HTMLElement, drawing: ReturnType<typeof createDrawing>} | null} */
  let stage = null;
  /** @type {{scene: import("../../model/types.js").Scene, trajectory: import("../../model/types.js").Trajectory} | null} */
  let shown = null;

  function arrange() {
    const frame = /** @type {HTMLElement | null} */ (root.querySelector(".motion .drawing"));
    if (!frame || frame === stage?.frame) return;
    const drawing = createDrawing(frame);
    stage = { frame, drawing };
    new ResizeObserver(() => drawing.resize(clock.time)).observe(frame);
  }

  clock.subscribe((t) => stage?.drawing.draw(t));
  return {
    /** After each rendering: the frame may be new. */
    arrange() {
      arrange();
      if (shown) stage?.drawing.show(shown.scene, shown.trajectory, clock.time);
    },
    /** @param {import("../../model/types.js").Scene} scene @param {import("../../model/types.js").Trajectory} trajectory */
    begin(scene, trajectory) {
      shown = { scene, trajectory };
      arrange();
      clock.setEnd(endOf(trajectory));
      clock.seek(0);
      stage?.drawing.show(scene, trajectory, 0);
      clock.play(!still());
      stage?.frame.scrollIntoView({ block: "nearest", behavior: still() ? "auto" : "smooth" });
    },
    /** @param {number} seconds */
    advance: (seconds) => clock.advance(seconds),
  };
}
