/** Lecture mode: its keys, gestures and pointer, and the line to the presenter's window. */

import { createSender, isId, nameOf } from "../../model/lecture/link.js";
import { allOrNone, isConcluded, onwards, partsOf, within } from "../../model/lecture/stops.js";
import { indexOf } from "../../model/reveal.js";
import { expectLong } from "../formula.js";
import { isGuest } from "../guest.js";
import { windowKeeper } from "../keeper.js";
import { createAsking } from "./asking.js";
import { createFilled } from "./filled.js";
import { createFlights } from "./flights.js";
import { createNewest } from "./newest.js";
import { bodiesOf, formulas, slide } from "./slide.js";
import { createSpot } from "./spot.js";

/** @typedef {import("../page.js").View} View */
/**
 * @typedef {object} Lecturing  what the slide may do
 * @property {(by: number) => void} go
 * @property {() => void} present
 * @property {() => void} leave
 * @property {() => void} spot
 * @property {boolean} spotted
 * @property {import("./asking.js").Asking} asking
 * @property {{start: (event: TouchEvent) => void, end: (event: TouchEvent) => void}} touch
 */

/** Pixels a finger must have moved sideways to turn the page. */
const SWIPE = 60;
const KEY = "deltaq.lecture";
const BESIDE = /** @type {const} */ (["", "plots", "nothing"]);

/** The name of this lecture's line, the same after a reload where the browser keeps it; a hall gives each of its frames one. */
function lineId() {
  if (isGuest()) return window.name;
  const keeper = windowKeeper();
  const kept = keeper.getItem(KEY);
  if (isId(kept)) return /** @type {string} */ (kept);
  const made = Array.from(crypto.getRandomValues(new Uint8Array(10)), (byte) => (byte % 36).toString(36)).join("");
  try {
    keeper.setItem(KEY, made);
  } catch {
    // Only a reload will not find the presenter's window again.
  }
  return made;
}

/** A step and its substeps. @param {import("../../model/reveal.js").Line | undefined} line */
const seenOf = (line) => (line ? [line.step, ...partsOf(line.step).map(({ step }) => step)] : []);

/** @param {(by: number) => void} go */
function createTouch(go) {
  let from = { x: 0, y: 0 };
  return {
    start(/** @type {TouchEvent} */ { touches }) {
      from = { x: touches[0].clientX, y: touches[0].clientY };
    },
    end(/** @type {TouchEvent} */ { changedTouches, target }) {
      const [dx, dy] = [changedTouches[0].clientX - from.x, changedTouches[0].clientY - from.y];
      const formula = /** @type {Element} */ (target).closest(".formula");
      const scrolls = formula !== null && formula.scrollWidth > formula.clientWidth + 1;
      if (!scrolls && Math.abs(dx) > SWIPE && Math.abs(dx) > 2 * Math.abs(dy)) go(dx < 0 ? 1 : -1);
    },
  };
}

/**
 * @typedef {object} Lectured  the page that is lectured from
 * @property {HTMLElement} root
 * @property {Pick<View["session"], "goTo" | "move" | "overlay">} session
 * @property {() => Pick<View["state"], "place" | "overlay" | "lines" | "derivation">} state
 * @property {() => {scene: string, title: Record<string, string>}} about  under which name notes are kept, and the title
 * @property {() => void} changed
 * @property {() => void} play
 * @property {import("./asking.js").Poll} [poll]  what a hall may be asked about a step
 */

