/** The driver of the start page. */

import { render } from "lit-html";
import { translator } from "./model/catalog.js";
import { createSamples } from "./model/start/sample.js";
import { createStore, mover } from "./model/store.js";
import { readPlace, startPlace, writePlace } from "./model/url.js";
import { api } from "./server.js";
import { everyFrame } from "./view/frames.js";
import { dressed } from "./view/header.js";
import { createMotions } from "./view/start/motions.js";
import { HERO, page } from "./view/start/page.js";

const root = /** @type {HTMLElement} */ (document.getElementById("page"));
const still = matchMedia("(prefers-reduced-motion: reduce)");
const dark = matchMedia("(prefers-color-scheme: dark)");
const asked = readPlace(location.search);
const store = createStore({
  place: startPlace(asked, navigator.languages),
  catalog: /** @type {import("./model/types.js").Catalog} */ ({}),
  scenes: /** @type {import("./model/types.js").SceneEntry[]} */ ([]),
});
const { get, set } = store;
const samples = createSamples(api, () => get().place.lang);
const motions = createMotions(samples.ask, { still: () => still.matches, always: HERO });

const move = mover(store);

/** @param {import("./model/types.js").Lang} lang */
async function language(lang) {
  move({ lang });
  const catalog = await api.catalog(lang, "start").catch(() => null);
  if (catalog && get().place.lang === lang) set({ catalog });
}

function update() {
  const { place, catalog, scenes } = get();
  dressed(place, dark.matches);
  if (!catalog.page) return;
  const t = translator({ ...catalog.page, ...catalog.start });
  document.title = t("title");
  render(page({ state: { place }, session: { language, move }, scenes, t }), root);
  motions.watch(root);
  history.replaceState(null, "", location.pathname + writePlace(place) + location.hash);
}

// Scenes stood at this address once: one that was shared in the fragment is shown where scenes are now.
if (/^#(s=|edit$)/.test(location.hash)) location.replace(`/scene${location.search}${location.hash}`);
else {
  store.subscribe(update);
  dark.addEventListener("change", update);
  root.addEventListener("pointerover", ({ target }) => motions.point(target));
  root.addEventListener("focusin", ({ target }) => motions.point(target));
  everyFrame(motions.advance);
  void language(get().place.lang);
  void api.scenes({ summaries: true }).then(
    ({ scenes }) => set({ scenes }),
    () => {},
  );
}
