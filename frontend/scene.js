/** The driver: it alone knows the parts, and connects session, clock, views and address. */

import { render } from "lit-html";
import { createClock } from "./model/clock.js";
import { createSession } from "./model/session.js";
import { START } from "./model/state.js";
import { documentIn, OWN, readDraft } from "./model/own.js";
import { createStore } from "./model/store.js";
import { translator } from "./model/catalog.js";
import { readPlace, startLanguage, writePlace } from "./model/url.js";
import { createVisits } from "./model/visits.js";
import { api, send } from "./server.js";
import { expectLong } from "./view/formula.js";
import { follow } from "./view/links.js";
import { everyFrame } from "./view/frames.js";
import { enterFullscreen, toggleFullscreen } from "./view/fullscreen.js";
import { dressed, stopTitle } from "./view/header.js";
import { announce, createReach, toggleSubsteps } from "./view/reach.js";
import { add } from "./view/lectures/adding.js";
import { isGuest } from "./view/guest.js";
import { keeper } from "./view/keeper.js";
import { listen } from "./view/keys.js";
import { linkHighlights } from "./view/highlight.js";
import { createAside } from "./view/aside.js";
import { createMotion } from "./view/motion.js";
import { missed } from "./view/missed.js";
import { page } from "./view/page.js";

/** Pixels across a printed page. */
const SHEET = 640;

const root = /** @type {HTMLElement} */ (document.getElementById("page"));
const still = matchMedia("(prefers-reduced-motion: reduce)");
const dark = matchMedia("(prefers-color-scheme: dark)");
const store = createStore(START);
const clock = createClock();
const reach = createReach(root);
const session = createSession(store, api, clock);
const visits = createVisits(history, () => performance.now(), { embedded: window.parent !== window });

const motion = createMotion({ root, state: store.get, clock, session, send, still, update });

const aside = createAside({ root, store, api, session, send, changed: update, play: motion.play });

/** Into lecture mode, over the whole screen. */
function enterLecture() {
  session.move({ view: "lecture", edit: "" });
  enterFullscreen();
}

/** The presenter's window belongs to a lecture. */
async function present() {
  session.move({ view: "lecture", edit: "" });
  (await aside.lecture.want())?.present();
}

/** What is shown becomes a stop of the viewer's lecture; a lecture that is being given gets no more stops. @param {import("./view/page.js").View} shown */
const addShown = (shown) => isGuest() || add(stopTitle(shown), shown.t);

function view() {
  const state = store.get();
  const section = (/** @type {string} */ name) => state.catalog[name] ?? {};
  const methods = translator(section("methods"));
  /** @type {import("./view/page.js").View} */
  const view = {
    state,
    session,
    clock,
    togglePlay: motion.play,
    scrub: motion.scrub,
    setSpeed: (speed) => session.move({ speed }),
    instruments: motion.instruments,
    fullscreen: toggleFullscreen,
    enterLecture,
    editor: aside.editor.part,
    lecture: aside.lecturing(),
    overlays: aside.overlays(),
    missed: (t) => missed([...motion.tools(), ...aside.tools()], t),
    t: translator({ ...section("page"), ...section("editor"), ...section("lecture"), ...section("figure") }),
    methodTitle: (id) =>
      [methods(`${id}.title`), state.methods.find((m) => m.id === id)?.title].find((x) => x && x !== `${id}.title`) ??
      id,
    link: (patch) =>
      location.pathname +
      writePlace({ ...state.place, ...patch }) +
      ((patch.scene ?? state.place.scene) === OWN ? state.fragment : ""),
    follow,
    reload: () => void session.start(state.place),
  };
  return { ...view, why: motion.instruments?.why(view), integrals: motion.instruments?.integrals(view) };
}

function update() {
  const current = view();
  const { state } = current;
  const { place } = state;
  const theme = dressed(place, dark.matches);
  // A page that opens as a lecture shows nothing before that would move.
  if (place.view && !current.lecture && !aside.lecture.failed && !state.failures.page && !root.querySelector("main"))
    return void aside.lecture.want();
  if (!state.catalog.page && !state.failures.page) return;
  clock.setSpeed(place.speed);
  document.title = current.t("title");
  render(page(current), root);
  aside.update();
  motion.show(theme);
  visits.keep(place, current.link({}));
  if (reach(place.step, still.matches)) announce(state.lines, place.step, current.t);
  if (!awaitsLecture()) pressEarlyKeys();
}

/** Lecture mode is wanted and not there yet: its keys are not lost meanwhile. */
function awaitsLecture() {
  const { place, failures } = store.get();
  return Boolean(place.view) && !failures.page && !aside.lecture.failed && !aside.lecturing();
}

for (const event of ["pointermove", "keydown", "focusin"]) document.addEventListener(event, expectLong, { once: true });
store.subscribe(update);
dark.addEventListener("change", update);
linkHighlights(root);
const pressEarlyKeys = listen(document, {
  waiting: awaitsLecture,
  go: (by) => (aside.lecturing() ?? session).go(by),
  more: () => aside.lecturing()?.keys ?? {},
  fullscreen: toggleFullscreen,
  overlay: session.overlay,
  play: motion.play,
  lecture: enterLecture,
  presenter: () => void present(),
  add: () => void addShown(view()),
  covered: () => store.get().overlay !== "",
  uncover: () => session.overlay(""),
  substeps: () => toggleSubsteps(root, store.get().place.step),
  undo: visits.undo,
  redo: visits.redo,
});

/** Back and forward show a place again without loading the page. */
window.addEventListener("popstate", () => {
  const there = readPlace(location.search);
  const place = { ...there, lang: store.get().place.lang, theme: store.get().place.theme };
  visits.returned(place);
  if (place.scene === OWN && location.hash.length > 1 && location.hash !== store.get().fragment) void start();
  else void session.restore(place);
});

everyFrame(clock.advance);

/** On paper the drawing keeps the size for which its labels were placed, made smaller where a sheet is narrower. */
window.addEventListener("beforeprint", () => {
  const frame = /** @type {HTMLElement | null} */ (root.querySelector(".drawing"));
  if (!frame) return;
  const { clientWidth: width, clientHeight: height } = frame;
  frame.style.cssText += `;--print-width:${width}px;--print-height:${height}px;--print-zoom:${Math.min(1, SHEET / width)}`;
});

async function start() {
  if (new URLSearchParams(location.search).get("view") === "print")
    return location.replace(location.href.replace("/scene", "/handout"));
  const asked = readPlace(location.search);
  if (asked.step) void expectLong();
  const sent = await documentIn(location.hash);
  const scene = sent || location.hash === "#edit" ? OWN : asked.scene;
  const own = sent ?? (scene === OWN ? (readDraft(keeper())?.document ?? null) : null);
  const edit = scene === OWN && !own ? "form" : location.hash === "#edit" ? "form" : asked.edit;
  await session.start({ ...asked, scene, edit, lang: startLanguage(asked.lang, navigator.languages) }, own);
}
void start();
