/** A layer of the drawing: shapes and labels that belong together. */

import { createSheet } from "../drawing.js";

const SVG = "http://www.w3.org/2000/svg";

/** @param {HTMLElement} frame of the drawing @param {string} name */
export function layerIn(frame, name) {
  const [svg, labels] = [document.createElementNS(SVG, "svg"), document.createElement("div")];
  svg.setAttribute("class", name);
  labels.className = "labels";
  for (const part of [svg, labels]) part.setAttribute("aria-hidden", "true");
  frame.append(svg, labels);
  const sheet = createSheet(svg, labels);
  let fitted = "";
  return {
    /** @param {import("../../model/types.js").Figure} figure @param {{width: number, height: number}} [size] of the drawing */
    draw(figure, size) {
      const box = size ? `0 0 ${size.width} ${size.height}` : fitted;
      if (box !== fitted) svg.setAttribute("viewBox", (fitted = box));
      sheet(figure);
    },
  };
}
