/** Bringing the current step before the reader's eyes and ears. */

import { indexOf } from "../model/reveal.js";

/** @param {HTMLElement} root @param {string} id */
const stepElement = (root, id) => root.querySelector(`[data-step="${CSS.escape(id)}"]`);

/** Scrolls the line of chapters, and nothing else, so that the current one is seen. @param {HTMLElement} root */
function reachChapter(root) {
  const line = root.querySelector(".chapters");
  const current = /** @type {HTMLElement | null} */ (line?.querySelector("[aria-current]"));
  if (line && current) line.scrollLeft = current.offsetLeft - (line.clientWidth - current.offsetWidth) / 2;
}

/** @param {HTMLElement} root */
export function createReach(root) {
  let reached = "";
  let steps = 0;
  // Full screen, a turned phone, or a formula that comes late must not lose the step that is being read.
  const keep = () => requestAnimationFrame(() => stepElement(root, reached)?.scrollIntoView({ block: "nearest" }));
  window.addEventListener("resize", keep);
  document.addEventListener("fullscreenchange", keep);
  root.addEventListener("grown", keep);

  /**
   * Scrolls a step into view when it has become the current one.
   * Only the way to a neighbour is shown as a motion; further ones would take too long.
   * @param {string} id @param {boolean} still without motion
   * @returns {boolean} whether it is new
   */
  return (id, still) => {
    const element = stepElement(root, id);
    if (!element) reached = "";
    if (!element || reached === id) return false;
    const shown = root.querySelectorAll(".step").length;
    const behavior = Math.abs(shown - steps) === 1 && !still ? "smooth" : "instant";
    steps = shown;
    reached = id;
    requestAnimationFrame(() => {
      element.scrollIntoView({ block: "nearest", behavior });
      reachChapter(root);
    });
    return true;
  };
}

/**
 * @param {readonly import("../model/reveal.js").Line[]} lines @param {string} id
 * @param {import("../model/catalog.js").Translate} t
 */
export function announce(lines, id, t) {
  const line = lines[indexOf(lines, id)];
  const announcer = document.getElementById("announcer");
  if (!line || !announcer) return;
  announcer.textContent = t("step.announce", { number: line.number, said: line.step.announced ?? "" });
}

/** Opens or closes the substeps of a step. @param {HTMLElement} root @param {string} id */
export function toggleSubsteps(root, id) {
  const details = stepElement(root, id)?.querySelector("details");
  if (details) details.open = !details.open;
}
