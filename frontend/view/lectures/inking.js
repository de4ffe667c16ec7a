/** The pen over a slide and the spotlight: what the pointer does there, and how it is drawn. */

import { html, nothing, svg } from "lit-html";
import { drawnOn, erased, pathOf, pointIn, withStroke } from "../../model/lectures/ink.js";

/** @typedef {import("../../model/lectures/ink.js").Stroke} Stroke */
/** @typedef {import("../../model/lectures/ink.js").Point} Point */
/** @typedef {{ink: readonly Stroke[], spot: Point | null, pen: {colour: number, erase: boolean} | null}} Inked */

/**
 * What is drawn, above whatever is shown. With the pen in the hand it takes the pointer.
 * @param {Inked} inked @param {(strokes: Stroke[]) => void} changed
 */
export function inking({ ink, spot, pen }, changed) {
  return html`
    <svg class="ink" viewBox="0 0 1 1" preserveAspectRatio="none" aria-hidden="true" ?data-pen=${pen !== null} data-erase=${pen?.erase ? "" : nothing}
      @pointerdown=${pen ? (/** @type {PointerEvent} */ event) => draw(event, { ink, pen }, changed) : nothing}>
      ${ink.map((stroke) => svg`<path class=${`stroke ink-${stroke.colour}`} d=${pathOf(stroke)} vector-effect="non-scaling-stroke" />`)}</svg>
    ${spot ? html`<div class="spotlight" aria-hidden="true" style=${`--x:${spot[0] * 100}%;--y:${spot[1] * 100}%`}></div>` : nothing}`;
}

/** From pressing to letting go. @param {PointerEvent} event @param {{ink: readonly Stroke[], pen: {colour: number, erase: boolean}}} inked @param {(strokes: Stroke[]) => void} changed */
function draw(event, { ink, pen }, changed) {
  if (event.button !== 0) return;
  event.preventDefault();
  const board = /** @type {SVGElement} */ (event.currentTarget);
  board.setPointerCapture(event.pointerId);
  const frame = board.getBoundingClientRect();
  const at = ({ clientX, clientY } = event) => pointIn(clientX, clientY, frame);
  let strokes = pen.erase
    ? erased(ink, at(), frame.height / frame.width)
    : withStroke(ink, { colour: pen.colour, points: [at()] });
  changed(strokes);
  const ended = new AbortController();
  const { signal } = ended;
  board.addEventListener(
    "pointermove",
    (moved) => {
      const all = moved.getCoalescedEvents?.() ?? [];
      for (const one of all.length ? all : [moved])
        strokes = pen.erase ? erased(strokes, at(one), frame.height / frame.width) : drawnOn(strokes, at(one));
      changed(strokes);
    },
    { signal },
  );
  for (const end of ["pointerup", "pointercancel"]) board.addEventListener(end, () => ended.abort(), { signal });
}
