/** The motion over time, drawn for paper. */

import { html, svg } from "lit-html";
import { inline } from "../formula.js";
import { brief } from "../../model/numbers.js";
import { picturesOf, ROOM, SIZE } from "../../model/history.js";

/** @typedef {import("../../model/history.js").Picture} Picture */
/** @typedef {{scene: import("../../model/types.js").Scene, trajectory: import("../../model/types.js").Trajectory, lang: string, title: string, label: string}} HistoryView */

/** @param {HistoryView} view */
export function history({ scene, trajectory, lang, title, label }) {
  return html`
    <figure class="history"><figcaption>${title}</figcaption>
      <div class="pictures">${picturesOf(scene, trajectory).map((picture) => one(picture, label, lang))}</div></figure>`;
}

/** @param {Picture} picture @param {string} label @param {string} lang */
function one({ unit, lines, columns, rows }, label, lang) {
  const { width, height } = SIZE;
  const [left, right, top, bottom] = [ROOM.left, width - ROOM.right, ROOM.top, height - ROOM.bottom];
  const said = (/** @type {number} */ value) => brief(value, 6, lang);
  return html`
    <div class="picture"><p>${lines.map(({ latex, className }) => inline(latex, className))}<span class="unit">${unit ? `in ${unit}` : ""}</span></p>
      <svg viewBox="0 0 ${width} ${height}" role="img" aria-label=${label}>
        ${rows.map(({ position, value }) => svg`<path class="grid" d="M${left} ${position}H${right}" /><text class="up" x=${left - 4} y=${position + 3}>${said(value)}</text>`)}
        ${columns.map(({ position, value }) => svg`<path class="grid" d="M${position} ${top}V${bottom}" /><text class="along" x=${position} y=${height - 6}>${said(value)}</text>`)}
        ${lines.map(({ className, path }) => svg`<path class="curve ${className}" d=${path} />`)}
      </svg></div>`;
}
