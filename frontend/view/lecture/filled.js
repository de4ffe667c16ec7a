/** Gives the formulas of a slide the size at which they fill it, and again whenever there is more or less room. */

import { better, bounds, filling, fillingBriefly, formulaOf, worthwhile } from "../../model/lecture/filling.js";
import { refit } from "../formula.js";

/** @typedef {{latex: string, share: number, depth: number}} Shown  depth: of a substep within its step */

/** @typedef {{dense: string, place: string, close: boolean, brief: boolean}} Arranged */

/** What is estimated may be a little off: then all of it becomes smaller by as much as it is too high, and at least by this, so many times. */
const SMALLER = 0.9985;
const TRIES = 8;
/** So many times, two frames each, rows are waited for that are not typeset yet, or are still wider than their place. */
const PATIENCE = 20;

/** Words and drawings come late, and need more or less room then; so many pixels make no difference. */
const SLACK = 2;

/** Words and premises as they are, smaller, and only the formulas. */
const DENSER = ["", "words", "formulas"];
/**
 * Where the drawing stands: in a column of its own, or in a corner with the formulas under it. A screen that is less wide
 * for its height has no room for a column: there formulas are under the corner, or beside it as if it were one.
 */
const PLACES = { wide: ["", "under"], narrow: ["under", "beside"] };
const narrow = matchMedia("(min-aspect-ratio: 1) and (max-aspect-ratio: 3/2)");
/** Rem at both sides of a formula. */
const PADDING = 0.5;

const rem = () => parseFloat(getComputedStyle(document.documentElement).fontSize);
const shorter = () => Math.min(window.innerWidth, window.innerHeight);

/** @param {HTMLElement} root  the page, with a slide or without */
export function createFilled(root) {
  let last = "";
  /** Pixels that were left for formulas then. */
  let left = 0;
  /** @type {readonly Shown[]} */
  let shown = [];
  let asked = 0;
  /** @type {Element | null} */
  let watched = null;
  /** Which step is watched for growing: rows and letters may come late. @type {Element | null} */
  let step = null;
  const resized = new ResizeObserver(() => {
    fill(false);
    const slide = /** @type {HTMLElement | null} */ (root.querySelector(".slide[data-filled]"));
    if (slide) check(slide, parseFloat(slide.style.getPropertyValue("--size-formula")), 0);
  });

  /** @param {HTMLElement} scroll */
  function measured(scroll) {
    const formulas = /** @type {HTMLElement[]} */ ([...scroll.querySelectorAll(".formula")]);
    const { clientWidth, clientHeight } = scroll;
    const style = getComputedStyle(scroll);
    const inner = (/** @type {string} */ a, /** @type {string} */ b) => parseFloat(a) + parseFloat(b);
    const around = inner(style.paddingTop, style.paddingBottom);
    const words = [...scroll.children].reduce((sum, child) => sum + outer(child), 0) - heightOf(formulas);
    return {
      width: clientWidth - inner(style.paddingLeft, style.paddingRight) - PADDING * rem(),
      height: clientHeight - around - words,
    };
  }

  /** @param {boolean} anew */
  function fill(anew) {
    const slide = /** @type {HTMLElement | null} */ (root.querySelector(".slide"));
    const scroll = /** @type {HTMLElement | null} */ (slide?.querySelector(".scroll") ?? null);
    if (!slide || !scroll) return;
    const desk = /** @type {HTMLElement} */ (slide.parentElement);
    if (!placesOn().includes(desk.dataset.place ?? "none")) desk.dataset.place = placesOn()[0];
    watch(scroll);
    const room = () =>
      [scroll.clientWidth, scroll.clientHeight, innerWidth, ...shown.map(({ latex }) => latex)].join("\n");
    const same = () => room() === last && Math.abs(measured(scroll).height - left) <= SLACK;
    if (!shown.length || !scroll.clientWidth || (!anew && same())) return;
    delete slide.dataset.tight;
    const size = roomiest(slide, scroll);
    [last, left] = [room(), measured(scroll).height];
    set(slide, size, 0);
  }

  /** @param {HTMLElement} scroll */
  function watch(scroll) {
    const article = scroll.querySelector(".step");
    if (scroll === watched && article === step) return;
    [watched, step] = [scroll, article];
    resized.disconnect();
    for (const one of [scroll, article]) if (one) resized.observe(one);
  }

  /** What is not formula makes room for them, as far as it must. @param {HTMLElement} slide @param {HTMLElement} scroll */
  function roomiest(slide, scroll) {
    const natural = shown.map(naturalOf).map(formulaOf);
    const arrange = (/** @type {Arranged} */ { dense, place, close, brief }) => {
      Object.assign(slide.dataset, { dense, rows: brief ? "brief" : close ? "close" : "" });
      /** @type {HTMLElement} */ (slide.parentElement).dataset.place = place;
      slide.style.setProperty("--corner", `${cornerOf(slide, scroll)}px`);
    };
    /** @param {typeof filling} fill  with or without shorthand */
    const bestOf = (fill) => {
      /** @type {(ReturnType<typeof filling> & {dense: string, place: string}) | null} */
      let best = null;
      for (const dense of DENSER) {
        for (const place of placesOn()) {
          arrange({ dense, place, close: false, brief: false });
          const found = { ...fill(natural, measured(scroll), shorter()), dense, place };
          if (best?.dense === dense && !cornerOf(slide, scroll)) break;
          best = best ? better(best, found) : found;
          if (best.far) return best;
        }
      }
      return best;
    };
    const written = bestOf(filling);
    const brief = written && !written.far ? bestOf(fillingBriefly) : null;
    const best = written && brief ? worthwhile(written, brief) : written;
    if (best) arrange(best);
    return best?.size ?? 0;
  }

  /** @param {HTMLElement} slide @param {number} size @param {number} tried */
  function set(slide, size, tried) {
    delete slide.dataset.filled;
    slide.style.setProperty("--size-formula", `${size.toFixed(2)}px`);
    refit(slide);
    later(() => check(slide, size, tried));
  }

  /** @param {() => void} next  what is to be done when all has been laid out */
  function later(next) {
    cancelAnimationFrame(asked);
    asked = requestAnimationFrame(() => (asked = requestAnimationFrame(next)));
  }

  /** What came out higher than was estimated becomes smaller, when all of it is there. @param {HTMLElement} slide @param {number} size @param {number} tried @param {number} [waited] */
  function check(slide, size, tried, waited = 0) {
    if (isUnderWay(slide) && waited < PATIENCE) return later(() => check(slide, size, tried, waited + 1));
    const scroll = /** @type {HTMLElement | null} */ (slide.querySelector(".scroll"));
    const over = scroll ? scroll.scrollHeight - scroll.clientHeight : 0;
    if (scroll && over > 1 && slide.dataset.tight === undefined) {
      slide.dataset.tight = "";
      left = measured(scroll).height;
      return later(() => check(slide, size, tried));
    }
    const part = Math.min(SMALLER, 1 - over / Math.max(1, heightOf(slide.querySelectorAll(".scroll .formula"))));
    const smaller = Math.max(bounds(shorter()).least, size * part);
    if (over > 1 && tried < TRIES && smaller < size) set(slide, smaller, tried + 1);
    else slide.dataset.filled = "";
  }

  document.fonts.addEventListener("loadingdone", () => fill(true));
  root.addEventListener("grown", () => fill(true));
  /** Called when anything has changed. @param {readonly Shown[]} formulas */
  return (formulas) => {
    shown = formulas;
    fill(false);
  };
}

