/** The driver of the page "Variations": it connects question, answers, view and address. */

import { render } from "lit-html";
import { translator } from "./model/catalog.js";
import { createStore, mover } from "./model/store.js";
import { HOME, readPlace, startLanguage, writePlace } from "./model/url.js";
import { example } from "./model/variations/examples.js";
import { createLab } from "./model/variations/lab.js";
import { readQuestion, writeQuestion } from "./model/variations/question.js";
import { api } from "./server.js";
import { follow } from "./view/links.js";
import { dressed } from "./view/header.js";
import { page } from "./view/variations/page.js";

const WIDE = 660;
const FIRST_SIZE = 2;
const ADDRESS_REST = 150;

const root = /** @type {HTMLElement} */ (document.getElementById("page"));
const dark = matchMedia("(prefers-color-scheme: dark)");
const asked = readPlace(location.search);
const size = Number(new URLSearchParams(location.search).get("h"));
const store = createStore({
  place: { ...HOME, step: asked.step, theme: asked.theme, lang: startLanguage(asked.lang, navigator.languages) },
  catalog: /** @type {import("./model/types.js").Catalog} */ ({}),
  width: 0,
});
const { get, set } = store;
const lab = createLab(
  { vary: api.vary, lang: () => get().place.lang },
  readQuestion(location.search) ?? example("identity"),
  size > 0 ? size : FIRST_SIZE,
);

const move = mover(store);

/** @param {import("./model/types.js").Lang} lang */
async function speak(lang) {
  move({ lang });
  const catalog = await api.catalog(lang, "variations").catch(() => null);
  if (catalog && get().place.lang === lang) set({ catalog });
}

/** @param {string} step */
function goTo(step) {
  move({ step });
  requestAnimationFrame(() =>
    root.querySelector(`[data-step="${CSS.escape(step)}"]`)?.scrollIntoView({ block: "start" }),
  );
}

const session = {
  move,
  goTo,
  go() {},
  /** @param {import("./model/types.js").Lang} lang */
  async language(lang) {
    await speak(lang);
    lab.again();
  },
};

/** @param {Partial<import("./model/types.js").Place>} patch */
function link(patch) {
  const { question, size } = lab.get();
  const place = writePlace({ ...get().place, ...patch });
  return `${location.pathname}${place}${place ? "&" : "?"}${writeQuestion(question)}${size === FIRST_SIZE ? "" : `&h=${size}`}`;
}

/** Two charts beside each other where there is room for them, else one below the other. */
function chartSize() {
  const em = parseFloat(getComputedStyle(document.documentElement).fontSize);
  const { width } = get();
  const own = width > WIDE * (em / 16) ? Math.floor((width - em) / 2) - 1 : width;
  return { width: Math.max(own, 200), height: Math.max(16 * em, Math.min(own * 0.72, 24 * em)), em: 0.75 * em };
}

const observer = new ResizeObserver(([{ contentRect }]) => set({ width: Math.floor(contentRect.width) }));
/** @type {Element | null} */
let observed = null;

function observe() {
  const charts = root.querySelector(".slide");
  if (!charts || charts === observed) return;
  observer.disconnect();
  observer.observe((observed = charts));
}

let addressing = 0;
/** Browsers refuse addresses that change too often, as they would under a slider. */
function address() {
  clearTimeout(addressing);
  addressing = window.setTimeout(() => history.replaceState(null, "", link({})), ADDRESS_REST);
}

let arrived = false;
function update() {
  const { place, catalog } = get();
  dressed(place, dark.matches);
  if (!catalog.page) return;
  const t = translator({ ...catalog.page, ...catalog.variations });
  document.title = `δq · ${t("place.variations")}`;
  render(page({ state: { place }, asking: lab.get(), lab, session, t, link, follow, size: chartSize() }), root);
  observe();
  address();
  if (lab.get().answer && !arrived) {
    arrived = true;
    if (place.step) goTo(place.step);
  }
}

store.subscribe(update);
lab.subscribe(update);
dark.addEventListener("change", update);
lab.again();
void speak(get().place.lang);
