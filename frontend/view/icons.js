/** The few icons, drawn on a grid of 20. */

import { svg, html } from "lit-html";

const PATHS = {
  play: "M6 4v12l10-6z",
  pause: "M6 4h3v12H6zM11 4h3v12h-3z",
  next: "M7 4l6 6-6 6",
  previous: "M13 4l-6 6 6 6",
  lecture: "M3 4h14v9H3zM10 13v4M7 17h6M8.5 6.5v4l3.5-2z",
  steps: "M3 16h4v-4h4V8h4V4h2",
  spot: "M10 10m-2 0a2 2 0 1 0 4 0a2 2 0 1 0-4 0M10 2v3M10 15v3M2 10h3M15 10h3",
  black: "M3 4h14v12H3zM3 16L17 4",
  presenter: "M3 4h9v7H3zM14 4h3v7h-3zM3 13.5h14M3 16.5h9",
  share:
    "M7 9.5l6-3M7 11l6 3M5 10.2m-2.2 0a2.2 2.2 0 1 0 4.4 0a2.2 2.2 0 1 0-4.4 0M15 5.4m-2.2 0a2.2 2.2 0 1 0 4.4 0a2.2 2.2 0 1 0-4.4 0M15 15m-2.2 0a2.2 2.2 0 1 0 4.4 0a2.2 2.2 0 1 0-4.4 0",
  print: "M6 7V3h8v4M6 14H3V8h14v6h-3M6 12h8v5H6z",
  file: "M5 3h7l3 3v11H5zM12 3v3h3M10 9v5M8 12l2 2l2-2",
  menu: "M3 5h14M3 10h14M3 15h14",
  overview: "M3 3h5v5H3zM12 3h5v5h-5zM3 12h5v5H3zM12 12h5v5h-5z",
  fullscreen: "M3 7V3h4M13 3h4v4M17 13v4h-4M7 17H3v-4",
  help: "M7 7.5a3 3 0 1 1 4.4 2.6c-.9.5-1.4 1-1.4 2.1M10 15.2v.3",
  verified: "M4 10.5l4 4 8-9",
  chevron: "M5 8l5 5 5-5",
  theme: "M10 3a7 7 0 1 0 0 14zM10 3a7 7 0 0 1 0 14",
  pen: "M4 16l.8-3.4L13.6 3.8l2.6 2.6-8.8 8.8zM11.8 5.6l2.6 2.6",
  add: "M10 4v12M4 10h12",
  up: "M5 12l5-5 5 5",
  close: "M5 5l10 10M15 5L5 15",
  again: "M4.2 8A6.2 6.2 0 1 1 4 12M4 4v4h4",
};
const SOLID = new Set(["play", "pause"]);

/** @param {keyof typeof PATHS} name */
export function icon(name) {
  return html`<svg class="icon ${SOLID.has(name) ? "solid" : ""}" viewBox="0 0 20 20" aria-hidden="true">${svg`<path d=${PATHS[name]} />`}</svg>`;
}
