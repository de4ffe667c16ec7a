/** Pointing at a quantity lights it up wherever it stands: in formulas, drawing, plots and sliders. */

const QUANTITY = /^(q-\d+|load-.+|body-.+|energy-(kinetic|potential)|time-term)$/;

/** The innermost quantity at an element. @param {Element | null} element @returns {string} */
function quantityAt(element) {
  for (let node = element; node && node.id !== "page"; node = node.parentElement) {
    const name = [...node.classList].find((candidate) => QUANTITY.test(candidate));
    if (name) return name;
  }
  return "";
}

/** @param {HTMLElement} root */
export function linkHighlights(root) {
  let lit = "";
  root.addEventListener("pointerover", ({ target }) => {
    const name = quantityAt(target instanceof Element ? target : null);
    if (name === lit) return;
    lit = name;
    root.querySelectorAll(".lit").forEach((element) => element.classList.remove("lit"));
    if (name) root.querySelectorAll(`.${CSS.escape(name)}`).forEach((element) => element.classList.add("lit"));
  });
}
