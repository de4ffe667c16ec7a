/** The newest substep is what is talked about: it is brought into sight and kept there until somebody scrolls. */

/** What people scroll with. */
const BY_HAND = ["wheel", "touchmove", "pointerdown"];

/** @param {HTMLElement} root  the page, with a slide or without */
export function createNewest(root) {
  /** The substep that was last brought into sight. @type {Element | null} */
  let newest = null;
  let left = false;

  /** @param {ScrollBehavior} behavior */
  const show = (behavior) => {
    if (!left) newest?.scrollIntoView({ block: "nearest", behavior });
  };
  // Fonts that come late, rows and a turned phone change where it stands; and a browser may give up a motion that is under way.
  const keep = () => show("instant");
  let height = 0;
  const grown = new ResizeObserver(([{ contentRect }]) => {
    if (height && contentRect.height !== height) keep();
    height = contentRect.height;
  });
  root.addEventListener("scrollend", keep, { capture: true });
  for (const kind of BY_HAND) root.addEventListener(kind, () => (left = true), { passive: true, capture: true });

  /** However one came to it; only the way from one to another is shown as a motion. */
  return () => {
    const last = root.querySelector(".slide .newest");
    if (last === newest) return;
    const behavior = newest ? "smooth" : "instant";
    [newest, left, height] = [last, false, 0];
    grown.disconnect();
    requestAnimationFrame(() => {
      show(behavior);
      const step = last?.closest(".step");
      if (step) grown.observe(step);
    });
  };
}
