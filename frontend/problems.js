/** The driver of the pages that explain problem documents: the server has written what they say; here they get their top. */

import { render } from "lit-html";
import { translator } from "./model/catalog.js";
import { createSpeech } from "./model/speech.js";
import { createStore, mover } from "./model/store.js";
import { HOME, readPlace, startLanguage, writePlace } from "./model/url.js";
import { api } from "./server.js";
import { dressed } from "./view/header.js";
import { top } from "./view/top.js";

const root = /** @type {HTMLElement} */ (document.getElementById("page"));
const main = /** @type {HTMLElement} */ (root.querySelector("main"));
const dark = matchMedia("(prefers-color-scheme: dark)");
const store = createStore({
  place: { ...HOME, theme: readPlace(location.search).theme, lang: startLanguage("", [document.documentElement.lang]) },
  catalog: /** @type {import("./model/types.js").Catalog} */ ({}),
});
const { get } = store;
const speech = createSpeech(store, api, (task) => task().catch(() => {}));

/** The server writes the page in another language. @param {import("./model/types.js").Lang} lang */
const language = async (lang) => location.assign(location.pathname + writePlace({ ...get().place, lang }));

function update() {
  const { place, catalog } = get();
  dressed(place, dark.matches);
  history.replaceState(null, "", location.pathname + writePlace(place) + location.hash);
  for (const link of main.querySelectorAll("a")) link.search = writePlace(place);
  if (!catalog.page) return;
  const t = translator(catalog.page);
  render(top({ state: { place }, session: { language, move: mover(store) }, t }, { main: main.id }), root, {
    renderBefore: main,
  });
}

store.subscribe(update);
dark.addEventListener("change", update);
update();
void speech.speak(get().place.lang);
