/** Pointing at a quantity lights it up wherever it stands: in formulas, drawing, plots and sliders; so does walking through the terms of a formula. */

const QUANTITY = /^([pq]-\d+|load-.+|body-.+|constraint-.+|energy-(kinetic|potential)|time-term)$/;
const SOURCE = /^(load|body|constraint)-/;
const TOGETHER = /^(load|body|constraint|p)-/;
/** Of a symbol of the whole system: what of the drawing belongs to it, without its colour. */
const BELONGS = /^of-/;
const VECTOR = /^vector-[rvz]$/;

/**
 * The innermost quantity at an element: one name, or all bodies, loads and constraints that a term comes from, with their parameters.
 * @param {Element | null} element @returns {string[]}
 */
function quantitiesAt(element) {
  for (let node = element; node && node.id !== "page"; node = node.parentElement) {
    const names = [...node.classList].filter((candidate) => QUANTITY.test(candidate));
    const belongings = [...node.classList].filter((candidate) => BELONGS.test(candidate));
    if (belongings.length) return [...names, ...belongings.map((name) => name.slice(3).replace("_", "-"))];
    const sources = names.some((name) => SOURCE.test(name)) ? names.filter((name) => TOGETHER.test(name)) : [];
    if (names.length) return sources.length ? sources : names.slice(0, 1);
  }
  return [];
}

/** The symbol of a place, velocity or reaction at an element, and whose it is. @param {Element | null | undefined} element */
function vectorsAt(element) {
  const classes = [...(element?.closest("[class*='vector-']")?.classList ?? [])];
  const vector = classes.find((name) => VECTOR.test(name))?.at(-1);
  const owner = vector === "z" ? "constraint-" : "body-";
  const owners = classes.filter((name) => name.startsWith(owner)).map((name) => name.slice(owner.length));
  return vector ? [...new Set(owners)].map((of) => ({ of, vector })) : [];
}

/** What the letters of a term stand for. @param {readonly Element[]} symbols */
function within(symbols) {
  const all = [...new Set(symbols.flatMap((symbol) => [symbol, ...symbol.querySelectorAll("*")]))];
  const letters = all.filter((one) => !one.childElementCount && one.textContent?.trim());
  return { names: letters.flatMap(quantitiesAt), vectors: letters.flatMap(vectorsAt) };
}

/** Lights what belongs together, and tells of symbols of places, velocities and reactions by the event "lit" and in `data-vectors`. @param {HTMLElement} root */
export function linkHighlights(root) {
  let [lit, arrows] = ["", "[]"];

  /** @param {string[]} names @param {ReturnType<typeof vectorsAt>} vectors */
  function light(names, vectors) {
    const each = [...new Map(vectors.map((one) => [`${one.vector} ${one.of}`, one])).values()];
    const told = JSON.stringify(each);
    // Kept as well: who draws them may come later.
    root.dataset.vectors = told;
    if (told !== arrows) root.dispatchEvent(new CustomEvent("lit"));
    arrows = told;
    const selector = [...new Set(names)].map((name) => `.${CSS.escape(name)}`).join();
    if (selector === lit) return;
    lit = selector;
    root.querySelectorAll(".lit").forEach((element) => element.classList.remove("lit"));
    if (selector) root.querySelectorAll(selector).forEach((element) => element.classList.add("lit"));
  }

  for (const event of ["pointerover", "focusin"])
    root.addEventListener(event, ({ target }) => {
      const element = target instanceof Element ? target : null;
      light(quantitiesAt(element), vectorsAt(element));
    });
  root.addEventListener("term", (event) => {
    const { names, vectors } = within(/** @type {CustomEvent<Element[]>} */ (event).detail);
    light(names, vectors);
  });
}
