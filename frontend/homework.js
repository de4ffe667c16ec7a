/** The driver of the page "Homework": it connects sheet, answers, motions, views and address. */

import { render } from "lit-html";
import { translator } from "./model/catalog.js";
import { createClock } from "./model/clock.js";
import { createAnswering } from "./model/homework/answering.js";
import { assignmentIn, fragmentOfAssignment } from "./model/homework/assignment.js";
import { createConversion } from "./model/homework/conversion.js";
import { createExercise } from "./model/homework/exercise.js";
import { keyboardOf, shortcutsOf } from "./model/homework/keys.js";
import { patient } from "./model/homework/patience.js";
import { readAsked, stepAddress, writeAsked } from "./model/homework/place.js";
import { apart, createProgress } from "./model/homework/progress.js";
import { createTrail, retrace } from "./model/homework/trail.js";
import { begin } from "./model/homework/state.js";
import { createWorking } from "./model/homework/working.js";
import { documentIn, fragmentOf, OWN, readDraft } from "./model/own.js";
import { createLater } from "./model/later.js";
import { createStore } from "./model/store.js";
import { startLanguage } from "./model/url.js";
import { api as server } from "./server.js";
import { follow } from "./view/links.js";
import { everyFrame, whenIdle } from "./view/frames.js";
import { dressed } from "./view/header.js";
import { linkHighlights } from "./view/highlight.js";
import { offer } from "./view/files.js";
import { fetchMathLive, low, offerKeys } from "./view/homework/mathfield.js";
import { page } from "./view/homework/page.js";
import { createReach, createStaging } from "./view/homework/staging.js";
import { missed } from "./view/missed.js";
import { keeper, windowKeeper } from "./view/keeper.js";

/** Milliseconds after which the field for formulas has waited long enough. */
const PATIENCE = 500;
/** Bytes; an assignment may bring along its scenes. */
const LARGEST_SHEET = 2_000_000;

const root = /** @type {HTMLElement} */ (document.getElementById("page"));
const still = matchMedia("(prefers-reduced-motion: reduce)");
const dark = matchMedia("(prefers-color-scheme: dark)");
const asked = readAsked(location.search);
const store = createStore(
  begin({ ...asked, place: { ...asked.place, lang: startLanguage(asked.place.lang, navigator.languages) } }),
);
const { get, set } = store;
const { post, simulate, ...rest } = server;
const api = { ...rest, post: patient(post), simulate: patient(simulate) };
const clock = createClock();
const progress = createProgress(apart(keeper(), windowKeeper()));
const answering = createAnswering(store, api, progress);
const exercise = createExercise(store, api, progress, answering);
const working = createWorking(store, api, progress, exercise);
const switchTo = createConversion(store, api, answering);

let formulas = false;
let fragment = "";
const staging = createStaging(root, clock);
const reach = createReach(root);

/** @param {import("./model/types.js").Lang} lang */
async function speak(lang) {
  exercise.move({ lang });
  const catalog = await api.catalog(lang, "exercises").catch(() => null);
  if (catalog && get().asked.place.lang === lang) set({ catalog });
}

const session = {
  move: exercise.move,
  /** @param {import("./model/types.js").Lang} lang */
  async language(lang) {
    set({ marked: null });
    await Promise.all([speak(lang), exercise.load()]);
  },
};

function togglePlay() {
  clock.play(!clock.playing);
  update();
}

/** @param {number} t */
function scrub(t) {
  clock.play(false);
  clock.seek(t);
  update();
}

const download = () => offer("deltaq-homework.json", progress.exported(), "application/json");

/** @param {import("./model/homework/sheet.js").Assignment} assignment */
async function assign(assignment) {
  fragment = await fragmentOfAssignment(assignment);
  await exercise.assign(assignment);
}

/** An assignment that is dropped by itself where none is open; what students hand in never takes its place. @param {File} file */
async function opened(file) {
  if (get().assignment || file.size > LARGEST_SHEET) return false;
  const assignment = await assignmentIn(await file.text(), file.name, api, get().asked.place.lang);
  if (assignment) await assign(assignment);
  return Boolean(assignment);
}

/** @param {import("./model/homework/sheet.js").Assignment} assignment */
function open(assignment) {
  exercise.turn("task");
  void assign(assignment);
}

/** The student's own work, or an assignment. @param {File} file */
async function upload(file) {
  const text = await file.text();
  const assignment = await assignmentIn(text, file.name, api, get().asked.place.lang);
  if (assignment) return assign(assignment);
  const taken = progress.imported(text);
  set({ notice: taken === null ? "homework.no-file" : "homework.imported" });
  const { entry } = get();
  if (taken && entry) set({ draft: progress.draft(entry.key), lines: progress.lines(`${entry.group}/~working`) });
}

/** What the keyboard of a task offers is made once for it. @type {{entry: unknown, keys: import("./model/homework/keys.js").Row[], shortcuts: Record<string, string>}} */
let offered = { entry: null, keys: [], shortcuts: {} };

