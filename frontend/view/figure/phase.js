/** The phase portrait in the place of the plots over time; a click on a curve leads to that moment. */

import { html, render, svg } from "lit-html";
import { inline } from "../formula.js";
import { portraitsOf, ROOM } from "../../model/figure/phase.js";
import { decimalsOf, fixed } from "../../model/numbers.js";
import { DASHES } from "../../model/figure/runs.js";

/** Pixels within which a click belongs to the curve. */
const NEAR = 30;

/** @param {import("./open.js").Bench} bench @param {(t: number) => void} seek */
export function createPhase({ root, state, clock }, seek) {
  const plots = /** @type {HTMLElement} */ (root.querySelector(".plots"));
  const layer = document.createElement("div");
  layer.className = "phase";
  /** @type {import("../../model/figure/phase.js").Portrait[]} */
  let portraits = [];
  /** @type {unknown[]} */
  let drawnFor = [];

  layer.addEventListener("pointerdown", (event) => {
    event.stopPropagation();
    const box = layer.getBoundingClientRect();
    const hand = /** @type {import("../../model/types.js").Pixel} */ ([
      event.clientX - box.left,
      event.clientY - box.top,
    ]);
    const best = portraits.map((portrait) => portrait.nearest(hand)).sort((a, b) => a.far - b.far)[0];
    if (best && best.far < NEAR) seek(best.t);
  });
  new ResizeObserver(() => show()).observe(plots);

  function show() {
    const { scene, trajectory, runs, place } = state();
    const on = place.with.includes("phase") && scene && trajectory?.t.length;
    if (!on) return layer.remove();
    if (!layer.isConnected) plots.append(layer);
    const { clientWidth: width, clientHeight: height } = plots;
    const given = [scene, trajectory, runs, width, height, place.lang];
    if (!width || given.every((part, i) => part === drawnFor[i])) return;
    drawnFor = given;
    const em = parseFloat(getComputedStyle(document.documentElement).fontSize);
    portraits = portraitsOf(
      scene,
      [trajectory, ...runs.map((run) => run.trajectory).filter(({ t }) => t.length)],
      { width, height },
      em,
    );
    render(picture(portraits, { width, height }, em, place.lang), layer);
    move();
  }

  function move() {
    if (!layer.isConnected) return;
    portraits.forEach((portrait, i) => {
      const [x, y] = portrait.where(clock.time);
      const dot = /** @type {HTMLElement | undefined} */ (layer.querySelectorAll(".state")[i]);
      if (dot) dot.style.transform = `translate(${x}px, ${y}px)`;
    });
  }
  return { show, move };
}

/** @param {import("../../model/figure/phase.js").Portrait[]} portraits @param {{width: number, height: number}} size @param {number} em @param {string} lang */
function picture(portraits, { width, height }, em, lang) {
  return html`
    <svg viewBox=${`0 0 ${width} ${height}`} aria-hidden="true">${portraits.map((portrait) => curves(portrait, height, em, lang))}</svg>
    ${portraits.map(
      ({ className, left, width, across, up, units }) => html`
      <span class="axis up ${className}" style="left:${left + 8}px">${inline(up)} <small>${units[1]}</small></span>
      <span class="axis ${className}" style="left:${left + width - 8}px">${inline(across)} <small>${units[0]}</small></span>`,
    )}
    ${portraits.map(({ className }) => html`<i class="state ${className}"></i>`)}
  `;
}

/** @param {import("../../model/figure/phase.js").Portrait} portrait @param {number} height @param {number} em @param {string} lang */
function curves({ className, left, width, columns, rows, paths, doubted }, height, em, lang) {
  const [x0, x1, y0, y1] = [
    left + ROOM.left * em,
    left + width - ROOM.right * em,
    ROOM.top * em,
    height - ROOM.bottom * em,
  ];
  const number = (
    /** @type {number} */ value,
    /** @type {import("../../model/figure/phase.js").Tick[]} */ [one, other = one],
  ) =>
    fixed(value, decimalsOf(Math.abs(other.value - one.value) || 1), lang)
      .replace(/([.,]\d*?)0+$/, "$1")
      .replace(/[.,]$/, "");
  return svg`
    ${columns.map(({ position, value }) => svg`<path class="grid" d=${`M${position} ${y0}V${y1}`} /><text x=${position} y=${y1 + 1.1 * em} text-anchor="middle">${number(value, columns)}</text>`)}
    ${rows.map(({ position, value }) => svg`<path class="grid" d=${`M${x0} ${position}H${x1}`} /><text x=${x0 - 0.4 * em} y=${position + 0.3 * em} text-anchor="end">${number(value, rows)}</text>`)}
    <path class=${`doubted ${className}`} d=${doubted} />${paths.map((d, i) => svg`<path class=${`curve ${className} ${i ? DASHES[i - 1] : ""}`} d=${d} />`)}`;
}
