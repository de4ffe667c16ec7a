/** Colours as the style sheets have them at this moment, for what is drawn by numbers. */

/** The colour of each class below an element. @param {HTMLElement} root @param {string[]} classes */
export function coloursOf(root, classes) {
  const probe = document.createElement("i");
  probe.style.setProperty("forced-color-adjust", "none");
  root.append(probe);
  const colours = classes.map((name) => {
    probe.className = name;
    return getComputedStyle(probe).color;
  });
  probe.remove();
  return colours;
}

/** Of axes and words. @param {HTMLElement} root @returns {import("../model/labs/figure.js").Palette} */
export function paletteOf(root) {
  const [ink, muted, grid, paper] = coloursOf(root, ["c-ink", "c-muted", "c-grid", "c-paper"]);
  return { ink, muted, grid, paper };
}
