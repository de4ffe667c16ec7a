/** The drawing on the screen: shapes as SVG paths, labels as formulas above them; both are kept and only moved. */

import { figureOf, withDrawing } from "../model/drawing/figure.js";
import { stageOf } from "../model/drawing/stage.js";
import { snapshotAt } from "../model/trajectory.js";

/** @typedef {import("../model/types.js").Shape} Shape */
/** @typedef {import("../model/types.js").Label} Label */
/** @typedef {import("../model/types.js").Scene} Scene */
/** @typedef {import("../model/types.js").Trajectory} Trajectory */

const SVG = "http://www.w3.org/2000/svg";

/** @param {Element} element @param {string} name @param {string} value */
function put(element, name, value) {
  if (element.getAttribute(name) !== value) element.setAttribute(name, value);
}

/**
 * Elements by key: made when first wanted, kept in order, removed when no longer wanted.
 * @template {{key: string, className: string}} T
 * @template {Element} E
 * @param {Element} parent @param {(item: T) => E} make @param {(element: E, item: T) => void} update
 */
function pool(parent, make, update) {
  /** @type {Map<string, {element: E, className: string}>} */
  const elements = new Map();
  return (/** @type {readonly T[]} */ items) => {
    const wanted = new Set(items.map((item) => item.key));
    for (const [key, { element }] of elements) {
      if (wanted.has(key)) continue;
      element.remove();
      elements.delete(key);
    }
    items.forEach((item, place) => {
      const kept = elements.get(item.key) ?? { element: make(item), className: "" };
      const { element } = kept;
      elements.set(item.key, kept);
      if (parent.children[place] !== element) parent.insertBefore(element, parent.children[place] ?? null);
      // Written only when it changes, so that a class added from outside (a highlight) stays.
      if (kept.className !== item.className) put(element, "class", (kept.className = item.className));
      update(element, item);
    });
  };
}

/** @param {SVGPathElement} path @param {Shape} shape */
function updateShape(path, { d, at, opacity }) {
  put(path, "d", d);
  if (at) put(path, "transform", `translate(${at[0].toFixed(2)} ${at[1].toFixed(2)})`);
  if (opacity !== undefined) put(path, "opacity", String(opacity));
}

/** @param {HTMLElement} element @param {Label} label */
function updateLabel(element, { latex, at, start, opacity }) {
  if (element.dataset.latex !== latex) {
    element.dataset.latex = latex;
    try {
      globalThis.katex.render(latex, element, { strict: "ignore", output: "html", maxExpand: 1000, maxSize: 10 });
    } catch {
      element.textContent = latex;
    }
  }
  element.style.transform = `translate(${at[0].toFixed(1)}px, ${at[1].toFixed(1)}px) translate(${start ? "0" : "-50%"}, -50%)`;
  element.style.opacity = String(opacity ?? 1);
}

/**
 * @param {HTMLElement} frame  holds an svg and a layer of labels
 */
export function createDrawing(frame) {
  const svg = /** @type {SVGSVGElement} */ (frame.querySelector("svg"));
  const layer = /** @type {HTMLElement} */ (frame.querySelector(".labels"));
  const drawShapes = pool(svg, () => document.createElementNS(SVG, "path"), updateShape);
  const drawLabels = pool(layer, () => document.createElement("span"), updateLabel);
  /** @type {{scene: Scene | null, trajectory: Trajectory | null}} */
  let given = { scene: null, trajectory: null };
  /** @type {{scene: Scene, trajectory: Trajectory} | null} */
  let shown = null;
  /** @type {import("../model/drawing/stage.js").Stage | null} */
  let stage = null;

  function measure() {
    const { clientWidth: width, clientHeight: height } = frame;
    stage = shown && width > 0 ? stageOf(shown.scene, shown.trajectory, { width, height }) : null;
    if (!stage) return;
    put(svg, "viewBox", `0 0 ${width} ${height}`);
    frame.style.setProperty("--u", `${stage.unit}px`);
  }

  function clear() {
    drawShapes([]);
    drawLabels([]);
  }

  /** @param {number} t */
  function draw(t) {
    if (!stage || !shown) return;
    const figure = figureOf(stage, snapshotAt(shown.trajectory, t));
    drawShapes(figure.shapes);
    drawLabels(figure.labels);
  }

  return {
    draw,
    /** @param {Scene | null} scene @param {Trajectory | null} trajectory @param {number} t */
    show(scene, trajectory, t) {
      if (given.scene === scene && given.trajectory === trajectory) return;
      given = { scene, trajectory };
      shown = scene && trajectory?.t.length ? { scene: withDrawing(scene, trajectory), trajectory } : null;
      measure();
      if (shown) draw(t);
      else clear();
    },
    /** @param {number} t */
    resize(t) {
      measure();
      draw(t);
    },
  };
}
