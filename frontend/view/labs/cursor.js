/** Maps by keyboard: arrow keys move a cursor over them, Enter simulates the place. */

import { html, nothing } from "lit-html";
import { mapOf, middleOf, moved, seenAt } from "../../model/labs/cursor.js";
import { significant } from "../../model/numbers.js";

/** @typedef {import("../../model/labs/chart.js").Chart} Chart */
/** @typedef {import("../../model/labs/chart.js").MapTrace} MapTrace */
/** @typedef {{chart: string, spot: import("../../model/labs/cursor.js").Spot}} Cursor */
/** @typedef {Pick<import("./page.js").View, "t" | "state" | "cursor" | "point" | "press">} View */

/** The canvas of a chart; that of a map takes the keyboard. @param {View} view @param {Chart} chart */
export function canvas(view, chart) {
  const map = mapOf(chart);
  if (!map) return html`<div class="canvas"></div>`;
  return html`<div class="canvas" tabindex="0" role="application" aria-label="${chart.title}. ${view.t("labs.cursor.keys")}"
      @keydown=${(/** @type {KeyboardEvent} */ event) => pressed(view, chart, map, event)}></div>
    <p class="cursor" role="status">${view.cursor?.chart === chart.id ? told(view, map, view.cursor) : nothing}</p>`;
}

/** @param {View} view @param {Chart} chart @param {MapTrace} map @param {KeyboardEvent} event */
function pressed({ cursor, point, press }, chart, map, event) {
  const spot = cursor?.chart === chart.id ? cursor.spot : null;
  const next = moved(spot ?? middleOf(map), event.key, event.shiftKey, map);
  if (!next && !(event.key === "Enter" && spot)) return;
  event.preventDefault();
  if (next) point({ chart: chart.id, spot: next });
  else if (spot) press(chart, seenAt(spot, map).x, seenAt(spot, map).y);
}

/** @param {View} view @param {MapTrace} map @param {Cursor} cursor */
function told({ t, state }, map, { spot }) {
  const { x, y, value } = seenAt(spot, map);
  const number = (/** @type {number} */ one) => significant(one, 3, state.place.lang);
  const seen = value === null ? t("labs.cursor.nothing") : `${map.colorbar?.title?.text ?? ""} = ${number(value)}`;
  return t("labs.cursor.place", { x: `${map.meta.x} = ${number(x)}`, y: `${map.meta.y} = ${number(y)}`, seen });
}
