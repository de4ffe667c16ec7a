/** The plots: curves drawn once by Plotly, and above them the moment. */

import { rowsOf } from "../model/curves.js";
import { createLater } from "../model/later.js";
import { readLook, spanOf } from "../model/look.js";
import { domainsOf, isShown, layoutOf, marksOf, marginsOf, scalesOf, timeScale, tracesOf } from "../model/plots.js";
import { trustedUntil } from "../model/trajectory.js";
import { script } from "./bring.js";
import { afterFrame, whenIdle } from "./frames.js";
import { createMoment } from "./moment.js";
import { coloursOf, paletteOf } from "./palette.js";
import { typeset } from "./typesetting.js";

/** @typedef {import("../model/types.js").Scene} Scene */
/** @typedef {import("../model/types.js").Trajectory} Trajectory */
/** @typedef {{scene: Scene, trajectory: Trajectory, runs: import("../model/figure/runs.js").Run[], duration: number, lang: string, theme: string, look: string}} Shown */
/** @typedef {{rows: import("../model/curves.js").Row[], scale: ReturnType<typeof timeScale>, scales: ReturnType<typeof scalesOf>}} Drawn  what is drawn where */

/** Named in the import map, so that its address carries the version of the libraries. */
const SOURCE = import.meta.resolve("plotly");
/** Milliseconds between two redraws while a slider moves; a slow processor keeps as long for all else as one took. */
const PAUSE = 100;
/** Milliseconds after which a plot has waited long enough for an idle moment. */
const PATIENCE = 500;

/** @param {HTMLElement} root @returns {import("../model/plots.js").Palette} */
function coloured(root) {
  const classes = [
    "energy-kinetic",
    "energy-potential",
    "energy-balance",
    ...Array.from({ length: 24 }, (_, i) => `q-${i}`),
  ];
  const palette = paletteOf(root);
  const colours = coloursOf(root, classes);
  return { ...palette, of: (name) => colours[classes.indexOf(name)] ?? palette.ink };
}

/** Curves, drawn by Plotly into `.canvas` with their names in `.rows` above. @param {HTMLElement} root @param {() => void} came */
function createCurves(root, came) {
  const part = (/** @type {string} */ name) => /** @type {HTMLElement} */ (root.querySelector(`.${name}`));
  const [canvas, names, beyond] = ["canvas", "rows", "beyond"].map(part);
  /** Fetched when the first plot is wanted. A slow processor has enough to do with it: the curves are drawn in another task. */
  const library = createLater(async () => {
    await script(SOURCE);
    return new Promise((/** @type {(come: boolean) => void} */ resolve) => setTimeout(resolve, 0, true));
  }, came);

  /** Nothing is measured here, for the page has just been changed. @param {import("../model/curves.js").Row[]} rows @param {number} em @param {number} height */
  function label(rows, em, height) {
    const { t, b } = marginsOf(em);
    const tops = domainsOf(rows.length, height, em).map(([, top]) => (1 - top) * (height - t - b));
    rows.forEach((row, r) => {
      const [line, said] = [names.children[r], saidOf(row)];
      if (!(line instanceof HTMLElement && line.dataset.said === said)) {
        const written = legend(row, said);
        if (line) line.replaceWith(written);
        else names.append(written);
      }
      refresh(/** @type {HTMLElement} */ (names.children[r]), row, tops[r]);
    });
    while (names.children.length > rows.length) names.lastElementChild?.remove();
  }

  return {
    library,
    /** @param {Shown} shown @returns {Promise<Drawn>} */
    async draw({ scene, trajectory, runs, duration, lang, look: text }) {
      const palette = coloured(root);
      const look = readLook(text);
      const [from, to] = spanOf(look, duration);
      const em = parseFloat(getComputedStyle(document.documentElement).fontSize);
      const rows = rowsOf(
        scene,
        trajectory,
        runs.map((run) => run.trajectory),
        look,
      );
      const frame = { width: root.clientWidth, height: root.clientHeight, em, duration: to, from };
      const layout = {
        ...layoutOf(rows, to, palette, lang, frame.height, em, from),
        width: frame.width,
        height: frame.height,
        shapes: marksOf(trajectory, rows, palette),
      };
      const traces = tracesOf(rows, trajectory, palette, frame);
      await globalThis.Plotly.react(canvas, traces, layout, { staticPlot: true, displayModeBar: false });
      label(rows, em, frame.height);
      canvas.querySelectorAll(".scatterlayer .trace").forEach((curve, i) => mark(curve, traces[i]?.className ?? ""));
      const scale = timeScale(frame.width, to, em, from);
      const end = Math.max(from, trustedUntil(trajectory));
      beyond.style.insetInlineStart = `${scale.pixel(end)}px`;
      beyond.hidden = end >= to * 0.999;
      return { rows, scale, scales: scalesOf(rows, frame) };
    },
  };
}