/** Whether the address brings along what is worked on. */
const own = () => Boolean(get().assignment || get().own);

/** @returns {import("./view/homework/page.js").HomeworkView} */
function view() {
  const state = get();
  const { entry, catalog } = state;
  const t = translator({ ...catalog.page, ...catalog.exercises });
  if (entry && offered.entry !== entry) {
    offered = { entry, keys: keyboardOf(entry, t), shortcuts: shortcutsOf(entry.symbols) };
    offerKeys(offered.keys, "δq");
  }
  return {
    state,
    answering,
    exercise,
    working,
    session,
    switchTo,
    clock,
    togglePlay,
    scrub,
    download,
    upload,
    formulas,
    classroom: classroom.part,
    picker: picker.part,
    practice: practice.part,
    practise,
    progress,
    notice: (key) => set({ notice: key, asked: { ...get().asked } }),
    opened,
    open,
    keys: offered.keys,
    shortcuts: offered.shortcuts,
    t,
    draftOf: (key) => (key === entry?.key ? state.draft : progress.draft(key)),
    ownStep: (step) => (state.own ? stepAddress(OWN, step, state.asked.place) + fragment : ""),
    link: (patch) => location.pathname + writeAsked({ ...state.asked, ...patch }) + (own() ? fragment : ""),
    follow,
  };
}

const trail = createTrail(history, location);

/** The tasks on the page as questions of STACK. @param {object} reference */
async function questions(reference) {
  const body = JSON.stringify({ ...reference, lang: get().asked.place.lang });
  const response = await fetch("/api/v1/tasks/stack", {
    method: "POST",
    headers: { "content-type": "application/json" },
    body,
  }).catch(() => null);
  return response?.ok ? response.text() : null;
}

const classroom = createLater(async () => {
  const { open } = await import("./view/homework/open-classroom.js");
  return open({ send: fetch.bind(globalThis), state: get, changed: update, questions });
}, update);

const picker = createLater(async () => {
  const { open: opening } = await import("./view/homework/open-picker.js");
  return opening({ api, state: get, keeper: keeper(), changed: update });
}, update);

const practice = createLater(async () => {
  const { open: opening } = await import("./view/homework/open-practice.js");
  return opening({ api, keeper: keeper(), changed: update });
}, update);

/** @returns {import("./view/missed.js").Missable[]} */
function tools() {
  const { side } = get().asked;
  return [
    { says: "missed.classroom", later: classroom, wanted: side === "class" },
    { says: "missed.picker", later: picker, wanted: side === "sheet" },
    // Its side is turned to only when it is there.
    { says: "missed.practice", later: { failed: practice.failed, again: practise }, wanted: true },
  ];
}

/** On to the exercise at hand, or to the next one. */
async function practise() {
  const opened = await practice.again();
  if (opened) await exercise.drill(opened.session.resumed());
}

async function fetchFormulas() {
  formulas = await fetchMathLive();
  offerKeys(offered.keys, "δq");
  update();
}

let wanted = false;
function update() {
  const {
    asked: { place, side },
    catalog,
    entry,
  } = get();
  dressed(place, dark.matches);
  if (!catalog.page) return;
  const current = view();
  document.title = `δq · ${current.t("place.homework")}`;
  render([page(current), missed(tools(), current.t)], root);
  staging.show(get(), still.matches);
  reach(get(), still.matches);
  trail(current.link({}), entry?.key ?? "");
  if (side === "class") void classroom.want();
  if (side === "sheet") void picker.want();
  if (side === "practice") void practice.want().then((opened) => opened?.session.observe(get()));
  if (!entry || wanted) return;
  wanted = true;
  whenIdle(() => void fetchFormulas(), PATIENCE);
}

store.subscribe(update);
clock.subscribe(staging.move);
dark.addEventListener("change", update);
low.addEventListener("change", () => offerKeys(offered.keys, "δq"));
addEventListener(
  "popstate",
  () => (location.hash === (own() ? fragment : "") && retrace(get(), exercise, location.search)) || location.reload(),
);
linkHighlights(root);

everyFrame(clock.advance);

async function start() {
  const { asked } = get();
  const [assignment, sent] = await Promise.all([
    assignmentIn(location.hash, "", api, asked.place.lang),
    documentIn(location.hash),
  ]);
  const own = sent ?? (asked.place.scene === OWN && !assignment ? (readDraft(keeper())?.document ?? null) : null);
  fragment = own ? await fragmentOf(own) : location.hash;
  const { side, drill } = asked;
  const chosen = side === "practice" && !drill.number ? ((await practice.want())?.session.resumed() ?? drill) : drill;
  const scene = own ? OWN : asked.place.scene === OWN ? "" : asked.place.scene;
  await Promise.all([
    speak(asked.place.lang),
    exercise.start({ ...asked, drill: chosen, place: { ...asked.place, scene } }, assignment, own),
  ]);
}
void start();
