/** The small drawings: each is made when it comes into sight, and moves while it is pointed at; the large one always does. */

import { createDrawing } from "../drawing.js";
import { endOf } from "../../model/trajectory.js";

/** @typedef {import("../../model/start/sample.js").Sample} Sample */
/** @typedef {{draw: (t: number) => void, end: number, time: number}} Motion */

/**
 * @param {(id: string) => Promise<Sample | null>} ask
 * @param {{still: () => boolean, always: string}} options  the scene that always moves, unless the viewer prefers rest
 */
export function createMotions(ask, { still, always }) {
  /** @type {Map<Element, Motion>} */
  const motions = new Map();
  /** @type {Set<Element>} */
  const met = new Set();
  /** @type {Element | null} */
  let pointed = null;

  /** @param {HTMLElement} frame */
  async function begin(frame) {
    const sample = await ask(frame.dataset.scene ?? "");
    frame.classList.remove("waiting");
    if (!sample) return frame.classList.add("absent");
    const drawing = createDrawing(frame);
    const motion = { draw: drawing.draw, end: endOf(sample.trajectory), time: 0 };
    drawing.show(sample.scene, sample.trajectory, 0);
    new ResizeObserver(() => drawing.resize(motion.time)).observe(frame);
    motions.set(frame, motion);
  }

  const seen = new IntersectionObserver(
    (entries) =>
      entries
        .filter((entry) => entry.isIntersecting)
        .forEach(({ target }) => {
          seen.unobserve(target);
          void begin(/** @type {HTMLElement} */ (target));
        }),
    { rootMargin: "100px" },
  );

  return {
    /** Watches the frames that are there now. @param {ParentNode} root */
    watch(root) {
      for (const frame of root.querySelectorAll("[data-scene]")) {
        if (met.has(frame)) continue;
        met.add(frame);
        seen.observe(frame);
      }
    },
    /** @param {EventTarget | null} target */
    point(target) {
      pointed = target instanceof Element ? (target.closest("a")?.querySelector("[data-scene]") ?? null) : null;
    },
    /** @param {number} seconds since the last call */
    advance(seconds) {
      if (still()) return;
      for (const [frame, motion] of motions) {
        if (frame !== pointed && /** @type {HTMLElement} */ (frame).dataset.scene !== always) continue;
        motion.time = (motion.time + Math.min(seconds, 0.1)) % (motion.end || 1);
        motion.draw(motion.time);
      }
    },
  };
}
