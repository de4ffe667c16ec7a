/** All that moves with the clock: drawing, plots, read-outs and slider, and the instruments to take it in hand. */

import { createLater } from "../model/later.js";
import { translator } from "../model/catalog.js";
import { fixed } from "../model/numbers.js";
import { sheet } from "./bring.js";
import { createDrawing } from "./drawing.js";
import { isGuest } from "./guest.js";
import { createTransport } from "./player.js";
import { createPlots } from "./plots.js";
import { createReadouts } from "./readouts.js";

/** Milliseconds until the instruments come without a hand at the page. */
const PATIENCE = 8000;

/**
 * @param {{root: HTMLElement, state: () => import("../model/state.js").State, clock: import("../model/clock.js").Clock,
 *   session: import("./page.js").View["session"], send: typeof fetch, still: MediaQueryList, update: () => void}} around
 */
export function createMotion({ root, state, clock, session, send, still, update }) {
  const find = (/** @type {string} */ selector) => /** @type {HTMLElement} */ (root.querySelector(selector));
  /** @type {ReturnType<typeof assemble> | null} */
  let parts = null;
  let begun = false;

  const instruments = createLater(async () => {
    const [{ open }] = await Promise.all([import("./figure/open.js"), sheet("instruments")]);
    return open({
      root,
      frame: find(".drawing"),
      parts: /** @type {NonNullable<typeof parts>} */ (parts),
      state,
      clock,
      session,
      send,
      seek: scrub,
    });
  }, update);

  function assemble() {
    const made = {
      drawing: createDrawing(find(".drawing")),
      plots: createPlots(find(".plots"), { seek: scrub, changed: update }),
      readouts: createReadouts(find(".readouts")),
      transport: createTransport(find(".player")),
    };
    new ResizeObserver(() => made.drawing.resize(clock.time)).observe(find(".drawing"));
    // Not pointerover: browsers send it for a mouse that rests while the page is laid out under it.
    for (const event of ["pointermove", "pointerdown", "focusin", "keydown"])
      document.addEventListener(event, () => void instruments.want(), { once: true });
    setTimeout(() => void instruments.want(), isGuest() ? 0 : PATIENCE);
    return made;
  }

  /** The moment as a sentence, for those who do not see it. @param {number} t @param {string} values */
  function moment(t, values) {
    const { catalog, place } = state();
    return translator(catalog.page ?? {})("drawing.moment", {
      time: fixed(t, 2, place.lang),
      values,
    });
  }

  /** Shows the moment t everywhere. @param {number} t */
  function move(t) {
    if (!parts) return;
    parts.drawing.draw(t);
    parts.plots.move(t);
    parts.readouts.move(t);
    parts.transport.move(t, clock, state().place.lang);
    instruments.part?.move();
    if (!clock.playing) parts.transport.scrub.setAttribute("aria-valuetext", moment(t, parts.readouts.text(t)));
  }

  /** The motion begins by itself once, unless the viewer prefers rest or was sent to a moment. */
  function begin() {
    if (begun || !state().trajectory) return;
    begun = true;
    if (state().place.at) clock.seek(state().place.at);
    else if (!still.matches && !state().place.vary) play();
  }

  /** A resting motion has its moment in the address. @param {boolean} on @param {number} [t] */
  function set(on, t) {
    clock.play(on);
    if (t !== undefined) clock.seek(t);
    session.move({ at: on ? 0 : Math.round(clock.time * 100) / 100 });
    update();
  }
  const play = () => set(!clock.playing);
  const scrub = (/** @type {number} */ t) => set(false, t);
  clock.subscribe(move);

  return {
    play,
    scrub,
    get instruments() {
      return instruments.part;
    },
    /** @returns {import("./missed.js").Missable[]} */
    tools: () => [
      { says: "missed.instruments", later: instruments, wanted: true },
      ...(parts ? [{ says: "missed.plots", later: parts.plots.library, wanted: true }] : []),
    ],
    /** What the page holds, after it has been rendered. @param {string} theme */
    show(theme) {
      const { scene, trajectory, runs, place, lines, failures } = state();
      parts ??= assemble();
      // The drawing keeps clear of them.
      parts.readouts.show(scene, trajectory, place.lang);
      parts.drawing.show(scene, trajectory, clock.time);
      // The first step is to be read before the plots cost anything.
      const readable = lines.length > 0 || failures.derivation;
      parts.plots.show(
        readable && scene && trajectory
          ? { scene, trajectory, runs, duration: place.duration, lang: place.lang, theme, look: place.plot }
          : null,
      );
      if (place.vary || place.with || place.release || place.runs || place.why || place.plot) void instruments.want();
      instruments.part?.show();
      begin();
      move(clock.time);
    },
  };
}

/** @typedef {Pick<ReturnType<typeof createMotion>, "play" | "scrub">} Motion */
/** @typedef {{drawing: ReturnType<typeof createDrawing>, plots: ReturnType<typeof createPlots>}} Parts */
