/** A block in the hand: it follows the pointer, and a line shows where it would come to stand. */

/** @typedef {(place: number | null) => void} Drop  at a place among the blocks in order, or left out */
/** @typedef {{place: number | null, marked: HTMLElement, side: "before" | "after" | "in"}} Target */

/** @param {Element} list @param {HTMLElement} block */
const others = (list, block) =>
  /** @type {HTMLElement[]} */ ([...list.querySelectorAll(".block")].filter((one) => one !== block));

/** What the pointer is over. @param {HTMLElement} root @param {HTMLElement} block @param {number} y @returns {Target} */
function targetAt(root, block, y) {
  const [order, left] = /** @type {HTMLElement[]} */ ([...root.querySelectorAll(".blocks")]);
  const blocks = others(order, block);
  const inOrder = y < left.getBoundingClientRect().top;
  if (!inOrder || !blocks.length) return { place: inOrder ? 0 : null, marked: inOrder ? order : left, side: "in" };
  const place = blocks.filter((one) => middle(one) < y).length;
  return place < blocks.length
    ? { place, marked: blocks[place], side: "before" }
    : { place, marked: blocks[place - 1], side: "after" };
}

/** @param {Element} element */
function middle(element) {
  const { top, height } = element.getBoundingClientRect();
  return top + height / 2;
}

/** @param {HTMLElement} root @param {Target | null} target */
function mark(root, target) {
  for (const one of root.querySelectorAll("[data-drop]")) one.removeAttribute("data-drop");
  target?.marked.setAttribute("data-drop", target.side);
}

/** A finger takes a block by its grip, so that it can scroll elsewhere; a mouse takes it anywhere but at its buttons. @param {PointerEvent} event */
function takes({ target, pointerType, button }) {
  if (button !== 0 || !(target instanceof Element)) return false;
  return pointerType === "mouse" ? !target.closest("button") : Boolean(target.closest(".grip"));
}

/** Begins where a block is pressed. @param {PointerEvent} event @param {Drop} drop */
export function drag(event, drop) {
  const block = /** @type {HTMLElement} */ (event.currentTarget);
  const root = /** @type {HTMLElement | null} */ (block.closest(".ordering"));
  if (!root || !takes(event)) return;
  event.preventDefault();
  block.setPointerCapture(event.pointerId);
  const grabbed = event.clientY - block.getBoundingClientRect().top;
  const ended = new AbortController();
  let [shift, last] = [0, event.clientY];
  /** @type {Target | null} */
  let target = null;

  function follow() {
    shift += last - grabbed - block.getBoundingClientRect().top;
    block.style.translate = `0 ${shift}px`;
    target = targetAt(root ?? block, block, last);
    mark(root ?? block, target);
  }

  /** @param {PointerEvent} moved */
  function move({ clientY }) {
    if (!block.classList.contains("in-hand") && Math.abs(clientY - event.clientY) < 4) return;
    block.classList.add("in-hand");
    last = clientY;
    follow();
    target?.marked.scrollIntoView({ block: "nearest" });
    follow();
  }

  /** @param {boolean} kept */
  function end(kept) {
    ended.abort();
    block.classList.remove("in-hand");
    block.style.translate = "";
    mark(root ?? block, null);
    if (kept && target) drop(target.place);
  }

  const { signal } = ended;
  block.addEventListener("pointermove", move, { signal });
  block.addEventListener("pointerup", () => end(true), { signal });
  block.addEventListener("pointercancel", () => end(false), { signal });
  addEventListener("keydown", ({ key }) => key === "Escape" && end(false), { signal });
}
