/** Dragging a body or a point of the drawing: it sets the initial values, or δq while the variation is shown. */

import { html, render } from "lit-html";
import { nearest } from "../../model/kinematics/hand.js";
import { called } from "../../model/catalog.js";
import { createGrip } from "./grip.js";

/** @typedef {import("../../model/types.js").Pixel} Pixel */

/** Pixels within which a hand finds a place, and by which an arrow key moves it. */
const NEAR = 26;
const STRIDE = 8;
/** @type {Record<string, Pixel>} */
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

/** @param {import("./open.js").Bench} bench @param {import("./grip.js").Virtual} virtual */
export function createHand(bench, virtual) {
  const { frame, clock } = bench;
  const grip = createGrip(bench, virtual);
  const handles = document.createElement("div");
  handles.className = "handles";
  frame.append(handles);

  /** @param {PointerEvent} event @returns {Pixel} */
  const at = (event) => {
    const box = frame.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const placeAt = (/** @type {PointerEvent} */ event) => nearest(grip.places(), grip.where, at(event), NEAR);

  /** @param {KeyboardEvent} event @param {string} place */
  function press(event, place) {
    const arrow = ARROWS[event.key];
    if (!arrow) return;
    event.preventDefault();
    event.stopPropagation();
    const stride = event.shiftKey ? 1 : STRIDE;
    grip.nudge(place, [stride * arrow[0], stride * arrow[1]]);
  }

  frame.addEventListener("pointerdown", (event) => {
    const place = event.target instanceof Element && event.target.closest("button") ? "" : placeAt(event);
    if (!place || event.button) return;
    frame.setPointerCapture(event.pointerId);
    frame.classList.add("held");
    grip.take(place);
  });
  frame.addEventListener("pointermove", (event) => {
    if (grip.holds()) grip.lead(at(event));
    else frame.classList.toggle("near", !event.buttons && placeAt(event) !== "");
  });
  for (const end of ["pointerup", "pointercancel"]) {
    frame.addEventListener(end, () => {
      grip.release();
      frame.classList.remove("held");
    });
  }

  return {
    /** For those who use keys: a button at each place. @param {import("../page.js").View} view */
    handles({ state, t }) {
      const name = (/** @type {string} */ place) => called(state.scene?.labels, place, state.place.lang, t);
      render(
        grip.places().map(
          (
            place,
          ) => html`<button class="handle ${state.scene?.bodies.some((body) => body.name === place) ? `body-${place}` : ""}" data-place=${place} aria-label=${t("hand.handle", { place: name(place) })}
        @keydown=${(/** @type {KeyboardEvent} */ event) => press(event, place)}></button>`,
        ),
        handles,
      );
    },
    move() {
      grip.arrived();
      if (clock.playing && !handles.contains(document.activeElement)) return;
      for (const handle of handles.children) {
        const [x, y] = grip.where(/** @type {HTMLElement} */ (handle).dataset.place ?? "");
        /** @type {HTMLElement} */ (handle).style.transform = `translate(${x}px, ${y}px)`;
      }
    },
  };
}
