/** Giving an own lecture: its frames, its keys, pen and light, and the line to the presenter's window. */

import { render } from "lit-html";
import { backward, jumped, onward, started, wantedStep } from "../../model/lectures/giving.js";
import { COLOURS, pointIn } from "../../model/lectures/ink.js";
import { createHallLine, nameOf } from "../../model/lectures/line.js";
import { frameOf, hasSteps } from "../../model/lectures/place.js";
import { plainly } from "../../model/prose.js";
import { createStore } from "../../model/store.js";
import { toggleFullscreen } from "../fullscreen.js";
import { createFrames, newId } from "./frames.js";
import { hall } from "./hall.js";

const FIELDS = "input, select, textarea, math-field, [contenteditable]";
const PRESSED = "button, a, summary";

/**
 * @param {{root: HTMLElement, lecture: import("../../model/lectures/lecture.js").Lecture, reader: {lang: string, theme: string},
 *   at: number, t: import("../../model/catalog.js").Translate, moved: (index: number) => void, left: () => void}} room
 */
export function openHall({ root, lecture, reader, at, t, moved, left }) {
  const { stops } = lecture;
  const id = newId();
  const ended = new AbortController();
  const { signal } = ended;
  const store = createStore({
    given: started(stops, at),
    black: false,
    overview: false,
    chosen: -1,
    ink: /** @type {readonly import("../../model/lectures/ink.js").Stroke[]} */ ([]),
    pen: /** @type {{colour: number, erase: boolean} | null} */ (null),
    spotted: false,
    spot: /** @type {import("../../model/lectures/ink.js").Point | null} */ (null),
    heard: 0,
  });
  const { get, set } = store;
  /** @type {import("./frames.js").Frames | null} */
  let frames = null;
  let drawnAt = "";

  const stopNow = () => stops[get().given.index];
  const here = () => frames?.here(stopNow().place) ?? null;

  /** What leads to another stop asks its frame to show the step at which it begins. @param {import("../../model/lectures/giving.js").Led} led */
  function lead({ given, go }) {
    const before = get().given;
    set({ given, chosen: -1, black: false });
    if (go) frames?.wish(stopNow().place, { kind: "go", by: go });
    else if (given.index !== before.index) arrive(before.index);
  }

  /** @param {number} from */
  function arrive(from) {
    const { given } = get();
    const stop = stops[given.index];
    const { step, part } = wantedStep(stops, given);
    const begins = step || frames?.here(stop.place)?.lines[0]?.step.id || "";
    if (hasSteps(stop.place) && begins) frames?.wish(stop.place, { kind: "goTo", step: begins, part });
    if (frameOf(stops[from].place) !== frameOf(stop.place) && document.activeElement instanceof HTMLIFrameElement)
      /** @type {HTMLElement | null} */ (root.querySelector(".stage"))?.focus({ preventScroll: true });
    const announcer = document.getElementById("announcer");
    if (announcer) announcer.textContent = `${given.index + 1}: ${plainly(stop.title)}`;
    moved(given.index);
  }

  const acts = {
    /** @param {1 | -1} by */
    go: (by) => lead((by > 0 ? onward : backward)(stops, get().given, here())),
    /** @param {number} index */
    to(index) {
      set({ overview: false });
      lead({ given: jumped(stops, get().given, index, here()) });
    },
    /** @param {number} chosen */
    choose(chosen) {
      acts.go(1);
      set({ chosen });
    },
    overview: () => set({ overview: !get().overview }),
    blacken: () => set({ black: !get().black }),
    takePen: () => set({ pen: get().pen ? null : { colour: 0, erase: false } }),
    /** @param {number} colour */
    colour: (colour) => set({ pen: { colour, erase: false } }),
    erase: () => set({ pen: { colour: get().pen?.colour ?? 0, erase: !get().pen?.erase } }),
    wipe: () => set({ ink: [] }),
    spot: () => set({ spotted: !get().spotted, spot: null }),
    present() {
      const theme = reader.theme === "auto" ? "" : `&theme=${reader.theme}`;
      window.open(`/lecture?with=${id}&lang=${reader.lang}${theme}`, `presenter-${id}`, "popup,width=1200,height=780");
    },
    fullscreen: toggleFullscreen,
    leave() {
      ended.abort();
      frames?.close();
      line.close();
      if (document.fullscreenElement) void document.exitFullscreen();
      left();
    },
    /** @param {import("../../model/lectures/ink.js").Stroke[]} ink */
    ink: (ink) => set({ ink }),
  };

  /** @type {Record<string, () => void>} */
  const keys = {
    ...Object.fromEntries(["ArrowRight", " ", "n", "PageDown"].map((key) => [key, () => acts.go(1)])),
    ...Object.fromEntries(["ArrowLeft", "p", "PageUp"].map((key) => [key, () => acts.go(-1)])),
    Home: () => acts.to(0),
    End: () => acts.to(stops.length - 1),
    b: acts.blacken,
    ".": acts.blacken,
    o: acts.overview,
    g: acts.overview,
    Escape: () => (get().pen ? acts.takePen() : acts.overview()),
    d: acts.takePen,
    c: () => acts.colour(((get().pen?.colour ?? -1) + 1) % COLOURS),
    x: acts.wipe,
    h: acts.spot,
    s: acts.present,
    f: toggleFullscreen,
    l: acts.leave,
  };

  /** @param {KeyboardEvent} event */
  function press(event) {
    const { key, ctrlKey, metaKey, altKey, target, isTrusted } = event;
    // What a frame is told by the hall is not asked of the hall again.
    const from = /** @type {Element | null} */ (target && "closest" in target ? target : null);
    if (!isTrusted && from?.ownerDocument !== document) return;
    if (ctrlKey || metaKey || altKey || from?.closest(FIELDS)) return;
    if ((key === " " || key === "Enter") && from?.closest(PRESSED)) return;
    if (from?.closest("dialog")) return;
    const action = keys[key.length === 1 ? key.toLowerCase() : key];
    if (action) {
      event.preventDefault();
      event.stopImmediatePropagation();
      if (get().black) set({ black: false });
      else action();
    } else if (from?.ownerDocument === document && key !== "Tab" && key !== "Enter")
      frames?.press(stopNow().place, event);
  }

  /** @param {PointerEvent} event */
  function shine({ clientX, clientY, view }) {
    const stage = root.querySelector(".stage")?.getBoundingClientRect();
    if (!get().spotted || !stage) return;
    const [dx, dy] = view === window ? [0, 0] : [stage.left, stage.top];
    set({ spot: pointIn(clientX + dx, clientY + dy, stage) });
  }

  const line = createHallLine(new BroadcastChannel(nameOf(id)), lecture, {
    standing() {
      const { given, black, ink, spot } = get();
      const { width = 0, height = 0 } = root.querySelector(".stage")?.getBoundingClientRect() ?? {};
      return {
        index: given.index,
        phase: given.phase,
        at: here()?.at ?? wantedStep(stops, given),
        black,
        ink,
        spot,
        size: [Math.round(width), Math.round(height)],
      };
    },
    wish(wish) {
      if (wish.kind === "go") acts.go(wish.by);
      else if (wish.kind === "to") acts.to(wish.index);
      else if (wish.kind === "black") acts.blacken();
      else if (wish.kind === "ink") set({ ink: wish.strokes });
      else set({ spot: wish.at });
    },
  });

  /** What was drawn over a slide goes with it. */
  function wipeWhereMoved() {
    const now = JSON.stringify([get().given.index, here()?.at ?? null]);
    if (drawnAt && now !== drawnAt) set({ ink: [] });
    drawnAt = now;
  }

  function update() {
    const { given, ...shown } = get();
    const stop = stops[given.index];
    const hidden = given.phase === "asked" && stop.hide === true;
    const { count = 0 } = frames ?? {};
    const view = {
      ...shown,
      lecture,
      given,
      count,
      ready: frames?.ready() ?? 0,
      covered: hidden && !hasSteps(stop.place),
    };
    render(hall(view, acts, t), root);
    wipeWhereMoved();
    frames?.show(stop.place, hidden);
    /** @type {HTMLDialogElement | null} */ (root.querySelector("dialog:not([open])"))?.showModal();
    line.tell();
  }

  update();
  frames = createFrames(/** @type {HTMLElement} */ (root.querySelector(".frames")), startingWith(stops, at), reader, {
    heard: () => set({ heard: get().heard + 1 }),
    opened(window) {
      window.addEventListener("keydown", press, { capture: true, signal });
      window.addEventListener("pointermove", shine, { capture: true, signal });
    },
  });
  const unsubscribe = store.subscribe(update);
  signal.addEventListener("abort", () => unsubscribe());
  window.addEventListener("keydown", press, { capture: true, signal });
  window.addEventListener("pointermove", shine, { signal });
  window.addEventListener("resize", update, { signal });
  /** @type {HTMLElement | null} */ (root.querySelector(".stage"))?.focus({ preventScroll: true });
  update();
}

/** The stops in the order in which their pages are needed: those before the first one last. @param {readonly import("../../model/lectures/lecture.js").Stop[]} stops @param {number} at */
const startingWith = (stops, at) => [...stops.slice(at), ...stops.slice(0, at)];
