/** The presenter's window of a hall: the same slide, small, with pen and light; notes, the time, and what comes next. */

import { render } from "lit-html";
import { createDeskLine, nameOf } from "../../model/lectures/line.js";
import { hasSteps } from "../../model/lectures/place.js";
import { STOPPED, toggled } from "../../model/lecture/timer.js";
import { createStore } from "../../model/store.js";
import { createFrames } from "./frames.js";
import { desk } from "./desk.js";

const TICK = 500;
/** Keys that mean the same in the hall. @type {Record<string, 1 | -1>} */
const STEPS = { ArrowRight: 1, " ": 1, n: 1, PageDown: 1, ArrowLeft: -1, p: -1, PageUp: -1 };

/**
 * @param {{root: HTMLElement, id: string, reader: {lang: string, theme: string}, t: import("../../model/catalog.js").Translate}} window_
 */
export function openDesk({ root, id, reader, t }) {
  const store = createStore({
    standing: /** @type {import("../../model/lectures/line.js").Standing | null} */ (null),
    lecture: /** @type {import("../../model/lectures/lecture.js").Lecture | null} */ (null),
    timer: STOPPED,
    now: Date.now(),
    pen: /** @type {{colour: number, erase: boolean} | null} */ (null),
    spotted: false,
    heard: 0,
  });
  const { get, set } = store;
  /** @type {import("./frames.js").Frames | null} */
  let frames = null;
  let asked = "";

  const line = createDeskLine(new BroadcastChannel(nameOf(id)), (standing) => {
    set({ standing, ...(standing.lecture ? { lecture: standing.lecture } : {}) });
  });

  const acts = {
    /** @param {1 | -1} by */
    go: (by) => line.wish({ kind: "go", by }),
    /** @param {number} index */
    to: (index) => line.wish({ kind: "to", index }),
    blacken: () => line.wish({ kind: "black" }),
    takePen: () => set({ pen: get().pen ? null : { colour: 0, erase: false }, spotted: false }),
    /** @param {number} colour */
    colour: (colour) => set({ pen: { colour, erase: false } }),
    erase: () => set({ pen: { colour: get().pen?.colour ?? 0, erase: !get().pen?.erase } }),
    wipe: () => acts.ink([]),
    /** @param {import("../../model/lectures/ink.js").Stroke[]} strokes */
    ink(strokes) {
      const { standing } = get();
      if (standing) set({ standing: { ...standing, ink: strokes } });
      line.wish({ kind: "ink", strokes });
    },
    spot() {
      const spotted = !get().spotted;
      set({ spotted, pen: null });
      if (!spotted) line.wish({ kind: "spot", at: null });
    },
    /** @param {import("../../model/lectures/ink.js").Point | null} at */
    shine: (at) => get().spotted && line.wish({ kind: "spot", at }),
    toggleTimer: () => set({ timer: toggled(get().timer, Date.now()), now: Date.now() }),
    resetTimer: () => set({ timer: STOPPED }),
  };

  /** The small slide shows what the hall shows. */
  function follow() {
    const { standing, lecture } = get();
    const stop = lecture?.stops[standing?.index ?? 0];
    if (!standing || !lecture || !stop) return;
    const holder = /** @type {HTMLElement} */ (root.querySelector(".frames"));
    frames ??= createFrames(
      holder,
      [...lecture.stops.slice(standing.index), ...lecture.stops.slice(0, standing.index)],
      reader,
      { heard: () => set({ heard: get().heard + 1 }), opened() {} },
    );
    frames.show(stop.place, false);
    const wanted = JSON.stringify([standing.index, standing.at]);
    if (wanted === asked) return;
    asked = wanted;
    const { step, part } = standing.at;
    if (hasSteps(stop.place) && step) frames.wish(stop.place, { kind: "goTo", step, part });
  }

  function update() {
    const { standing, lecture, ...view } = get();
    render(desk(standing && lecture ? { ...view, standing, lecture } : null, view, acts, t), root);
    fit();
    follow();
  }

  /** As large as there is room for, in the proportions of the hall, so that lines break as they do there. */
  function fit() {
    const room = /** @type {HTMLElement | null} */ (root.querySelector(".preview"));
    const [width, height] = get().standing?.size ?? [0, 0];
    if (!room || !width || !height) return;
    const scale = Math.min(room.clientWidth / width, room.clientHeight / height);
    room.style.cssText = `--width:${width}px;--height:${height}px;--scale:${scale}`;
  }

  store.subscribe(update);
  addEventListener("resize", fit);
  addEventListener("keydown", (event) => {
    const { key, ctrlKey, metaKey, altKey, target } = event;
    const pressed = target instanceof Element && target.closest("button, select") && key === " ";
    if (ctrlKey || metaKey || altKey || pressed) return;
    if (target instanceof Element && target.closest("select, input, textarea")) return;
    const name = key.length === 1 ? key.toLowerCase() : key;
    const by = STEPS[name];
    const action = by
      ? () => acts.go(by)
      : { b: acts.blacken, ".": acts.blacken, d: acts.takePen, h: acts.spot, x: acts.wipe }[name];
    if (!action) return;
    event.preventDefault();
    action();
  });
  setInterval(() => set({ now: Date.now() }), TICK);
  document.title = `δq · ${t("presenter")}`;
  update();
}
