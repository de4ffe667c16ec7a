/** The pointer made large, for those who sit far away: a spot that follows it and leaves the rest a little darker. */

/** @param {HTMLElement} root */
export function createSpot(root) {
  const spot = document.createElement("div");
  spot.className = "spot";
  spot.hidden = true;
  spot.setAttribute("aria-hidden", "true");
  root.after(spot);

  const follow = (/** @type {PointerEvent} */ { clientX, clientY }) => {
    spot.style.setProperty("--x", `${clientX}px`);
    spot.style.setProperty("--y", `${clientY}px`);
  };
  window.addEventListener("pointermove", follow);

  return {
    get on() {
      return !spot.hidden;
    },
    toggle() {
      spot.hidden = !spot.hidden;
    },
    off() {
      spot.hidden = true;
    },
  };
}
