/** The drawing on the screen: shapes as SVG paths, labels as formulas above them; both are kept and only moved. */

import { FRONT } from "../model/drawing/camera.js";
import { figureOf, withDrawing } from "../model/drawing/figure.js";
import { placed } from "../model/drawing/placing.js";
import { stageOf } from "../model/drawing/stage.js";
import { snapshotAt } from "../model/trajectory.js";
import { typeset } from "./typesetting.js";

/** @typedef {import("../model/types.js").Shape} Shape */
/** @typedef {import("../model/types.js").Label} Label */
/** @typedef {import("../model/types.js").Pixel} Pixel */
/** @typedef {import("../model/types.js").Scene} Scene */
/** @typedef {import("../model/types.js").Trajectory} Trajectory */

const SVG = "http://www.w3.org/2000/svg";
/** Milliseconds in which a letter appears at another place. */
const FADE = 200;
const still = matchMedia("(prefers-reduced-motion: reduce)");

/**
 * Elements by key: made when first wanted, kept in order, removed when no longer wanted. Each remembers what was
 * last written to it, because asking the page costs as much as writing.
 * @template {{key: string, className: string}} T
 * @template {Element} E
 * @param {Element} parent @param {() => E} make @param {(element: E, item: T, last: Partial<T>) => void} update
 */
function pool(parent, make, update) {
  /** @type {Map<string, {element: E, last: Partial<T>}>} */
  const kept = new Map();
  /** @type {readonly T[]} */
  let arranged = [];

  /** @param {readonly T[]} items */
  function arrange(items) {
    const wanted = new Set(items.map((item) => item.key));
    for (const [key, { element }] of kept) {
      if (wanted.has(key)) continue;
      element.remove();
      kept.delete(key);
    }
    items.forEach(({ key }, place) => {
      const { element } = kept.get(key) ?? { element: make() };
      if (!kept.has(key)) kept.set(key, { element, last: {} });
      if (parent.children[place] !== element) parent.insertBefore(element, parent.children[place] ?? null);
    });
  }

  return (/** @type {readonly T[]} */ items) => {
    if (items.length !== arranged.length || items.some(({ key }, place) => key !== arranged[place].key)) arrange(items);
    arranged = items;
    for (const item of items) {
      const found = /** @type {{element: E, last: Partial<T>}} */ (kept.get(item.key));
      if (found.last === item) continue;
      // Written only when it changes, so that a class added from outside (a highlight) stays.
      if (found.last.className !== item.className) found.element.setAttribute("class", item.className);
      update(found.element, item, found.last);
      found.last = item;
    }
  };
}

/** @param {Pixel | undefined} a @param {Pixel | undefined} b */
const same = (a, b) => a === b || (a && b && Math.abs(a[0] - b[0]) + Math.abs(a[1] - b[1]) < 0.01);

/** Opacity of the stroke alone: a translucent path would be a layer of its own. @param {SVGPathElement} path @param {Shape} shape @param {Partial<Shape>} last */
function updateShape(path, { d, at, opacity }, last) {
  if (d !== last.d) path.setAttribute("d", d);
  if (at && !same(at, last.at)) path.setAttribute("transform", `translate(${at[0].toFixed(2)} ${at[1].toFixed(2)})`);
  if (opacity !== last.opacity) path.setAttribute("stroke-opacity", String(opacity));
}

/** @param {HTMLElement} element @param {Label} label @param {Partial<Label>} last */
function updateLabel(element, { latex, at, moves, opacity }, last) {
  if (latex !== last.latex) typeset(element, latex, false, "html");
  if (!same(at, last.at))
    element.style.transform = `translate(${at[0].toFixed(1)}px, ${at[1].toFixed(1)}px) translate(-50%, -50%)`;
  if (opacity !== last.opacity) element.style.opacity = String(opacity ?? 1);
  // A letter does not fly over others to another place.
  if (last.moves !== undefined && moves !== last.moves && opacity !== 0 && !still.matches)
    element.animate({ opacity: [0, opacity ?? 1] }, FADE);
}

