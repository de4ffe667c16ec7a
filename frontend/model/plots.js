/** How rows of curves are drawn over one time axis. */

import { traced, unbroken } from "./curve.js";
import { slackTimes } from "./forces.js";
import { spanAt } from "./interpolation.js";
import { folded } from "./look.js";
import { largestError, usual } from "./trajectory.js";

/** @typedef {import("./types.js").Trajectory} Trajectory */
/** @typedef {import("./curves.js").Curve} Curve */
/** @typedef {import("./curves.js").Row} Row */
/**
 * @typedef {{width: number, height: number, em: number, duration: number, from?: number}} Frame  pixels of the plots and of the page's type, and seconds from and up to which they go
 */
/** @typedef {{ink: string, muted: string, grid: string, paper: string, of: (className: string) => string}} Palette */

/** An error estimate above this share of a row's range is shown as a band. */
const VISIBLE = 0.01;
const LEAST_RANGE = 1e-3;

/** A range smaller than this part of its values would have ticks longer than their margin. */
const FLAT = 1e-3;

/** Between two rows there is room for the names of the curves: this many times the page's type size. */
const GAP = 1.5;

/**
 * The rows' parts of the height, from the top, with a gap between them.
 * @param {number} count @param {number} height in pixels @param {number} em the page's type size in pixels
 */
export function domainsOf(count, height, em) {
  const inner = height - marginsOf(em).t - marginsOf(em).b;
  const gap = Math.min(0.15, (GAP * em) / Math.max(inner, 1));
  const share = (1 - gap * (count - 1)) / count;
  return Array.from({ length: count }, (_, i) => {
    const top = 1 - i * (share + gap);
    return [Math.max(0, top - share), top];
  });
}

/**
 * From time and value to pixels, for each row.
 * @param {readonly Row[]} rows @param {Frame} frame
 * @returns {((t: number, value: number) => import("./types.js").Pixel)[]}
 */
export function scalesOf(rows, { width, height, em, duration, from = 0 }) {
  const { pixel } = timeScale(width, duration, em, from);
  const { t: above, b: below } = marginsOf(em);
  const inner = height - above - below;
  return domainsOf(rows.length, height, em).map(([bottom, top], r) => {
    const [low, high] = rangeOf(rows[r]);
    return (t, value) => [pixel(t), above + inner * (1 - bottom - ((value - low) / (high - low)) * (top - bottom))];
  });
}

/** @param {Curve} curve */
export const isShown = ({ hidden }) => !hidden;

/**
 * Plotly traces of all rows: their corners are chosen for the size in which they are drawn.
 * @param {readonly Row[]} rows @param {Trajectory} trajectory @param {Palette} palette @param {Frame} frame
 */
export function tracesOf(rows, trajectory, palette, frame) {
  const scales = scalesOf(rows, frame);
  return rows.flatMap((row, r) =>
    row.curves.filter(isShown).flatMap((curve) => {
      const whole = traced((t) => scales[r](t, curve.at(t)), curve.times);
      // Between pieces a corner without a value breaks the line.
      const t = unbroken(whole, curve.at).flatMap((piece, i) => (i ? [NaN, ...piece.t] : piece.t));
      const straight = { x: t, y: t.map(curve.at) };
      const { x, y } = curve.wrapped ? folded(straight.x, straight.y) : straight;
      const axis = { xaxis: "x", yaxis: r === 0 ? "y" : `y${r + 1}` };
      const color = palette.of(curve.className);
      const trace = {
        type: "scatter",
        mode: "lines",
        x,
        y,
        name: curve.key,
        className: curve.className,
        hoverinfo: "skip",
        line: { color, width: curve.dash === "solid" ? 2 : 1.6, dash: curve.dash, simplify: false },
        ...axis,
      };
      return curve.band ? [...bandOf(curve, trajectory, { x, y }, color, axis), trace] : [trace];
    }),
  );
}

/**
 * The band q ± estimate, if it can be seen.
 * @param {Curve} curve @param {Trajectory} trajectory @param {{x: number[], y: number[]}} drawn @param {string} color @param {object} axis
 */
function bandOf(curve, trajectory, drawn, color, axis) {
  const error = trajectory.error?.estimate ?? [];
  // Below one a tolerance is absolute: a coordinate at rest has no range, and a small error there is none to show.
  const range = Math.max(Math.max(...curve.values) - Math.min(...curve.values), LEAST_RANGE);
  if (!((largestError(trajectory) ?? 0) > VISIBLE * range)) return [];
  const wide = (/** @type {number} */ sign) =>
    drawn.y.map((v, n) => {
      const { i, j, s } = spanAt(trajectory.t, drawn.x[n]);
      return v + sign * Math.min((1 - s) * (error[i] ?? range) + s * (error[j] ?? range), range);
    });
  const x = [...drawn.x, ...[...drawn.x].reverse()];
  const y = [...wide(1), ...wide(-1).reverse()];
  const line = { width: 0 };
  return [
    {
      type: "scatter",
      mode: "lines",
      x,
      y,
      fill: "toself",
      fillcolor: color,
      opacity: 0.18,
      line,
      className: curve.className,
      hoverinfo: "skip",
      ...axis,
    },
  ];
}

