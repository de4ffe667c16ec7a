/** The driver of the page of the general proof. */

import { render } from "lit-html";
import { translator } from "./model/catalog.js";
import { createLater } from "./model/later.js";
import { createProof, PROOF } from "./model/proof.js";
import { createStore } from "./model/store.js";
import { HOME, readPlace, startLanguage, writePlace } from "./model/url.js";
import { api } from "./server.js";
import { sheet } from "./view/bring.js";
import { follow } from "./view/links.js";
import { enterFullscreen, toggleFullscreen } from "./view/fullscreen.js";
import { isGuest } from "./view/guest.js";
import { dressed, stopTitle } from "./view/header.js";
import { listen } from "./view/keys.js";
import { add } from "./view/lectures/adding.js";
import { missed } from "./view/missed.js";
import { openDialog, overlays } from "./view/overlays.js";
import { page } from "./view/proof.js";
import { announce, createReach, toggleSubsteps } from "./view/reach.js";

const root = /** @type {HTMLElement} */ (document.getElementById("page"));
const still = matchMedia("(prefers-reduced-motion: reduce)");
const dark = matchMedia("(prefers-color-scheme: dark)");
const { step, theme, lang, view, part, pace } = readPlace(location.search);
/** @type {import("./model/proof.js").Reading} */
const START = {
  place: { ...HOME, step, theme, view, part, pace, lang: startLanguage(lang, navigator.languages) },
  catalog: {},
  derivation: null,
  lines: [],
  overlay: "",
  failure: null,
};
const store = createStore(START);
const session = createProof(store, api);
const reach = createReach(root);

/** @returns {import("./model/catalog.js").Translate} */
function texts() {
  const { page: everywhere = {}, lecture: here = {} } = store.get().catalog;
  return translator({ ...everywhere, ...here });
}

const lecture = createLater(async () => {
  const [{ open }] = await Promise.all([import("./view/lecture/open.js"), sheet("lecture")]);
  const about = () => ({ scene: PROOF, title: { [store.get().place.lang]: texts()("place.proof") } });
  return open({ root, session, state: store.get, about, changed: update, play() {} });
}, update);
const framed = location.pathname.startsWith("/embed/")
  ? import("./view/embed.js").then(({ embed }) => embed(root, () => store.get().place, whole))
  : null;
const sharing = createLater(() => import("./view/share.js"), update);

const lecturing = () => (store.get().place.view ? lecture.part : null);
const link = (/** @type {Partial<import("./model/types.js").Place>} */ patch) =>
  location.pathname + writePlace({ ...store.get().place, ...patch });

/** The address of the same step as a page. */
const whole = () => location.href.replace("/embed/", "/");

/** Into lecture mode, over the whole screen. */
function enterLecture() {
  session.move({ view: "lecture" });
  enterFullscreen();
}

/** What is shown becomes a stop of the viewer's lecture; a lecture that is being given gets no more stops. */
const addShown = () => isGuest() || add(stopTitle({ state: store.get(), t: texts() }), texts());

/** The presenter's window belongs to a lecture. */
async function present() {
  session.move({ view: "lecture" });
  (await lecture.want())?.present();
}

/** What lies above the page. @param {import("./view/proof.js").ProofView} view */
const above = (view) => (view.state.overlay === "share" ? sharing.part?.shareProof(view, PROOF) : overlays(view));

/** @returns {import("./view/missed.js").Missable[]} */
const tools = () => [
  { says: "missed.lecture", later: lecture, wanted: Boolean(store.get().place.view) },
  { says: "missed.sharing", later: sharing, wanted: store.get().overlay === "share" },
];

/** What keys mean in a lecture; nothing stands beside a proof that D could change, and its steps are laws themselves. */
function more() {
  const { d: _beside, w: _why, ...keys } = /** @type {Record<string, () => void>} */ (lecturing()?.keys ?? {});
  return keys;
}

function update() {
  const state = store.get();
  const { place, catalog, overlay } = state;
  dressed(place, dark.matches);
  if (!catalog.page && !state.failure) return;
  const t = texts();
  document.title = `δq · ${t("place.proof")}`;
  render(
    [
      page({
        state,
        session,
        link,
        follow,
        t,
        fullscreen: toggleFullscreen,
        enterLecture,
        lecture: lecturing(),
        above,
      }),
      missed(tools(), t),
    ],
    root,
  );
  if (overlay === "share") void sharing.want();
  if (place.view) void lecture.want();
  lecture.part?.update();
  openDialog(root);
  history.replaceState(null, "", link({}));
  void framed?.then((tell) => tell());
  if (reach(place.step, still.matches)) announce(state.lines, place.step, t);
  if (!awaitsLecture()) pressEarlyKeys();
}

/** Lecture mode is wanted and not there yet: its keys are not lost meanwhile. */
function awaitsLecture() {
  const { place, failure } = store.get();
  return Boolean(place.view) && !failure && !lecture.failed && !lecturing();
}

store.subscribe(update);
dark.addEventListener("change", update);
const pressEarlyKeys = listen(document, {
  waiting: awaitsLecture,
  go: (by) => (lecturing() ?? session).go(by),
  more,
  lecture: enterLecture,
  presenter: () => void present(),
  add: () => void addShown(),
  fullscreen: toggleFullscreen,
  overlay: session.overlay,
  play() {},
  covered: () => store.get().overlay !== "",
  uncover: () => session.overlay(""),
  substeps: () => toggleSubsteps(root, store.get().place.step),
});
if (new URLSearchParams(location.search).get("view") === "print")
  location.replace(`/handout?proof=${PROOF}&lang=${store.get().place.lang}`);
else {
  update();
  void session.load();
}