/**
 * @param {HTMLElement} root  holds .canvas, .rows, .cursor, .ghost and .beyond
 * @param {{seek: (t: number) => void, changed: () => void}} actions  changed: Plotly is there, or it could not be had
 */
export function createPlots(root, { seek, changed }) {
  /** @type {Shown | null} */
  let shown = null;
  let visible = false;
  let due = 0;
  /** When the curves may be drawn anew. */
  let free = 0;
  /** @type {Drawn | null} */
  let drawn = null;
  /** @type {() => void} */
  let told = () => {};
  /** Plotly could not be had when something was to be drawn. */
  let owed = false;
  const curves = createCurves(root, () => {
    if (owed) schedule();
    changed();
  });
  const moment = createMoment(root, { seek, lang: () => shown?.lang ?? "" });

  async function redraw() {
    due = 0;
    if (!shown || !visible || root.clientWidth === 0) return;
    owed = !(await curves.library.want());
    if (owed || !shown) return;
    const began = performance.now();
    drawn = await curves.draw(shown);
    free = began + Math.max(PAUSE, 2 * (performance.now() - began));
    moment.fit(drawn.scale);
    root.classList.add("ready");
    told();
  }

  /** The first curves wait until all else is there, others only for the drawing of their motion. */
  function schedule() {
    if (due) return;
    const [wait, pause] = drawn
      ? [afterFrame, free - performance.now()]
      : [(/** @type {() => void} */ task) => whenIdle(task, PATIENCE), PAUSE];
    due = window.setTimeout(() => wait(() => void redraw()), Math.max(0, pause));
  }

  new ResizeObserver(schedule).observe(root);
  // Once: what is watched for being seen is measured in every frame.
  new IntersectionObserver(([entry], watch) => {
    if (!entry.isIntersecting) return;
    watch.disconnect();
    visible = true;
    schedule();
  }).observe(root);

  return {
    move: moment.move,
    library: curves.library,
    /** Null before there is anything. */
    get drawn() {
      return drawn;
    },
    /** @param {() => void} listener  called after each drawing */
    listen(listener) {
      told = listener;
      if (drawn) told();
    },
    /** @param {Shown | null} next */
    show(next) {
      const same =
        next &&
        shown &&
        Object.keys(next).every(
          (key) => next[/** @type {keyof Shown} */ (key)] === shown?.[/** @type {keyof Shown} */ (key)],
        );
      if (same) return;
      shown = next;
      if (!shown) root.classList.remove("ready");
      schedule();
    },
  };
}

/**
 * Curves carry the class of their quantity, so that pointing at it lights them up; Plotly draws others into the same elements.
 * @param {Element} curve @param {string} name
 */
function mark(curve, name) {
  const before = curve.getAttribute("data-quantity");
  if (before === name) return;
  if (before) curve.classList.remove(before, "lit");
  curve.setAttribute("data-quantity", name);
  curve.classList.add(name);
}

/** @typedef {import("../model/curves.js").Row} Row */

/** The curves of a row that have names. @param {Row} row */
const named = ({ curves }) => curves.filter(({ beside }) => !beside);

/** All that a line of names says. @param {Row} row */
const saidOf = (row) =>
  JSON.stringify([row.unit, ...named(row).map(({ key, className, latex, name }) => [key, className, latex, name])]);

/** A line that stays, so that a name keeps the focus, and a press that has begun, while the curves are drawn anew. @param {HTMLElement} line @param {Row} row @param {number} top */
function refresh(line, row, top) {
  line.style.top = `${top}px`;
  for (const reading of line.querySelectorAll(".reading")) reading.remove();
  const shown = new Map(named(row).map((curve) => [curve.key, isShown(curve)]));
  for (const name of /** @type {NodeListOf<HTMLElement>} */ (line.querySelectorAll("[data-curve]")))
    name.setAttribute("aria-pressed", String(shown.get(name.dataset.curve ?? "")));
}

/** The symbols of a row's curves, in their colours, heard as words, with the unit; a press hides or shows a curve. @param {Row} row @param {string} said */
function legend(row, said) {
  const line = document.createElement("div");
  line.className = "legend";
  line.dataset.said = said;
  for (const curve of named(row)) {
    const name = document.createElement("button");
    name.className = `key ${curve.className}`;
    name.dataset.curve = curve.key;
    const [seen, heard] = ["math", "unseen"].map((part) => {
      const span = document.createElement("span");
      span.className = part;
      return span;
    });
    typeset(seen, curve.latex, false, "html");
    heard.textContent = curve.name;
    name.append(seen, heard);
    line.append(name);
  }
  const unit = document.createElement("span");
  unit.className = "unit";
  unit.textContent = row.unit ? `in ${row.unit}` : "";
  line.append(unit);
  return line;
}