const placesOn = () => (narrow.matches ? PLACES.narrow : PLACES.wide);

/** @param {Iterable<Element>} formulas */
const heightOf = (formulas) =>
  [...formulas].reduce((sum, formula) => sum + /** @type {HTMLElement} */ (formula).offsetHeight, 0);

/** Whether rows of a slide are still to come or to be made to fit. @param {HTMLElement} slide */
const isUnderWay = (slide) =>
  slide.querySelector(".scroll :is(.rows > .cell:nth-child(even):empty, .formula[data-late])") !== null ||
  [...slide.querySelectorAll(".scroll .formula:not(.wide)")].some((one) => one.scrollWidth > one.clientWidth + 1);

/** How far a drawing in the corner of a slide reaches down into what is scrolled, in pixels. @param {HTMLElement} slide @param {HTMLElement} scroll */
function cornerOf(slide, scroll) {
  const drawing = slide.parentElement?.querySelector(".drawing")?.getBoundingClientRect();
  const { left, right } = slide.getBoundingClientRect();
  if (!drawing || drawing.left <= left + 1 || drawing.left >= right - 1) return 0;
  return Math.max(0, drawing.bottom - scroll.getBoundingClientRect().top);
}

/** Substeps stand in. @param {Shown} formula */
function naturalOf({ latex, share, depth }) {
  return { latex, share, indent: depth && (1.2 + 1.4 * (depth - 1)) * rem() };
}

/** @param {Element} element  its height with its margins */
function outer(element) {
  const style = getComputedStyle(element);
  return (
    /** @type {HTMLElement} */ (element).offsetHeight + parseFloat(style.marginTop) + parseFloat(style.marginBottom)
  );
}