/**
 * Draws figures, one after the other, on the same shapes and labels.
 * @param {SVGSVGElement} svg @param {HTMLElement} layer
 */
export function createSheet(svg, layer) {
  const drawShapes = pool(svg, () => document.createElementNS(SVG, "path"), updateShape);
  const drawLabels = pool(layer, () => document.createElement("span"), updateLabel);
  return (/** @type {import("../model/types.js").Figure} */ { shapes, labels }) => {
    drawShapes(shapes);
    drawLabels(labels);
  };
}

/** Where numbers lie on the drawing. @param {HTMLElement} frame @returns {import("../model/types.js").Box[]} */
function reservedIn(frame) {
  const outer = frame.getBoundingClientRect();
  return [...frame.querySelectorAll(".readouts > div")].map((line) => {
    const { left, top, right, bottom } = line.getBoundingClientRect();
    return [left - outer.left, top - outer.top, right - outer.left, bottom - outer.top];
  });
}

/**
 * @param {HTMLElement} frame  holds an svg and a layer of labels
 */
export function createDrawing(frame) {
  const svg = /** @type {SVGSVGElement} */ (frame.querySelector("svg"));
  const sheet = createSheet(svg, /** @type {HTMLElement} */ (frame.querySelector(".labels")));
  /** @type {import("../model/types.js").Snapshot | null} */
  let held = null;
  /** @type {{scene: Scene | null, trajectory: Trajectory | null}} */
  let given = { scene: null, trajectory: null };
  /** @type {{scene: Scene, trajectory: Trajectory} | null} */
  let shown = null;
  /** @type {import("../model/drawing/stage.js").Stage | null} */
  let stage = null;
  let camera = FRONT;
  /** @type {ReturnType<typeof placed>["ground"] | undefined} */
  let ground;
  /** What other layers draw over it. @type {NonNullable<Parameters<typeof placed>[3]> | undefined} */
  let over;

  function measure() {
    const { clientWidth: width, clientHeight: height } = frame;
    const rem = parseFloat(getComputedStyle(document.documentElement).fontSize);
    const page = { rem, reserved: reservedIn(frame), camera };
    stage = shown && width > 0 ? stageOf(shown.scene, shown.trajectory, { width, height }, page) : null;
    if (!stage) return;
    svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
    frame.style.setProperty("--u", `${stage.unit}px`);
  }

  /** @param {number} t */
  function draw(t) {
    if (!stage || !shown) return;
    const figure = placed(stage, figureOf(stage, held ?? snapshotAt(shown.trajectory, t)), t, over);
    ground = figure.ground;
    sheet(figure);
  }

  return {
    draw,
    /** Where things stand on the screen; null before there is anything to draw. */
    get stage() {
      return stage;
    },
    /** What is drawn: letters of other layers keep off it. */
    get ground() {
      return ground;
    },
    /** Its letters keep off what another layer draws over it, from the next time on that it is drawn. @param {Parameters<typeof placed>[3]} drawn */
    keepOff(drawn) {
      over = drawn;
    },
    get camera() {
      return camera;
    },
    /** Sees space from elsewhere, from the next time on that it is drawn. @param {typeof FRONT} from */
    see(from) {
      camera = from;
      if (stage) stage = stageOf(stage.scene, stage.trajectory, stage.size, { ...stage, camera });
    },
    /** Shows a configuration instead of the motion, until it is let go. @param {import("../model/types.js").Snapshot | null} snapshot */
    hold(snapshot) {
      held = snapshot;
    },
    /** @param {Scene | null} scene @param {Trajectory | null} trajectory @param {number} t */
    show(scene, trajectory, t) {
      if (given.scene === scene && given.trajectory === trajectory) return;
      if (given.scene?.id !== scene?.id) camera = FRONT;
      given = { scene, trajectory };
      shown = scene && trajectory?.t.length ? { scene: withDrawing(scene, trajectory), trajectory } : null;
      measure();
      if (shown) draw(t);
      else sheet({ shapes: [], labels: [] });
    },
    /** @param {number} t */
    resize(t) {
      measure();
      draw(t);
    },
  };
}
