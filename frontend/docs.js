/** The driver of the reference of the API. */

import { render } from "lit-html";
import { ApiError } from "./model/api.js";
import { translator } from "./model/catalog.js";
import { groupsOf } from "./model/reference.js";
import { createSpeech } from "./model/speech.js";
import { createStore, mover } from "./model/store.js";
import { readPlace, startPlace, writePlace } from "./model/url.js";
import { api } from "./server.js";
import { dressed } from "./view/header.js";
import { page } from "./view/reference/page.js";

const root = /** @type {HTMLElement} */ (document.getElementById("page"));
const dark = matchMedia("(prefers-color-scheme: dark)");
const asked = readPlace(location.search);
const store = createStore({
  place: startPlace(asked, navigator.languages),
  catalog: /** @type {import("./model/types.js").Catalog} */ ({}),
  groups: /** @type {import("./model/reference.js").Group[]} */ ([]),
  version: "",
  sample: "Shell",
  failure: /** @type {import("./model/types.js").Failure | null} */ (null),
});
const { get, set } = store;
const speech = createSpeech(store, api, (task) => task().catch(() => {}), ["reference"]);

async function load() {
  try {
    const document = await api.description();
    set({ groups: groupsOf(document, location.origin), version: document.info.version, failure: null });
  } catch (error) {
    if (!(error instanceof ApiError)) throw error;
    set({ failure: error.failure });
  }
}

let arrived = false;
function update() {
  const { place, catalog, groups } = get();
  dressed(place, dark.matches);
  if (!catalog.page) return;
  const t = translator({ ...catalog.page, ...catalog.reference });
  document.title = `δq · ${t("place.docs")}`;
  const session = { language: speech.speak, move: mover(store) };
  const choose = (/** @type {string} */ sample) => set({ sample });
  render(page({ ...get(), state: { place }, session, t, reload: load, choose }), root);
  history.replaceState(null, "", location.pathname + writePlace(place) + location.hash);
  if (groups.length && !arrived) {
    arrived = true;
    if (location.hash) document.getElementById(location.hash.slice(1))?.scrollIntoView();
  }
}

store.subscribe(update);
dark.addEventListener("change", update);
void load();
void speech.speak(get().place.lang);
