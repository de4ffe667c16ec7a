/** A chart in the colours and the width of the page, and what is put over it while a slider moves. */

import { resultOf } from "./results.js";
import { stepRange } from "./step.js";

/** @typedef {import("./chart.js").Chart} Chart */
/** @typedef {import("./chart.js").Trace} Trace */
/** @typedef {{ink: string, muted: string, grid: string, paper: string}} Palette */

const NARROW = 640;
/** In the type size: how wide a letter of the legend is, and the symbol and margins beside it. */
const LETTER = 0.38,
  BESIDE = 4.5;
/** The type size in pixels for which charts are made. */
const TYPE = 16;
/** Plotly's own, where a chart says nothing. */
const LINE = 2,
  SYMBOL = 6;
/** Symbols and lines in ink on white paper are in the page's ink. */
const INK = "#222222";

/**
 * @param {Chart} chart @param {Palette} palette @param {number} width in pixels @param {number} em @param {string} lang
 */
export function themed(chart, palette, width, em, lang) {
  const narrow = width < NARROW * (em / TYPE);
  const told = narrow
    ? { ...chart, data: chart.data.map((trace) => broken(trace, (width - BESIDE * em) / (LETTER * em))) }
    : chart;
  const layout = {
    ...chart.layout,
    width,
    height: heightOf(told, narrow, em),
    margin: scaled(chart.layout.margin ?? {}, em / TYPE),
    font: { ...chart.layout.font, size: 0.8 * em, color: palette.ink },
    paper_bgcolor: "rgba(0,0,0,0)",
    plot_bgcolor: "rgba(0,0,0,0)",
    separators: lang === "de" ? ",." : ".,",
    legend: narrow
      ? {
          ...chart.layout.legend,
          orientation: "h",
          x: 0,
          y: -0.22,
          xanchor: "left",
          yanchor: "top",
          font: { size: 0.72 * em },
        }
      : { ...chart.layout.legend, font: { size: 0.75 * em } },
    ...axesOf(chart.layout, palette),
  };
  return { data: told.data.map((trace) => thickened(inked(trace, palette), em / TYPE)), layout };
}

/** What a legend says below a narrow chart goes on in the next line. @param {Trace} trace @param {number} most letters in a line */
function broken(trace, most) {
  const lines = (trace.name ?? "").split(" ").reduce((/** @type {string[]} */ all, word) => {
    const longer = all.length ? `${all[all.length - 1]} ${word}` : word;
    return all.length && longer.length <= most ? [...all.slice(0, -1), longer] : [...all, word];
  }, []);
  return lines.length > 1 ? { ...trace, name: lines.join("<br>") } : trace;
}

/** @param {Chart} chart @param {boolean} narrow @param {number} em */
function heightOf(chart, narrow, em) {
  const named = chart.data.filter((trace) => trace.name && trace.showlegend !== false);
  const lines = named.reduce((sum, { name }) => sum + (name ?? "").split("<br>").length, 0);
  const legend = narrow && chart.layout.showlegend !== false ? lines * 1.35 * em : 0;
  return 26 * em + legend;
}

/** @param {Chart["layout"]} layout @param {Palette} palette */
function axesOf(layout, palette) {
  const axes = Object.entries(layout).filter(([key]) => /^[xy]axis\d*$/.test(key));
  return Object.fromEntries(
    axes.map(([key, axis]) => [
      key,
      {
        .../** @type {object} */ (axis),
        gridcolor: palette.grid,
        linecolor: palette.muted,
        tickcolor: palette.muted,
        zerolinecolor: palette.muted,
      },
    ]),
  );
}

/** @param {Trace} trace @param {Palette} palette @returns {Trace} */
function inked(trace, palette) {
  const { marker, line } = trace;
  const shown = (/** @type {string | null | undefined} */ color) => (color === INK ? palette.ink : color);
  if (![marker?.color, marker?.line?.color, line?.color].includes(INK)) return trace;
  return {
    ...trace,
    ...(line && { line: { ...line, color: shown(line.color) } }),
    ...(marker && {
      marker: {
        ...marker,
        color: shown(marker.color),
        ...(marker.line && { line: { ...marker.line, color: shown(marker.line.color) } }),
      },
    }),
  };
}

/** @param {Record<string, number>} lengths @param {number} by */
const scaled = (lengths, by) =>
  Object.fromEntries(Object.entries(lengths).map(([name, length]) => [name, length * by]));

/** Lines and symbols grow with the type. @param {Trace} trace @param {number} by @returns {Trace} */
function thickened(trace, by) {
  const { line, marker } = trace;
  const sized = marker && (Array.isArray(marker.size) ? marker : { ...marker, size: (marker.size ?? SYMBOL) * by });
  return {
    ...trace,
    ...(line && { line: { ...line, width: (line.width ?? LINE) * by } }),
    ...(sized && { marker: sized }),
  };
}

/** The crosses hλ for a step h. @param {Chart} chart @param {number} h @returns {Chart} */
export function withStep(chart, h) {
  const scale = (/** @type {Trace["x"]} */ values) => values.map((v) => v && v * h);
  const moved = (/** @type {Trace} */ trace) =>
    trace.meta?.role === "eigenvalues" ? { ...trace, x: scale(trace.x), y: scale(trace.y) } : trace;
  return { ...chart, data: chart.data.map(moved) };
}

/** A line across at the error that is wanted, on the charts of error. @param {Chart} chart @param {number} tolerance @param {string} color @returns {Chart} */
export function withTolerance(chart, tolerance, color) {
  const line = {
    type: "line",
    xref: "paper",
    x0: 0,
    x1: 1,
    y0: tolerance,
    y1: tolerance,
    line: { color, width: 1.5, dash: "dash" },
  };
  return { ...chart, layout: { ...chart.layout, shapes: [line] } };
}

/**
 * The charts that were measured, with the marks of the sliders on them.
 * @param {Pick<import("./bench.js").Bench, "charts" | "question" | "result">} bench @param {{tolerance: number, step: number}} dial
 */
export function withMarks({ charts, question, result }, dial) {
  if (question.lab === "work-precision") return charts.map((chart) => withTolerance(chart, dial.tolerance, "#888888"));
  const stability = resultOf(result, "stability");
  if (!stability) return charts;
  const [low] = stepRange(stability.eigenvalues);
  return charts.map((chart) => (chart.id === "stability-regions" ? withStep(chart, dial.step || 10 * low) : chart));
}

/** The cheapest run for a tolerance: that of the next finer one that was asked for. @template {{wanted: number}} R @param {R[]} cheapest @param {number} tolerance */
export function cheapestFor(cheapest, tolerance) {
  return cheapest.filter((one) => one.wanted <= tolerance * 1.0001).sort((a, b) => b.wanted - a.wanted)[0] ?? null;
}
