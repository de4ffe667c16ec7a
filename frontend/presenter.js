/** The driver of the presenter's window: what is shown, what comes next, notes and time. It follows a lecture and may lead it. */

import { render } from "lit-html";
import { translator } from "./model/catalog.js";
import { createReceiver, isId, nameOf } from "./model/lecture/link.js";
import { keepNotes, readNotes, withNote } from "./model/lecture/notes.js";
import { STOPPED, toggled } from "./model/lecture/timer.js";
import { linesOf } from "./model/reveal.js";
import { createSpeech } from "./model/speech.js";
import { createStore, mover } from "./model/store.js";
import { readPlace, startPlace, writePlace } from "./model/url.js";
import { api } from "./server.js";
import { dressed } from "./view/header.js";
import { keeper } from "./view/keeper.js";
import { listen } from "./view/keys.js";
import { page } from "./view/lecture/presenter.js";

const TICK = 500;

const root = /** @type {HTMLElement} */ (document.getElementById("page"));
const dark = matchMedia("(prefers-color-scheme: dark)");
const asked = readPlace(location.search);
const id = new URLSearchParams(location.search).get("with");
const store = createStore({
  place: startPlace(asked, navigator.languages),
  catalog: /** @type {import("./model/types.js").Catalog} */ ({}),
  here: /** @type {import("./model/lecture/link.js").Here | null} */ (null),
  lines: /** @type {import("./model/reveal.js").Line[]} */ ([]),
  notes: readNotes(keeper()),
  timer: STOPPED,
  now: Date.now(),
});
const { get, set } = store;
const speech = createSpeech(store, api, (task) => task().catch(() => {}), ["lecture"]);

/** @type {ReturnType<typeof createReceiver> | null} */
const line = isId(id) ? createReceiver(new BroadcastChannel(nameOf(/** @type {string} */ (id))), hear) : null;

/** @param {import("./model/lecture/link.js").Here} here */
function hear(here) {
  set({ here, ...(here.chapters ? { lines: linesOf(here.chapters) } : {}) });
}

const move = mover(store);
const wish = (/** @type {import("./model/lecture/link.js").Wish} */ wanted) => line?.wish(wanted);

const actions = {
  wish,
  move,
  language: speech.speak,
  /** @param {string} text */
  write(text) {
    const place = get().here?.place;
    if (!place) return;
    const notes = withNote(get().notes, place.scene, place.step, text);
    keepNotes(keeper(), notes);
    set({ notes });
  },
  toggleTimer: () => set({ timer: toggled(get().timer, Date.now()), now: Date.now() }),
  resetTimer: () => set({ timer: STOPPED }),
};

function update() {
  const { place, catalog } = get();
  dressed(place, dark.matches);
  if (!catalog.page || !catalog.lecture) return;
  const t = translator({ ...catalog.page, ...catalog.lecture });
  document.title = `δq · ${t("presenter")}`;
  render(page({ ...get(), state: { place }, session: actions, t }), root);
  history.replaceState(
    null,
    "",
    `${location.pathname}?with=${isId(id) ? id : ""}${writePlace(place).replace("?", "&")}`,
  );
}

store.subscribe(update);
dark.addEventListener("change", update);
const nothing = () => {};
listen(document, {
  go: (by) => wish({ kind: "go", by }),
  play: () => wish({ kind: "play" }),
  fullscreen: nothing,
  substeps: nothing,
  overlay: (name) => (name === "black" ? wish({ kind: "overlay", name }) : undefined),
  covered: () => false,
  uncover: nothing,
  more: () => ({ ArrowDown: () => wish({ kind: "within", by: 1 }), ArrowUp: () => wish({ kind: "within", by: -1 }) }),
});
setInterval(() => set({ now: Date.now() }), TICK);
void speech.speak(get().place.lang);
