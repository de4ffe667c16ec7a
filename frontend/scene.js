/** The driver: it alone knows the parts, and connects session, clock, views and address. */

import { render } from "lit-html";
import { createApi } from "./model/api.js";
import { createClock } from "./model/clock.js";
import { createLater } from "./model/later.js";
import { createSession } from "./model/session.js";
import { START } from "./model/state.js";
import { documentIn, keepDraft, OWN, readDraft } from "./model/own.js";
import { createStore } from "./model/store.js";
import { translator } from "./model/catalog.js";
import { readPlace, startLanguage, writePlace } from "./model/url.js";
import { fixed } from "./model/numbers.js";
import { createDrawing } from "./view/drawing.js";
import { createPlots } from "./view/plots.js";
import { createTransport } from "./view/player.js";
import { createReadouts } from "./view/readouts.js";
import { announce, createReach, toggleSubsteps } from "./view/reach.js";
import { listen } from "./view/keys.js";
import { linkHighlights } from "./view/highlight.js";
import { page } from "./view/page.js";

const root = /** @type {HTMLElement} */ (document.getElementById("page"));
const still = matchMedia("(prefers-reduced-motion: reduce)");
const dark = matchMedia("(prefers-color-scheme: dark)");
const store = createStore(START);
const clock = createClock();
const reach = createReach(root);
const api = createApi(fetch.bind(globalThis));
const session = createSession(store, api, clock);

/** @type {{drawing: ReturnType<typeof createDrawing>, plots: ReturnType<typeof createPlots>, readouts: ReturnType<typeof createReadouts>, transport: ReturnType<typeof createTransport>} | null} */
let parts = null;

// Most readers never need these: they are fetched when they are first wanted.
const above = createLater(() => import("./view/overlays.js"), update);
const editor = createLater(async () => {
  const { open } = await import("./view/editor/open.js");
  const keep = (/** @type {import("./model/own.js").Draft} */ draft) => keepDraft(localStorage, draft);
  return open({ api, session, state: store.get, draft: readDraft(localStorage), keep, changed: update });
}, update);
const lecture = createLater(async () => {
  const { bringStyle, open } = await import("./view/lecture/open.js");
  await bringStyle();
  return open({ root, session, state: store.get, changed: update, play: togglePlay });
}, update);
/** Lecture mode while it is on. */
const lecturing = () => (store.get().place.view && store.get().catalog.lecture ? lecture.part : null);

function togglePlay() {
  clock.play(!clock.playing);
  update();
}

/** @param {number} t */
function scrub(t) {
  clock.play(false);
  clock.seek(t);
  update();
}

function fullscreen() {
  void (document.fullscreenElement ? document.exitFullscreen() : document.documentElement.requestFullscreen?.());
}

/** Into lecture mode, over the whole screen. */
function enterLecture() {
  session.move({ view: "lecture", edit: "" });
  void document.documentElement.requestFullscreen?.().catch(() => {});
}

/** The presenter's window belongs to a lecture. */
async function present() {
  session.move({ view: "lecture", edit: "" });
  (await lecture.want()).present();
}

/** @returns {import("./view/page.js").View} */
function view() {
  const state = store.get();
  const section = (/** @type {string} */ name) => /** @type {Record<string, unknown>} */ (state.catalog[name] ?? {});
  const methods = translator(section("methods"));
  return {
    state, session, clock, togglePlay, scrub, fullscreen, enterLecture,
    editor: editor.part, lecture: lecturing(), overlays: state.catalog.lecture ? above.part?.overlays : undefined,
    t: translator({ ...section("page"), ...section("editor"), ...section("lecture") }),
    methodTitle: (id) => [methods(`${id}.title`), state.methods.find((m) => m.id === id)?.title].find((x) => x && x !== `${id}.title`) ?? id,
    link: (patch) => location.pathname + writePlace({ ...state.place, ...patch }) + ((patch.scene ?? state.place.scene) === OWN ? state.fragment : ""),
    follow(event, go) {
      const { ctrlKey, metaKey, shiftKey } = /** @type {MouseEvent} */ (event);
      if (ctrlKey || metaKey || shiftKey) return;
      event.preventDefault();
      go();
    },
    reload: () => void session.start(state.place),
  };
}

