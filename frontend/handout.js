/** The driver of the handout: a derivation as a sheet of paper. */

import { render } from "lit-html";
import { translator } from "./model/catalog.js";
import { createHandout } from "./model/handout.js";
import { documentIn } from "./model/own.js";
import { createStore } from "./model/store.js";
import { HOME, readPlace, startLanguage, writePlace } from "./model/url.js";
import { api } from "./server.js";
import { expectLong, typesetAll } from "./view/formula.js";
import { dressed } from "./view/header.js";
import { createDrawing } from "./view/drawing.js";
import { page } from "./view/handout/page.js";

const SUBSTEPS = "substeps";
const PROVING = "proof";

const root = /** @type {HTMLElement} */ (document.getElementById("page"));
const dark = matchMedia("(prefers-color-scheme: dark)");
const asked = readPlace(location.search);
const query = new URLSearchParams(location.search);
const proof = query.get(PROVING) ?? "";
/** @type {import("./model/handout.js").Sheet} */
const START = {
  place: {
    ...HOME,
    scene: asked.scene || (proof ? "" : "elastic-pendulum"),
    n: asked.n,
    set: asked.set,
    formulation: asked.formulation,
    release: asked.release,
    theme: asked.theme,
    lang: startLanguage(asked.lang, navigator.languages),
  },
  catalog: {},
  scene: null,
  lines: [],
  trajectory: null,
  failure: null,
  proof,
  substeps: query.get(SUBSTEPS) !== "no",
};
const store = createStore(START);
const session = createHandout(store, api, await documentIn(location.hash));

/** @type {ReturnType<typeof createDrawing> | null} */
let drawing = null;

/** What is drawn, typeset and named, once everything is there. */
function update() {
  const { place, catalog, scene, trajectory, substeps } = store.get();
  dressed(place, dark.matches);
  if (!catalog.page) return;
  const t = translator({ ...catalog.page, ...catalog.lecture });
  const own = [proof && `${PROVING}=${encodeURIComponent(proof)}`, substeps ? "" : `${SUBSTEPS}=no`].filter(Boolean);
  const shared = writePlace(place);
  const address = `${location.pathname}${shared}${own.length ? `${shared ? "&" : "?"}${own.join("&")}` : ""}${location.hash}`;
  const source = `${location.origin}${proof ? "/proof" : "/scene"}${shared}${location.hash}`;
  render(page({ ...store.get(), state: { place }, session, t, print: () => void onPaper(), address: source }), root);
  const frame = /** @type {HTMLElement | null} */ (root.querySelector(".drawing"));
  if (frame && trajectory) (drawing ??= createDrawing(frame)).show(scene, trajectory, 0);
  document.title = `δq · ${root.querySelector("h1")?.textContent ?? ""}`;
  history.replaceState(null, "", address);
}

/** Frames after which a sheet is printed as it is. */
const PATIENCE = 240;

/** Prints when every formula has found its size: one that is too wide would make the whole sheet small. */
async function onPaper() {
  typesetAll();
  const isTooWide = (/** @type {Element} */ formula) => formula.scrollWidth > formula.clientWidth + 1;
  for (let frames = 0; frames < PATIENCE && [...root.querySelectorAll(".formula")].some(isTooWide); frames += 1)
    await new Promise(requestAnimationFrame);
  window.print();
}

/** Printed by the browser's own key, what had no time to go on below becomes as small as it must. */
window.addEventListener("beforeprint", () => {
  for (const formula of /** @type {NodeListOf<HTMLElement>} */ (root.querySelectorAll(".formula.wide"))) {
    const fit = Number(formula.style.getPropertyValue("--fit")) || 1;
    formula.style.setProperty("--fit", String((0.98 * fit * formula.clientWidth) / formula.scrollWidth));
  }
});

dark.addEventListener("change", update);
update();
void session.load();
// Who prints by the browser's own key waits for nothing: a sheet is not shown before it could be printed.
await expectLong();
store.subscribe(update);
update();
