/** Pointing at a quantity lights it up wherever it stands: in formulas, drawing, plots and sliders. */

const QUANTITY = /^([pq]-\d+|load-.+|body-.+|energy-(kinetic|potential)|time-term)$/;
const SOURCE = /^(load|body)-/;
const TOGETHER = /^(load|body|p)-/;

/**
 * The innermost quantity at an element: one name, or all bodies and loads that a term comes from, with their parameters.
 * @param {Element | null} element @returns {string[]}
 */
function quantitiesAt(element) {
  for (let node = element; node && node.id !== "page"; node = node.parentElement) {
    const names = [...node.classList].filter((candidate) => QUANTITY.test(candidate));
    const sources = names.some((name) => SOURCE.test(name)) ? names.filter((name) => TOGETHER.test(name)) : [];
    if (names.length) return sources.length ? sources : names.slice(0, 1);
  }
  return [];
}

/** @param {HTMLElement} root */
export function linkHighlights(root) {
  let lit = "";
  const light = (/** @type {Event} */ { target }) => {
    const names = quantitiesAt(target instanceof Element ? target : null)
      .map((name) => `.${CSS.escape(name)}`)
      .join();
    if (names === lit) return;
    lit = names;
    root.querySelectorAll(".lit").forEach((element) => element.classList.remove("lit"));
    if (names) root.querySelectorAll(names).forEach((element) => element.classList.add("lit"));
  };
  for (const event of ["pointerover", "focusin"]) root.addEventListener(event, light);
}