/** @param {Lectured} page */
export function open({ root, session, state, about, changed, play, poll }) {
  const id = lineId();
  const spot = createSpot(root);
  const reachNewest = createNewest(root);
  if (isGuest()) void expectLong();
  const fill = createFilled(root);
  const flights = createFlights(root);
  /** The slide that is shown, or is about to be. */
  let slideShown = "";
  /** @type {ReturnType<typeof formulas>} */
  let shownNow = [];
  /** @type {ReturnType<typeof bodiesOf>} */
  let bodies = [];

  const stopAt = (/** @type {import("../../model/lecture/stops.js").Stop} */ { step, part }) =>
    session.goTo(step, part);
  const shown = () => state().place.step || state().lines[0]?.step.id;
  const subject = () => `${about().scene} ${state().place.n} ${state().place.lang}`;
  const asking = createAsking({ changed, poll, shown, subject });
  /** What is hidden is revealed before anything else comes. @param {number} by @param {import("../../model/types.js").Pace} [pace] */
  const go = (by, pace = state().place.pace) => {
    const { lines, place } = state();
    const line = lines[indexOf(lines, place.step)];
    const concludes = line && isConcluded(line.step, place.part);
    if (!(by === 1 && concludes && asking.reveal())) stopAt(onwards(lines, place, by, pace));
  };
  const step = (/** @type {number} */ by) => stopAt(within(state().lines, state().place, by));
  const turn = () => session.move({ beside: BESIDE[(BESIDE.indexOf(state().place.beside) + 1) % BESIDE.length] });

  const sender = createSender(new BroadcastChannel(nameOf(id)), {
    here() {
      const { place, overlay, derivation } = state();
      const { scene, title } = about();
      return { place: { ...place, scene }, overlay, title, bodies, chapters: derivation?.chapters ?? [] };
    },
    wish(wish) {
      if (wish.kind === "go") go(wish.by);
      else if (wish.kind === "within") step(wish.by);
      else if (wish.kind === "goTo") session.goTo(wish.step, wish.part);
      else if (wish.kind === "overlay") session.overlay("black");
      else if (wish.kind === "play") play();
    },
  });

  function present() {
    const { lang, theme } = state().place;
    window.open(
      `/presenter?with=${id}&lang=${lang}${theme === "auto" ? "" : `&theme=${theme}`}`,
      `presenter-${id}`,
      "popup,width=1200,height=780",
    );
  }

  function leave() {
    session.move({ view: "", part: 0 });
    if (document.fullscreenElement) void document.exitFullscreen();
  }

  function pointOut() {
    spot.toggle();
    changed();
  }

  const explained = () => state().place.why === shown();

  /** The law of the step that is shown, and what it changes. */
  function why() {
    session.move({ why: explained() ? "" : shown() });
  }

  const touch = createTouch(go);
  /** What keys mean here besides what they always mean. @type {Record<string, () => void>} */
  const keys = {
    " ": () => go(1, "substeps"),
    q: asking.toggle,
    ...Object.fromEntries([0, 1, 2, 3].map((i) => [String(i + 1), () => asking.choose(i)])),
    ArrowDown: () => step(1),
    ArrowUp: () => step(-1),
    e: () => stopAt(allOrNone(state().lines, state().place)),
    t: () => session.move({ pace: state().place.pace ? "" : "substeps" }),
    d: turn,
    h: pointOut,
    l: leave,
    w: why,
  };
  return {
    go,
    present,
    leave,
    /** Those, and Esc while a law is open: it closes that first. */
    get keys() {
      return { ...keys, ...(explained() ? { Escape: why } : {}) };
    },
    slide(/** @type {import("./slide.js").Shown} */ view) {
      const { place, lines } = view.state;
      const line = lines[indexOf(lines, place.step)];
      const next = `${shown()} ${place.part} ${asking.veiled()}`;
      // What stands there still is what the terms of the next one come from.
      if (slideShown && next !== slideShown) flights.look(lines.slice(0, (line?.index ?? 0) + 2).flatMap(seenOf));
      slideShown = next;
      shownNow = formulas(view, asking.veiled());
      bodies = bodiesOf(view);
      return slide(view, { go, present, leave, spot: pointOut, spotted: spot.on, touch, asking });
    },
    /** Called when anything has changed. */
    update() {
      sender.tell();
      if (state().place.view) fill(shownNow);
      flights.update(slideShown, seenOf(state().lines[indexOf(state().lines, state().place.step)]));
      reachNewest();
      if (!state().place.view) spot.off();
    },
  };
}

/** @typedef {ReturnType<typeof open>} Lecture */
