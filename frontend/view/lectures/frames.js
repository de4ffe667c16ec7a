/** The pages of a lecture, each in a frame of its own: all are fetched beforehand, so that none is waited for. */

import { createReceiver, nameOf } from "../../model/lecture/link.js";
import { frameAddress, frameOf, framesOf, hasSteps } from "../../model/lectures/place.js";
import { linesOf } from "../../model/reveal.js";

/** @typedef {import("../../model/lectures/giving.js").Here} Here */
/** @typedef {import("../../model/lectures/lecture.js").Stop} Stop */
/** @typedef {import("../../model/lecture/link.js").Wish} Wish */
/** @typedef {{key: string, place: string, element: HTMLIFrameElement, line: ReturnType<typeof createReceiver> | null, channel: BroadcastChannel | null,
 *   here: Here | null, loaded: boolean, later: Wish | null}} Frame  later: what it is told as soon as it hears */

/** Milliseconds between two looks at what a page has fetched, and how many show nothing new when all is there. */
const [LOOK, QUIET] = [400, 5];

/** What stands on a page as long as something is fetched or measured. */
const UNDER_WAY = ".waiting, .measured[aria-busy=true]";

/** Comes true when a page has fetched all that it fetches by itself. @param {Window} page @returns {Promise<void>} */
const settled = (page) =>
  new Promise((done) => {
    let [fetched, quiet] = [-1, 0];
    const looking = setInterval(() => {
      const now = page.performance?.getEntriesByType("resource").length ?? fetched;
      const waits = page.document.querySelector(UNDER_WAY) !== null;
      quiet = now === fetched && !waits ? quiet + 1 : 0;
      fetched = now;
      if (quiet < QUIET) return;
      clearInterval(looking);
      done();
    }, LOOK);
  });

/** All fonts of formulas: a slide to come may need another one. @param {Document} page */
function fetchFonts(page) {
  for (const face of page.fonts) void face.load().catch(() => {});
}

/** Twelve letters and digits that no other frame has. */
export const newId = () =>
  Array.from(crypto.getRandomValues(new Uint8Array(12)), (byte) => (byte % 36).toString(36)).join("");

/**
 * @param {HTMLElement} holder @param {readonly Stop[]} stops @param {{lang: string, theme: string}} reader
 * @param {{heard: () => void, opened: (window: Window) => void}} tell  heard: a frame stands somewhere else, or has come
 */
export function createFrames(holder, stops, reader, { heard, opened }) {
  /** @type {Frame[]} */
  const frames = framesOf(stops).map(({ key, place }) => {
    const id = newId();
    const element = document.createElement("iframe");
    element.name = id;
    element.title = stops.find((stop) => frameOf(stop.place) === key)?.title ?? "";
    element.inert = true;
    const channel = hasSteps(place) ? new BroadcastChannel(nameOf(id)) : null;
    /** @type {Frame} */
    const frame = { key, place, element, channel, line: null, here: null, loaded: false, later: null };
    if (channel)
      frame.line = createReceiver(channel, (here) => {
        const { step, part, pace } = here.place;
        const lines = here.chapters ? linesOf(here.chapters) : (frame.here?.lines ?? []);
        frame.here = { lines, at: { step: step || lines[0]?.step.id || "", part }, pace };
        if (lines.length && frame.later) frame.line?.wish(frame.later);
        if (lines.length) frame.later = null;
        heard();
      });
    element.addEventListener("load", () => {
      const { contentDocument, contentWindow } = element;
      if (!contentDocument || !contentWindow || contentWindow.location.href === "about:blank") return;
      contentDocument.documentElement.dataset.hall = "away";
      opened(contentWindow);
      fetchFonts(contentDocument);
      next();
      heard();
      void settled(contentWindow).then(() => {
        frame.loaded = true;
        heard();
      });
    });
    return frame;
  });
  holder.append(...frames.map(({ element }) => element));

  /** One after another: the first is not kept waiting by the last. */
  function next() {
    const waiting = frames.find(({ element }) => !element.getAttribute("src"));
    if (waiting) waiting.element.src = frameAddress(waiting.place, reader);
  }
  const find = (/** @type {string} */ place) => frames.find(({ key }) => key === frameOf(place));

  next();
  fetchFonts(document);
  return {
    count: frames.length,
    /** How many have come, with their derivations. */
    ready: () => frames.filter(({ loaded, line, here }) => loaded && (!line || here?.lines.length)).length,
    /** @param {string} place @returns {Here | null} */
    here: (place) => find(place)?.here ?? null,
    /** @param {string} place @param {Wish} wish */
    wish(place, wish) {
      const frame = find(place);
      if (frame?.here?.lines.length) frame.line?.wish(wish);
      else if (frame) frame.later = wish;
    },
    /** Brings the frame of a place to the front. @param {string} place @param {boolean} veiled  whether its result is hidden */
    show(place, veiled) {
      const shown = find(place);
      for (const { element } of frames) {
        const front = element === shown?.element;
        if (element.inert === front) element.inert = !front;
        element.classList.toggle("front", front);
        const page = element.contentDocument?.documentElement;
        if (page?.dataset.hall === undefined) continue;
        page.dataset.hall = front ? "" : "away";
        page.toggleAttribute("data-veiled", front && veiled);
      }
      if (shown && !shown.element.getAttribute("src")) shown.element.src = frameAddress(shown.place, reader);
      return shown?.element ?? null;
    },
    /** A key that means nothing here goes to the page that is shown. @param {string} place @param {KeyboardEvent} event */
    press(place, { key, shiftKey }) {
      const page = find(place)?.element.contentDocument;
      page?.body.dispatchEvent(new KeyboardEvent("keydown", { key, shiftKey, bubbles: true, cancelable: true }));
    },
    close() {
      for (const { channel } of frames) channel?.close();
      holder.replaceChildren();
    },
  };
}

/** @typedef {ReturnType<typeof createFrames>} Frames */
