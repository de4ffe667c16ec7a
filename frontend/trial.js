/** The driver of the page where the API is tried. */

import { render } from "lit-html";
import { ApiError } from "./model/api.js";
import { translator } from "./model/catalog.js";
import { newest } from "./model/latest.js";
import { groupsOf } from "./model/reference.js";
import { createSpeech } from "./model/speech.js";
import { createStore, mover } from "./model/store.js";
import { ask, draftIn, draftOf, fragmentOf, sendingOf } from "./model/trial.js";
import { readPlace, startPlace, writePlace } from "./model/url.js";
import { api, send as fromServer } from "./server.js";
import { dressed } from "./view/header.js";
import { page } from "./view/reference/trial.js";

/** @typedef {import("./view/reference/trial.js").TrialView} TrialView */

const root = /** @type {HTMLElement} */ (document.getElementById("page"));
const dark = matchMedia("(prefers-color-scheme: dark)");
const asked = readPlace(location.search);
/** @type {Pick<TrialView, "groups" | "call" | "draft" | "coming" | "failure"> & {place: import("./model/types.js").Place, catalog: import("./model/types.js").Catalog}} */
const START = {
  place: startPlace(asked, navigator.languages),
  catalog: {},
  groups: [],
  call: null,
  draft: { values: {}, body: "" },
  coming: { state: "empty" },
  failure: null,
};
const store = createStore(START);
const { get, set } = store;
const speech = createSpeech(store, api, (task) => task().catch(() => {}), ["reference"]);
const renew = newest();

/** The call and the draft that the address names. */
function arrive() {
  const calls = get().groups.flatMap((group) => group.calls);
  if (calls.length) set({ ...draftIn(calls, location.hash), coming: { state: "empty" } });
}

async function load() {
  try {
    set({ groups: groupsOf(await api.description(), location.origin), failure: null });
    arrive();
  } catch (error) {
    if (!(error instanceof ApiError)) throw error;
    set({ failure: error.failure });
  }
}

async function send() {
  const { call, draft } = get();
  if (!call) return;
  const signal = renew();
  set({ coming: { state: "waiting" } });
  const answer = await ask(fromServer, sendingOf(call, draft), signal, () => performance.now()).catch(() => null);
  if (!signal.aborted) set({ coming: answer ? { state: "answered", answer } : { state: "unreachable" } });
}

function stop() {
  renew();
  set({ coming: { state: "stopped" } });
}

const actions = {
  send,
  stop,
  reload: load,
  origin: location.origin,
  /** @param {string} id */
  choose(id) {
    const call =
      get()
        .groups.flatMap((group) => group.calls)
        .find((one) => one.id === id) ?? null;
    renew();
    if (call) set({ call, draft: draftOf(call), coming: { state: "empty" } });
  },
  /** @param {Partial<import("./model/trial.js").Draft>} patch */
  write: (patch) => set({ draft: { ...get().draft, ...patch } }),
  /** @param {number} example */
  show(example) {
    const { call } = get();
    if (call) set({ draft: draftOf(call, example) });
  },
};

function update() {
  const { place, catalog, call, draft } = get();
  dressed(place, dark.matches);
  if (!catalog.page) return;
  const t = translator({ ...catalog.page, ...catalog.reference });
  document.title = `δq · ${t("trial")}`;
  const session = { language: speech.speak, move: mover(store) };
  render(page({ ...get(), ...actions, state: { place }, session, t }), root);
  history.replaceState(
    null,
    "",
    location.pathname + writePlace(place) + (call ? fragmentOf(call, draft) : location.hash),
  );
}

store.subscribe(update);
dark.addEventListener("change", update);
window.addEventListener("hashchange", arrive);
void load();
void speech.speak(get().place.lang);
