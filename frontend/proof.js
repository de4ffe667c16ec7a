/** The driver of the page of the general proof. */

import { render } from "lit-html";
import { createApi } from "./model/api.js";
import { translator } from "./model/catalog.js";
import { createProof } from "./model/proof.js";
import { createStore } from "./model/store.js";
import { HOME, readPlace, startLanguage, writePlace } from "./model/url.js";
import { listen } from "./view/keys.js";
import { openDialog } from "./view/overlays.js";
import { page } from "./view/proof.js";
import { announce, createReach, toggleSubsteps } from "./view/reach.js";

const root = /** @type {HTMLElement} */ (document.getElementById("page"));
const still = matchMedia("(prefers-reduced-motion: reduce)");
const dark = matchMedia("(prefers-color-scheme: dark)");
const asked = readPlace(location.search);
/** @type {import("./model/proof.js").Reading} */
const START = {
  place: { ...HOME, step: asked.step, theme: asked.theme, lang: startLanguage(asked.lang, navigator.languages) },
  catalog: {}, derivation: null, lines: [], overlay: "", failure: null,
};
const store = createStore(START);
const session = createProof(store, createApi(fetch.bind(globalThis)));
const reach = createReach(root);

const link = (/** @type {Partial<import("./model/types.js").Place>} */ patch) => location.pathname + writePlace({ ...store.get().place, ...patch });

/** @param {Event} event @param {() => void} go */
function follow(event, go) {
  const { ctrlKey, metaKey, shiftKey } = /** @type {MouseEvent} */ (event);
  if (ctrlKey || metaKey || shiftKey) return;
  event.preventDefault();
  go();
}

function fullscreen() {
  void (document.fullscreenElement ? document.exitFullscreen() : document.documentElement.requestFullscreen?.());
}

function update() {
  const state = store.get();
  const { place, catalog } = state;
  if (!catalog.page && !state.failure) return;
  const t = translator({ .../** @type {object} */ (catalog.page ?? {}), .../** @type {object} */ (catalog.lecture ?? {}) });
  document.documentElement.dataset.theme = place.theme === "auto" ? (dark.matches ? "dark" : "light") : place.theme;
  document.documentElement.lang = place.lang;
  document.title = `δq · ${t("place.proof")}`;
  render(page({ state, session, link, follow, t, fullscreen }), root);
  openDialog(root);
  history.replaceState(null, "", link({}));
  if (reach(place.step, still.matches)) announce(state.lines, place.step, t);
}

store.subscribe(update);
dark.addEventListener("change", update);
listen(document, {
  go: session.go, fullscreen, overlay: session.overlay, play() {},
  covered: () => store.get().overlay !== "",
  uncover: () => session.overlay(""),
  substeps: () => toggleSubsteps(root, store.get().place.step),
});
void session.load();
