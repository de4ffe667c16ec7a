/** The plots: curves drawn once by Plotly, and above them a cursor that follows the clock. */

import { domainsOf, layoutOf, marginsOf, rowsOf, timeScale, tracesOf } from "../model/plots.js";
import { endOf } from "../model/trajectory.js";
import { fixed } from "../model/numbers.js";
import { script } from "./bring.js";
import { coloursOf, paletteOf } from "./palette.js";
import { typeset } from "./typesetting.js";

/** @typedef {import("../model/types.js").Scene} Scene */
/** @typedef {import("../model/types.js").Trajectory} Trajectory */
/** @typedef {{scene: Scene, trajectory: Trajectory, runs: import("../model/figure/runs.js").Run[], duration: number, lang: string, theme: string}} Shown */

/** Named in the import map, so that its address carries the version of the libraries. */
const SOURCE = import.meta.resolve("plotly");
/** Milliseconds between two redraws while a slider moves. */
const PAUSE = 100;

/** @param {() => void} task */
function whenIdle(task) {
  if (window.requestIdleCallback) window.requestIdleCallback(task, { timeout: 500 });
  else task();
}

/** @param {HTMLElement} root @returns {import("../model/plots.js").Palette} */
function coloured(root) {
  const classes = ["energy-kinetic", "energy-potential", "energy-balance", ...Array.from({ length: 24 }, (_, i) => `q-${i}`)];
  const palette = paletteOf(root);
  const colours = coloursOf(root, classes);
  return { ...palette, of: (name) => colours[classes.indexOf(name)] ?? palette.ink };
}

/**
 * @param {HTMLElement} root  holds .canvas, .rows, .cursor, .ghost and .beyond
 * @param {{seek: (t: number) => void}} actions
 */
export function createPlots(root, { seek }) {
  const part = (/** @type {string} */ name) => /** @type {HTMLElement} */ (root.querySelector(`.${name}`));
  const [canvas, rowsLayer, cursor, ghost, beyond] = ["canvas", "rows", "cursor", "ghost", "beyond"].map(part);
  /** @type {Shown | null} */
  let shown = null;
  let scale = timeScale(1, 0, 16);
  let visible = false;
  let due = 0;
  let now = 0;
  let pointed = NaN;
  /** On whole pixels of the screen: there it is sharp, and most frames of a long motion have nothing to move. */
  function point() {
    const x = Math.round(scale.pixel(now) * devicePixelRatio) / devicePixelRatio;
    if (x !== pointed) cursor.style.transform = `translateX(${x}px)`;
    pointed = x;
  }
  /** Fetched when the first plot is wanted. @type {Promise<boolean> | null} */
  let plotly = null;

  async function redraw() {
    due = 0;
    if (!shown || !visible || root.clientWidth === 0) return;
    // A slow processor has enough to do with the library: the curves are drawn in another task.
    plotly ??= script(SOURCE).then((come) => new Promise((resolve) => setTimeout(resolve, 0, come)));
    if (!(await plotly) || !shown) return;
    const { scene, trajectory, runs, duration, lang } = shown;
    const palette = coloured(root);
    const em = parseFloat(getComputedStyle(document.documentElement).fontSize);
    const rows = rowsOf(scene, trajectory, runs.map((run) => run.trajectory));
    const layout = { ...layoutOf(rows, duration, palette, lang, root.clientHeight, em), width: root.clientWidth, height: root.clientHeight };
    const traces = tracesOf(rows, trajectory, palette);
    await globalThis.Plotly.react(canvas, traces, layout, { staticPlot: true, displayModeBar: false });
    scale = timeScale(root.clientWidth, duration, em);
    point();
    label(rows, em);
    name(traces);
    const end = endOf(trajectory);
    beyond.style.insetInlineStart = `${scale.pixel(end)}px`;
    beyond.hidden = end >= duration * 0.999;
    root.classList.add("ready");
  }

  /** @param {import("../model/plots.js").Row[]} rows @param {number} em */
  function label(rows, em) {
    const { t, b } = marginsOf(em);
    const tops = domainsOf(rows.length, root.clientHeight, em).map(([, top]) => (1 - top) * (root.clientHeight - t - b));
    rowsLayer.replaceChildren(...rows.map((row, r) => legend(row, tops[r])));
  }

  /** Curves carry the class of their quantity, so that pointing at it lights them up. @param {{className: string}[]} traces */
  function name(traces) {
    canvas.querySelectorAll(".scatterlayer .trace").forEach((curve, i) => curve.classList.add(traces[i]?.className));
  }

  function schedule() {
    if (!due) due = window.setTimeout(() => whenIdle(() => void redraw()), PAUSE);
  }

  const xOf = (/** @type {PointerEvent} */ event) => event.clientX - root.getBoundingClientRect().left;
  root.addEventListener("pointerdown", (event) => {
    root.setPointerCapture(event.pointerId);
    seek(scale.time(xOf(event)));
  });
  root.addEventListener("pointermove", (event) => {
    ghost.style.transform = `translateX(${xOf(event)}px)`;
    ghost.hidden = event.pointerType !== "mouse" || !shown;
    ghost.textContent = shown ? `${fixed(scale.time(xOf(event)), 2, shown.lang)} s` : "";
    if (event.buttons & 1) seek(scale.time(xOf(event)));
  });
  root.addEventListener("pointerleave", () => (ghost.hidden = true));
  new ResizeObserver(schedule).observe(root);
  // Once: what is watched for being seen is measured in every frame.
  new IntersectionObserver(([entry], watch) => {
    if (!entry.isIntersecting) return;
    watch.disconnect();
    visible = true;
    schedule();
  }).observe(root);

  return {
    /** @param {Shown | null} next */
    show(next) {
      const same = next && shown && Object.keys(next).every((key) => next[/** @type {keyof Shown} */ (key)] === shown?.[/** @type {keyof Shown} */ (key)]);
      if (same) return;
      shown = next;
      if (!shown) root.classList.remove("ready");
      schedule();
    },
    /** @param {number} t */
    move(t) {
      now = t;
      point();
    },
  };
}

/** The names of a row's curves, in their colours, with the unit. @param {import("../model/plots.js").Row} row @param {number} top */
function legend(row, top) {
  const line = document.createElement("div");
  line.className = "legend";
  line.style.top = `${top}px`;
  for (const curve of row.curves.filter(({ beside }) => !beside)) {
    const name = document.createElement("span");
    name.className = `key ${curve.className}`;
    typeset(name, curve.latex, false);
    line.append(name);
  }
  const unit = document.createElement("span");
  unit.className = "unit";
  unit.textContent = row.unit ? `in ${row.unit}` : "";
  line.append(unit);
  return line;
}