/** The moment as a sentence, for those who do not see it. @param {number} t @param {string} values */
function moment(t, values) {
  const { catalog, place } = store.get();
  const say = translator(/** @type {Record<string, unknown>} */ (catalog.page ?? {}));
  return say("drawing.moment", { time: fixed(t, 2, place.lang), values });
}

/** Shows the moment t everywhere. @param {number} t */
function show(t) {
  if (!parts) return;
  const { lang } = store.get().place;
  parts.drawing.draw(t);
  parts.plots.move(t);
  parts.readouts.move(t);
  parts.transport.move(t, clock, lang);
  if (!clock.playing) parts.transport.scrub.setAttribute("aria-valuetext", moment(t, parts.readouts.text(t)));
}

function assemble() {
  const find = (/** @type {string} */ selector) => /** @type {HTMLElement} */ (root.querySelector(selector));
  const frame = find(".drawing");
  const made = {
    drawing: createDrawing(frame),
    plots: createPlots(find(".plots"), { seek: scrub }),
    readouts: createReadouts(find(".readouts")),
    transport: createTransport(find(".player")),
  };
  new ResizeObserver(() => made.drawing.resize(clock.time)).observe(frame);
  return made;
}

function update() {
  const current = view();
  const { state } = current;
  const { place, scene, trajectory } = state;
  if (!state.catalog.page && !state.failures.page) return;
  const theme = place.theme === "auto" ? (dark.matches ? "dark" : "light") : place.theme;
  document.documentElement.dataset.theme = theme;
  document.documentElement.lang = place.lang;
  document.title = current.t("title");
  render(page(current), root);
  if (state.overlay) void above.want();
  above.part?.openDialog(root);
  parts ??= assemble();
  parts.drawing.show(scene, trajectory, clock.time);
  parts.readouts.show(scene, trajectory, place.lang);
  // The first step is to be read before the plots cost anything.
  const readable = state.lines.length > 0 || state.failures.derivation;
  parts.plots.show(readable && scene && trajectory ? { scene, trajectory, duration: place.duration, lang: place.lang, theme } : null);
  show(clock.time);
  history.replaceState(null, "", current.link({}));
  if (place.edit) void editor.want();
  if (place.view) void lecture.want();
  lecture.part?.update();
  if (reach(place.step, still.matches)) announce(state.lines, place.step, current.t);
}

/** The motion begins by itself once, unless the viewer prefers rest. */
function autoplay() {
  if (!store.get().trajectory || still.matches) return;
  stopWaiting();
  clock.play(true);
  update();
}

store.subscribe(update);
const stopWaiting = store.subscribe(autoplay);
clock.subscribe(show);
dark.addEventListener("change", update);
linkHighlights(root);
listen(document, {
  go: (by) => (lecturing() ?? session).go(by), more: () => lecturing()?.keys ?? {},
  fullscreen, overlay: session.overlay, play: togglePlay, lecture: enterLecture, presenter: () => void present(),
  covered: () => store.get().overlay !== "",
  uncover: () => session.overlay(""),
  substeps: () => toggleSubsteps(root, store.get().place.step),
});

let before = 0;
/** @param {number} now */
function tick(now) {
  clock.advance((now - before) / 1000);
  before = now;
  requestAnimationFrame(tick);
}
requestAnimationFrame(tick);

async function start() {
  const asked = readPlace(location.search);
  const sent = await documentIn(location.hash);
  const scene = sent || location.hash === "#edit" ? OWN : asked.scene;
  const own = sent ?? (scene === OWN ? (readDraft(localStorage)?.document ?? null) : null);
  const edit = scene === OWN && !own ? "form" : location.hash === "#edit" ? "form" : asked.edit;
  await session.start({ ...asked, scene, edit, lang: startLanguage(asked.lang, navigator.languages) }, own);
}
void start();
