/** Plotly with heat maps, fetched when the first chart is wanted; and charts drawn by it into the figures of the page. */

import { mapOf, seenAt } from "../../model/labs/cursor.js";
import { themed } from "../../model/labs/figure.js";
import { createLater } from "../../model/later.js";
import { script } from "../bring.js";
import { paletteOf } from "../palette.js";

/** @typedef {import("../../model/labs/chart.js").Chart} Chart */
/** @typedef {HTMLElement & {on: (event: "plotly_click", hear: (event: {points: {x: number, y: number, curveNumber: number}[]}) => void) => void}} Drawn  an element that Plotly draws into */

/** Named in the import map, so that its address carries the version of the libraries. */
const SOURCE = import.meta.resolve("plotly-with-maps");
const CONFIG = { displayModeBar: false, displaylogo: false, responsive: false };
const FILE = { width: 1200, height: 800, scale: 2 };

/** @param {HTMLElement} root @param {(chart: Chart, x: number, y: number, curve: number) => void} press  a place on a map or a curve was pressed @param {() => void} changed  Plotly is there, or it could not be had */
export function createCharts(root, press, changed) {
  /** What each canvas shows, so that nothing is drawn twice. @type {WeakMap<HTMLElement, string>} */
  const shown = new WeakMap();
  /** The chart in each canvas. @type {WeakMap<HTMLElement, Chart>} */
  const drawn = new WeakMap();
  /** A number for each chart that was made. @type {WeakMap<Chart, number>} */
  const stamps = new WeakMap();
  let made = 0;
  const library = createLater(() => script(SOURCE).then(() => true), changed);

  /** @param {HTMLElement} canvas @param {Chart} chart @param {string} look @param {string} lang */
  async function draw(canvas, chart, look, lang) {
    const em = parseFloat(getComputedStyle(document.documentElement).fontSize);
    const { data, layout } = themed(chart, paletteOf(root), canvas.clientWidth, em, lang);
    const first = !shown.has(canvas);
    shown.set(canvas, look);
    await globalThis.Plotly.react(canvas, data, layout, CONFIG);
    drawn.set(canvas, chart);
    if (first)
      /** @type {Drawn} */ (canvas).on("plotly_click", ({ points: [{ x, y, curveNumber }] }) =>
        press(drawn.get(canvas) ?? chart, x, y, curveNumber),
      );
  }

  /** @param {Chart} chart */
  function stampOf(chart) {
    if (!stamps.has(chart)) stamps.set(chart, (made += 1));
    return stamps.get(chart);
  }

  return {
    library,
    /** @param {Chart[]} charts @param {string} theme @param {string} lang */
    async show(charts, theme, lang) {
      if (!charts.length) return;
      if (!(await library.want())) return;
      for (const chart of charts) {
        const canvas = /** @type {HTMLElement | null} */ (root.querySelector(`[data-chart="${chart.id}"] .canvas`));
        if (!canvas || canvas.clientWidth === 0) continue;
        const look = `${theme} ${lang} ${canvas.clientWidth} ${stampOf(chart)}`;
        if (shown.get(canvas) !== look) await draw(canvas, chart, look, lang);
      }
    },
    /** Plotly's own label at the place of a cursor. @param {Chart[]} charts @param {import("./cursor.js").Cursor | null} cursor */
    point(charts, cursor) {
      const chart = charts.find(({ id }) => id === cursor?.chart);
      const canvas = chart && root.querySelector(`[data-chart="${chart.id}"] .canvas`);
      if (!canvas || !cursor) return;
      const map = mapOf(chart);
      if (!map) return;
      const { x, y } = seenAt(cursor.spot, map);
      globalThis.Plotly.Fx.hover(canvas, { xval: x, yval: y });
    },
    /** As it was made, dark on light. @param {Chart} chart @param {"png" | "svg"} format */
    async save(chart, format) {
      if (!(await library.want())) return;
      await globalThis.Plotly.downloadImage(
        {
          data: chart.data,
          layout: {
            ...chart.layout,
            title: { text: `${chart.title}<br><sub>${chart.subject}</sub>` },
            margin: { ...chart.layout.margin, t: 72 },
          },
        },
        { ...FILE, format, filename: chart.id },
      );
    },
  };
}
