/** Values of the curves: under the pointer, else at the moment; beside their names and as spots on the curves. */

import { readingOf } from "../../model/curves.js";
import { decimalsOf, fixed, niceFloor, significant } from "../../model/numbers.js";
import { domainsOf, isShown, marginsOf } from "../../model/plots.js";
import { atMost, digitsIn } from "../digits.js";

/** @typedef {import("../../model/curves.js").Row} Row */
/** @typedef {import("../../model/curves.js").Curve} Curve */
/** @typedef {{write: (t: number) => void, put: (t: number) => void}} Slot  a curve's number, and its spot */

/** Parts of a row's range that its numbers tell apart. */
const FINE = 2000;
/** Numbers above are written with a power of ten. */
const LARGE = 1e5;
/** Milliseconds in which all numbers change while the motion runs. */
const PAUSE = 150;

/** @param {Row} row @param {string} lang @returns {(value: number) => string} */
function writerOf({ curves }, lang) {
  const values = curves.flatMap((curve) => curve.values).filter(Number.isFinite);
  const decimals = decimalsOf(niceFloor(Math.max(Math.max(...values) - Math.min(...values), 1e-6) / FINE));
  return (value) => (Math.abs(value) < LARGE ? fixed(value, decimals, lang) : significant(value, 3, lang));
}

/** Room for the widest of a curve's numbers. @param {Curve} curve @param {(value: number) => string} write */
const roomFor = ({ values }, write) => Math.max(...values.map((value) => write(value).length));

/** @param {import("./open.js").Bench} bench */
export function createReading({ root, parts: { plots }, state, clock }) {
  const area = /** @type {HTMLElement} */ (root.querySelector(".plots"));
  const layer = document.createElement("div");
  layer.className = "spots";
  layer.setAttribute("aria-hidden", "true");
  /** @type {Slot[]} */
  let slots = [];
  /** The moment under the pointer. @type {number | null} */
  let pointed = null;
  let [next, due, round] = [0, atMost(PAUSE), 0];

  /** @param {Curve} curve @param {(value: number) => string} write @param {HTMLElement} after @param {{top: number, bottom: number, place: (t: number, value: number) => number[]}} row @returns {Slot} */
  function slotOf(curve, write, after, { top, bottom, place }) {
    const number = document.createElement("span");
    number.className = `reading ${curve.className} ${curve.beside ? curve.dash : ""}`;
    number.style.width = `${roomFor(curve, write)}ch`;
    const digits = digitsIn(number);
    after.after(number);
    const spot = document.createElement("i");
    spot.className = `spot ${curve.className} ${curve.beside ? "beside" : ""}`;
    layer.append(spot);
    const [begin, end] = [curve.times[0], curve.times[curve.times.length - 1]];
    const reads = (/** @type {number} */ t) => (t >= begin && t <= end ? readingOf(curve, t) : NaN);
    return {
      write: (t) => void (digits.data = write(reads(t))),
      put(t) {
        const value = reads(t);
        const [x, y] = place(t, value);
        spot.hidden = !(y >= top && y <= bottom);
        if (!spot.hidden) spot.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
      },
    };
  }

  /** Slots beside the names, anew with each drawing. */
  function fit() {
    const { drawn } = plots;
    if (!drawn) return;
    layer.replaceChildren();
    if (!layer.isConnected) area.append(layer);
    const em = parseFloat(getComputedStyle(document.documentElement).fontSize);
    const { t: above, b: below } = marginsOf(em);
    const height = area.clientHeight - above - below;
    const domains = domainsOf(drawn.rows.length, area.clientHeight, em);
    const names = [...area.querySelectorAll(".legend")];
    slots = drawn.rows.flatMap((row, r) => {
      const write = writerOf(row, state().place.lang);
      const [top, bottom] = [above + (1 - domains[r][1]) * height - 1, above + (1 - domains[r][0]) * height + 1];
      // Those of other runs come first, so that each is put right behind the name and the present one before them.
      return [...row.curves].reverse().flatMap((curve) => {
        const name = names[r]?.querySelector(`[data-curve="${CSS.escape(curve.key)}"]`);
        return name && isShown(curve)
          ? [slotOf(curve, write, /** @type {HTMLElement} */ (name), { top, bottom, place: drawn.scales[r] })]
          : [];
      });
    });
    [next, due] = [0, atMost(PAUSE / Math.max(1, slots.length))];
    move();
  }

  function move() {
    if (!slots.length) return;
    const still = pointed !== null || !clock.playing;
    layer.hidden = !still;
    const t = pointed ?? clock.time;
    if (still) {
      for (const slot of slots) slot.write(t);
      for (const slot of slots) slot.put(t);
    } else if (due()) {
      // One after the other, as all at once would make a frame late; those of one round are of one moment.
      if (next === 0) round = t;
      slots[next].write(round);
      next = (next + 1) % slots.length;
    }
  }

  area.addEventListener("pointermove", ({ pointerType, clientX, target, buttons }) => {
    const free =
      pointerType === "mouse" &&
      !buttons &&
      !(target instanceof Element && target.closest("button, .plot-tools, .phase"));
    pointed = free && plots.drawn ? plots.drawn.scale.time(clientX - area.getBoundingClientRect().left) : null;
    move();
  });
  area.addEventListener("pointerleave", () => {
    pointed = null;
    move();
  });
  plots.listen(fit);
  return {
    move() {
      if (pointed === null) move();
    },
  };
}
