/** A stop in the hand: it follows the pointer, and a line shows where it would come to stand. */

/** @param {Element} element */
function middle(element) {
  const { top, height } = element.getBoundingClientRect();
  return top + height / 2;
}

/** @param {Element} list @param {HTMLElement | null} marked @param {"before" | "after"} [side] */
function mark(list, marked, side = "before") {
  for (const one of list.querySelectorAll("[data-drop]")) one.removeAttribute("data-drop");
  marked?.setAttribute("data-drop", side);
}

/** Begins where the number of a stop is pressed. @param {PointerEvent} event @param {(place: number) => void} drop */
export function drag(event, drop) {
  const stop = /** @type {HTMLElement} */ (event.currentTarget);
  const list = stop.parentElement;
  if (!list || event.button !== 0 || !(event.target instanceof Element) || !event.target.closest(".grip")) return;
  event.preventDefault();
  stop.setPointerCapture(event.pointerId);
  const ended = new AbortController();
  const { signal } = ended;
  const others = /** @type {HTMLElement[]} */ ([...list.children].filter((one) => one !== stop));
  /** @type {number | null} */
  let place = null;

  /** @param {PointerEvent} moved */
  function move({ clientY }) {
    if (place === null && Math.abs(clientY - event.clientY) < 4) return;
    stop.classList.add("in-hand");
    stop.style.translate = `0 ${clientY - event.clientY}px`;
    place = others.filter((one) => middle(one) < clientY).length;
    if (place < others.length) mark(/** @type {Element} */ (list), others[place]);
    else mark(/** @type {Element} */ (list), others[place - 1] ?? null, "after");
  }

  /** @param {boolean} kept */
  function end(kept) {
    ended.abort();
    stop.classList.remove("in-hand");
    stop.style.translate = "";
    mark(/** @type {Element} */ (list), null);
    if (kept && place !== null) drop(place);
  }

  stop.addEventListener("pointermove", move, { signal });
  stop.addEventListener("pointerup", () => end(true), { signal });
  stop.addEventListener("pointercancel", () => end(false), { signal });
  addEventListener("keydown", ({ key }) => key === "Escape" && end(false), { signal });
}
