/** Dragging a body or a point of the drawing: it sets the initial values, or δq while the variation is shown. */

import { html, render } from "lit-html";
import { placeOf } from "../../model/drawing/stage.js";
import { brought, movable, nearest, startedAt } from "../../model/kinematics/hand.js";
import { configured } from "../../model/kinematics/kinematics.js";
import { inLanguage } from "../../model/catalog.js";

/** @typedef {import("../../model/types.js").Pixel} Pixel */
/** @typedef {import("./open.js").Bench} Bench */

/** Pixels within which a hand finds a place, and by which an arrow key moves it. */
const NEAR = 26;
const STRIDE = 8;
/** @type {Record<string, Pixel>} */
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

/** @param {Bench} bench @param {ReturnType<typeof import("./virtual.js").createVirtual>} virtual */
export function createHand(bench, virtual) {
  const { frame, parts: { drawing }, state, session, clock } = bench;
  const handles = document.createElement("div");
  handles.className = "handles";
  frame.append(handles);
  /** @type {{place: string, q: import("../../model/kinematics/expression.js").Values, resume: boolean} | null} */
  let held = null;
  /** The initial values that the motion does not have yet. @type {{q: import("../../model/kinematics/expression.js").Values, resume: boolean} | null} */
  let awaited = null;

  /** Everything there is to hold on to, or null. */
  function around() {
    const [kinematics, now, { stage }, { scene }] = [bench.kinematics(), bench.now(), drawing, state()];
    return kinematics && now && stage && scene ? { kinematics, now, stage, scene } : null;
  }

  function places() {
    const all = around();
    return all ? movable(all.kinematics, all.now, all.stage) : [];
  }

  /** @param {string} place @returns {Pixel} */
  function where(place) {
    const all = around();
    return all ? placeOf(all.stage, all.now, place) : [0, 0];
  }

  /** @param {PointerEvent} event @returns {Pixel} */
  const at = (event) => {
    const box = frame.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };

  /** @param {string} place */
  function take(place) {
    const all = around();
    if (!all) return;
    const varied = state().place.vary;
    held = { place, q: varied ? virtual.varied() ?? all.now.coordinates : all.now.coordinates, resume: clock.playing && !varied };
    clock.play(false);
    if (varied) return;
    clock.seek(0);
    session.move({ at: 0 });
  }

  /** @param {Pixel} hand */
  function lead(hand) {
    const all = around();
    if (!held || !all) return;
    const { kinematics, now, scene } = all;
    const q = brought(all, held.place, held.q, hand);
    held.q = q;
    if (state().place.vary) return virtual.vary(q);
    drawing.hold(configured(kinematics, now, q));
    awaited = { q, resume: false };
    session.change(startedAt(state().changes, scene, kinematics, q));
  }

  function release() {
    if (held && awaited) awaited.resume = held.resume;
    else if (held?.resume) clock.play(true);
    held = null;
    frame.classList.remove("held");
  }

  /** The motion that begins where the hand left off has come, or will not come. */
  function arrived() {
    const { trajectory, failures, simulating, changes } = state();
    if (!awaited || held || simulating) return;
    const starts = Object.entries(changes.initial).every(([name, { value }]) => !(Math.abs((trajectory?.coordinates[name]?.[0] ?? NaN) - value) > 1e-6));
    if (!starts && !failures.simulation) return;
    const { resume } = awaited;
    awaited = null;
    drawing.hold(null);
    drawing.draw(clock.time);
    if (resume) clock.play(true);
  }

  /** @param {KeyboardEvent} event @param {string} place */
  function press(event, place) {
    const arrow = ARROWS[event.key];
    if (!arrow) return;
    event.preventDefault();
    event.stopPropagation();
    take(place);
    const stride = event.shiftKey ? 1 : STRIDE;
    const [x, y] = held && state().place.vary ? virtual.where(place) : awaited ? placeNow(place) : where(place);
    lead([x + stride * arrow[0], y + stride * arrow[1]]);
    release();
  }

  /** Where a place stands that the motion has not followed to yet. @param {string} place @returns {Pixel} */
  function placeNow(place) {
    const all = around();
    if (!all || !awaited) return [0, 0];
    if (held) held.q = awaited.q;
    return all.stage.project(all.kinematics.places(awaited.q, all.now.t)[place]);
  }

  frame.addEventListener("pointerdown", (event) => {
    const place = event.target instanceof Element && event.target.closest("button") ? "" : nearest(places(), where, at(event), NEAR);
    if (!place || event.button) return;
    frame.setPointerCapture(event.pointerId);
    frame.classList.add("held");
    take(place);
  });
  frame.addEventListener("pointermove", (event) => {
    if (held) lead(at(event));
    else frame.classList.toggle("near", !event.buttons && nearest(places(), where, at(event), NEAR) !== "");
  });
  for (const end of ["pointerup", "pointercancel"]) frame.addEventListener(end, release);

  return {
    /** For those who use keys: a button at each place. @param {import("../page.js").View} view */
    handles({ state, t }) {
      const name = (/** @type {string} */ place) => inLanguage(state.scene?.labels?.[place], state.place.lang) || place;
      render(places().map((place) => html`<button class="handle ${state.scene?.bodies.some((body) => body.name === place) ? `body-${place}` : ""}" data-place=${place} aria-label=${t("hand.handle", { place: name(place) })}
        @keydown=${(/** @type {KeyboardEvent} */ event) => press(event, place)}></button>`), handles);
    },
    move() {
      arrived();
      if (clock.playing && !handles.contains(document.activeElement)) return;
      for (const handle of handles.children) {
        const place = /** @type {HTMLElement} */ (handle).dataset.place ?? "";
        const [x, y] = awaited ? placeNow(place) : where(place);
        /** @type {HTMLElement} */ (handle).style.transform = `translate(${x}px, ${y}px)`;
      }
    },
  };
}
