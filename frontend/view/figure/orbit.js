/** Turning space: by a hand that drags where it holds nothing, by arrow keys while the drawing has the focus; Home turns back. */

import { FRONT, turned } from "../../model/drawing/camera.js";

/** @typedef {import("../../model/types.js").Pixel} Pixel */

/** Pixels of a hand that a key stands for. */
const STRIDE = 12;
/** @type {Record<string, Pixel>} */
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

/** @param {import("./open.js").Bench} bench @param {() => void} follow  what else stands in space */
export function createOrbit({ frame, parts: { drawing }, state, clock }, follow) {
  /** @type {Pixel | null} */
  let from = null;
  let due = 0;
  const inSpace = () => state().scene?.dimension === 3;

  /** Not more often than the screen shows it. @param {import("../../model/drawing/camera.js").Camera} camera */
  function see(camera) {
    drawing.see(camera);
    due ||= requestAnimationFrame(() => {
      due = 0;
      drawing.draw(clock.time);
      follow();
    });
  }

  frame.addEventListener("pointerdown", (event) => {
    const isFree =
      !frame.classList.contains("held") && !(event.target instanceof Element && event.target.closest("button, a"));
    if (!inSpace() || event.button || !isFree) return;
    frame.setPointerCapture(event.pointerId);
    from = [event.clientX, event.clientY];
    frame.classList.add("turning");
  });
  frame.addEventListener("pointermove", ({ clientX, clientY }) => {
    if (!from) return;
    see(turned(drawing.camera, [clientX - from[0], clientY - from[1]]));
    from = [clientX, clientY];
  });
  for (const end of ["pointerup", "pointercancel"])
    frame.addEventListener(end, () => {
      from = null;
      frame.classList.remove("turning");
    });
  frame.addEventListener("dblclick", () => inSpace() && see(FRONT));
  frame.addEventListener("keydown", (event) => {
    const arrow = ARROWS[event.key];
    if (!inSpace() || event.target !== frame || !(arrow || event.key === "Home")) return;
    event.preventDefault();
    event.stopPropagation();
    see(arrow ? turned(drawing.camera, [STRIDE * arrow[0], STRIDE * arrow[1]]) : FRONT);
  });

  return {
    /** Who uses keys can reach space, and is told how it turns. @param {import("../page.js").View["t"]} t */
    show(t) {
      frame.classList.toggle("space", inSpace());
      if (!inSpace()) return ["tabindex", "role", "aria-label"].forEach((name) => frame.removeAttribute(name));
      frame.tabIndex = 0;
      frame.setAttribute("role", "group");
      frame.setAttribute("aria-label", t("hand.turn"));
    },
  };
}
