/** The driver of the help. */

import { render } from "lit-html";
import { translator } from "./model/catalog.js";
import { createSpeech } from "./model/speech.js";
import { createStore, mover } from "./model/store.js";
import { readPlace, startPlace, writePlace } from "./model/url.js";
import { api } from "./server.js";
import { dressed } from "./view/header.js";
import { page } from "./view/guide/page.js";

const root = /** @type {HTMLElement} */ (document.getElementById("page"));
const dark = matchMedia("(prefers-color-scheme: dark)");
const asked = readPlace(location.search);
const store = createStore({
  place: startPlace(asked, navigator.languages),
  catalog: /** @type {import("./model/types.js").Catalog} */ ({}),
});
const { get } = store;
const speech = createSpeech(store, api, (task) => task().catch(() => {}), ["guide", "lecture"]);

let arrived = false;
function update() {
  const { place, catalog } = get();
  dressed(place, dark.matches);
  if (!catalog.page) return;
  const t = translator({
    ...catalog.page,
    ...catalog.lecture,
    ...catalog.guide,
  });
  document.title = `δq · ${t("place.help")}`;
  const session = { language: speech.speak, move: mover(store) };
  render(page({ state: { place }, session, t }), root);
  history.replaceState(null, "", location.pathname + writePlace(place) + location.hash);
  if (!arrived && location.hash) document.getElementById(location.hash.slice(1))?.scrollIntoView();
  arrived = true;
}

store.subscribe(update);
dark.addEventListener("change", update);
void speech.speak(get().place.lang);