/** Margins of the plots in pixels; the style sheet places cursor and names by the same. @param {number} em */
export const marginsOf = (em) => ({ l: 2.9 * em, r: 0.65 * em, t: 1.5 * em, b: 1.5 * em });

/**
 * Plotly layout: one time axis at the bottom, one value axis per row.
 * @param {readonly Row[]} rows @param {number} end @param {Palette} palette @param {string} lang
 * @param {number} height in pixels @param {number} em the page's type size in pixels @param {number} [from]
 */
export function layoutOf(rows, end, palette, lang, height, em, from = 0) {
  const font = { family: "system-ui, sans-serif", size: 0.7 * em, color: palette.muted };
  const line = {
    gridcolor: palette.grid,
    zeroline: false,
    ticks: "",
    fixedrange: true,
    exponentformat: "power",
    // There is room for all of them: to look whether they fit takes a third of a drawing.
    tickangle: 0,
    ticklabeloverflow: "allow",
  };
  const { t, b } = marginsOf(em);
  const axes = domainsOf(rows.length, height, em).map((domain, r) => [
    r === 0 ? "yaxis" : `yaxis${r + 1}`,
    {
      ...line,
      domain,
      nticks: ticksIn((domain[1] - domain[0]) * (height - t - b), em),
      zeroline: true,
      zerolinecolor: palette.grid,
      zerolinewidth: 1.5,
      range: rangeOf(rows[r]),
    },
  ]);
  return {
    ...Object.fromEntries(axes),
    xaxis: { ...line, range: [from, end || 1], anchor: rows.length > 1 ? `y${rows.length}` : "y", nticks: 8 },
    margin: { ...marginsOf(em), pad: em / 4 },
    showlegend: false,
    hovermode: false,
    dragmode: false,
    font,
    paper_bgcolor: "rgba(0,0,0,0)",
    plot_bgcolor: "rgba(0,0,0,0)",
    separators: lang === "de" ? ",." : ".,",
  };
}

/** Most ticks of an axis so many pixels long: their numbers stand one above the other. @param {number} length @param {number} em */
const ticksIn = (length, em) => Math.max(MOST_TICKS[0], Math.min(MOST_TICKS[1], Math.floor(length / (TICK * em))));

/** Fewer would say nothing, more would be a crowd. */
const MOST_TICKS = [2, 4];
/** What the number of a tick takes, in the page's type size. */
const TICK = 0.9;

/** Marks of more events than these would be a grey ground. */
const MOST_MARKS = 80;

/**
 * Plotly shapes: a dotted line at each event behind which the motion went on (impacts, sticking, slipping), and in the
 * row of a rod's or string's force one where it would go slack.
 * @param {Trajectory} trajectory @param {readonly Row[]} rows @param {Palette} palette
 */
export function marksOf(trajectory, rows, palette) {
  const times = (trajectory.events ?? []).map(({ time }) => time);
  const line = { color: palette.muted, width: 1, dash: "dot" };
  const across = { type: "line", xref: "x", yref: "paper", y0: 0, y1: 1, layer: "below", opacity: 0.5, line };
  const slack = rows.flatMap(({ curves }, r) => {
    const pulling = curves.filter((curve) => curve.pulls && isShown(curve));
    return pulling.flatMap((curve) =>
      slackTimes(curve).map((time) => ({
        ...across,
        yref: r === 0 ? "y domain" : `y${r + 1} domain`,
        x0: time,
        x1: time,
        opacity: 1,
        line: { ...line, color: palette.of(curve.className) },
      })),
    );
  });
  const events = times.map((time) => ({ ...across, x0: time, x1: time }));
  return [events, slack].flatMap((marks) => (marks.length > MOST_MARKS ? [] : marks));
}

/**
 * A little room on both sides; a constant curve gets a range that shows it as constant.
 * @param {Row} row
 */
function rangeOf(row) {
  const edges = row.curves.some((curve) => curve.wrapped && isShown(curve)) ? [-Math.PI, Math.PI] : [];
  const values = [...row.curves.filter(isShown).flatMap((curve) => curve.values), ...edges].filter(Number.isFinite);
  if (!values.length) return [0, 1];
  const [low, high] = usual(values.sort((a, b) => a - b));
  const span = Math.max(high - low, row.least, FLAT * Math.max(Math.abs(low), Math.abs(high)), 1e-9);
  const room = 0.08 * span + (span - (high - low)) / 2;
  return [low - room, high + room];
}

/**
 * Pixels of a time on the plots, and back.
 * @param {number} width @param {number} end @param {number} em @param {number} [from]
 */
export function timeScale(width, end, em, from = 0) {
  const { l, r } = marginsOf(em);
  const inner = Math.max(1, width - l - r);
  return {
    pixel: (/** @type {number} */ t) => l + (end > from ? (t - from) / (end - from) : 0) * inner,
    time: (/** @type {number} */ x) => Math.max(from, Math.min(end, from + ((x - l) / inner) * (end - from))),
    /** Whether a moment is on them. @param {number} t */
    holds: (t) => t >= from && t <= end,
  };
}
