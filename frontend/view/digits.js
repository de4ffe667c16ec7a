/** Digits that change many times a second. */

const SVG = "http://www.w3.org/2000/svg";

/**
 * A text whose changes concern nothing around it: within an SVG they do not make the browser lay out the page anew,
 * and changing a text node's data, instead of the node, leaves all style rules as they are.
 * @param {HTMLElement} element
 */
export function digitsIn(element) {
  const svg = document.createElementNS(SVG, "svg");
  const text = document.createElementNS(SVG, "text");
  const digits = document.createTextNode("");
  svg.setAttribute("class", "digits");
  text.setAttribute("y", "1em");
  text.append(digits);
  svg.append(text);
  element.replaceChildren(svg);
  return digits;
}

/** Whether it is time again: true at most once in so many milliseconds. @param {number} pause */
export function atMost(pause) {
  let last = -Infinity;
  return () => {
    const now = performance.now();
    if (now - last < pause) return false;
    last = now;
    return true;
  };
}
