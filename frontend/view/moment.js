/** The moment over the plots: a cursor that follows the clock, and a hand that leads it. */

import { fixed } from "../model/numbers.js";
import { timeScale } from "../model/plots.js";

/** What has a meaning of its own: buttons on the plots, and Shift for a part of the time. @param {PointerEvent} event */
const isElsewhere = ({ target, shiftKey }) =>
  shiftKey || (target instanceof Element && target.closest("button, .plot-tools"));

/**
 * @param {HTMLElement} root  holds .cursor and .ghost
 * @param {{seek: (t: number) => void, lang: () => string}} about  the language of what is shown, "" while nothing is
 */
export function createMoment(root, { seek, lang }) {
  const [cursor, ghost] = ["cursor", "ghost"].map(
    (name) => /** @type {HTMLElement} */ (root.querySelector(`.${name}`)),
  );
  let scale = timeScale(1, 0, 16);
  let now = 0;
  let pointed = NaN;

  /** On whole pixels of the screen: there it is sharp, and most frames of a long motion have nothing to move. */
  function point() {
    const x = Math.round(scale.pixel(now) * devicePixelRatio) / devicePixelRatio;
    if (x === pointed) return;
    cursor.style.transform = `translateX(${x}px)`;
    cursor.hidden = !scale.holds(now);
    pointed = x;
  }

  const xOf = (/** @type {PointerEvent} */ event) => event.clientX - root.getBoundingClientRect().left;
  root.addEventListener("pointerdown", (event) => {
    if (isElsewhere(event)) return;
    root.setPointerCapture(event.pointerId);
    seek(scale.time(xOf(event)));
  });
  root.addEventListener("pointermove", (event) => {
    const shown = lang();
    ghost.style.transform = `translateX(${xOf(event)}px)`;
    ghost.hidden = event.pointerType !== "mouse" || !shown || Boolean(isElsewhere(event));
    ghost.textContent = shown ? `${fixed(scale.time(xOf(event)), 2, shown)} s` : "";
    if (event.buttons & 1 && root.hasPointerCapture(event.pointerId) && !event.shiftKey) seek(scale.time(xOf(event)));
  });
  root.addEventListener("pointerleave", () => (ghost.hidden = true));

  return {
    /** @param {ReturnType<typeof timeScale>} drawn */
    fit(drawn) {
      scale = drawn;
      pointed = NaN;
      point();
    },
    /** @param {number} t */
    move(t) {
      now = t;
      point();
    },
  };
}
