/** The driver of the labs: it connects question, experiment, charts and address. */

import { render } from "lit-html";
import { translator } from "./model/catalog.js";
import { createBench } from "./model/labs/bench.js";
import { motionAt } from "./model/labs/bifurcation.js";
import { experimentsOf } from "./model/labs/experiments.js";
import { withMarks } from "./model/labs/figure.js";
import {
  answered,
  exampleOf,
  NOTHING,
  pointOf,
  readQuestion,
  requestOf,
  writeQuestion,
} from "./model/labs/question.js";
import { resultOf } from "./model/labs/results.js";
import { experiment, file } from "./model/labs/stream.js";
import { createWatch, motionOf, written } from "./model/labs/watch.js";
import { significant } from "./model/numbers.js";
import { asTyped, completed, documentIn, fragmentOf, OWN, readDraft } from "./model/own.js";
import { writeChanges } from "./model/values.js";
import { createStore, mover } from "./model/store.js";
import { caveatsOf } from "./model/trajectory.js";
import { HOME, readPlace, startPlace, writePlace } from "./model/url.js";
import { api, send } from "./server.js";
import { offer } from "./view/files.js";
import { isGuest } from "./view/guest.js";
import { everyFrame } from "./view/frames.js";
import { dressed } from "./view/header.js";
import { keeper } from "./view/keeper.js";
import { createMotion } from "./view/labs/motion.js";
import { page, showOpen } from "./view/labs/page.js";
import { createCharts } from "./view/labs/plotly.js";
import { missed } from "./view/missed.js";

/** @typedef {import("./model/labs/chart.js").Chart} Chart */

const root = /** @type {HTMLElement} */ (document.getElementById("page"));
const dark = matchMedia("(prefers-color-scheme: dark)");
const still = matchMedia("(prefers-reduced-motion: reduce)");
const asked = readPlace(location.search);
const store = createStore({
  place: startPlace(asked, navigator.languages),
  catalog: /** @type {import("./model/types.js").Catalog} */ ({}),
  scenes: /** @type {import("./model/types.js").SceneEntry[]} */ ([]),
  dial: { tolerance: 1e-6, step: 0 },
  play: /** @type {import("./view/labs/page.js").Play | null} */ (null),
  cursor: /** @type {import("./view/labs/page.js").Cursor | null} */ (null),
});
const { get, set } = store;
let ownFragment = "";
let own = /** @type {import("./model/own.js").SceneDocument | null} */ (null);

const move = mover(store);
const known = experimentsOf(
  await api.experiments().then(
    ({ experiments }) => experiments,
    () => [],
  ),
);
const lang = () => get().place.lang;

/** A scene for a request: its id, or the viewer's own as a document. @param {string} id */
const documentOf = (id) => (id === OWN && own ? asTyped(own) : id);

const bench = createBench(
  {
    lang,
    document: documentOf,
    run: (name, body, hear, signal, anew, wait) => experiment(send, name, body, hear, signal, anew, wait),
    scene: async (id) => (id === OWN && own ? completed(own) : api.scene(id, lang())),
    known,
  },
  usual(readQuestion(location.search, known)),
);

/** @param {import("./model/labs/question.js").Question} question */
function usual(question) {
  return question.scene ? question : { ...question, ...exampleOf(question.lab, known) };
}

const motion = createMotion(root, () => still.matches);
const charts = createCharts(root, pressed, () => update());
const watching = createWatch(api);

/** @param {Chart} chart @param {number} x @param {number} y @param {number} [curve]  the number of what was pressed */
function pressed(chart, x, y, curve = 0) {
  const meaning = chart.data[curve]?.meta;
  const orbit = meaning?.initial;
  if (orbit) return watch({ initial: orbit }, sceneFrom(orbit));
  const settled = resultOf(bench.get().result, "bifurcation");
  const found = settled && meaning ? motionAt(settled, meaning, x, y) : null;
  if (!found) return onMap(chart, x, y);
  const parameters = { ...bench.get().question.parameters, ...found.parameters };
  watch({ parameters, initial: found.initial }, sceneFrom(found.initial, found.parameters));
}

/** @param {Chart} chart @param {number} x @param {number} y */
function onMap(chart, x, y) {
  const map = chart.data.find((trace) => ["map", "flips", "basins"].includes(trace.meta?.role ?? ""))?.meta;
  if (map) watch(pointOf(bench.get().question, map, x, y));
}

/** Where an orbit is shown as a motion of its scene. @param {import("./model/values.js").Changes["initial"]} initial @param {Record<string, number>} [changed]  parameters that are others there */
function sceneFrom(initial, changed = {}) {
  const { scene, parameters } = bench.get().question;
  const set = writeChanges({ parameters: { ...parameters, ...changed }, initial }, 12);
  const { lang, theme } = get().place;
  const place = writePlace({ ...HOME, lang, theme, set, ...(scene === OWN ? {} : { scene }) });
  return `/scene${place}${scene === OWN ? ownFragment : ""}`;
}

/** Where one's own scene is edited. */
function editor() {
  const { lang, theme } = get().place;
  return `/scene${writePlace({ ...HOME, lang, theme, edit: "form" })}${ownFragment}`;
}

/** Simulates and plays what a chart points at; at the address it is open to all tools. @param {import("./model/labs/watch.js").Wish} wish @param {string} [address] */
function watch(wish, address = "") {
  const { question, scene } = bench.get();
  if (!scene) return;
  const { method, step = 0 } = wish;
  const title = method
    ? speech()("labs.played-method", { method: methodTitle(method), step: significant(step, 3, lang()) })
    : speech()("labs.played-point", { values: written(wish, lang()) });
  const told = (/** @type {string} */ status) => set({ play: { title, status, address } });
  void watching.ask(
    motionOf(question, wish, documentOf(question.scene), lang()),
    (trajectory) => {
      told(caveatsOf(trajectory, speech()).join(" "));
      queueMicrotask(() => motion.begin(scene, trajectory));
    },
    (error) => told(/** @type {Error} */ (error).message || speech()("failure.unreachable")),
  );
}

/** @param {string} name */
const section = (name) => get().catalog[name] ?? {};
/** Every experiment that there are words for, in their order. */
const labs = () => Object.keys(/** @type {{experiments?: object}} */ (section("labs")).experiments ?? {});
const speech = () =>
  translator({ ...section("page"), labs: section("labs"), ladder: section("ladder"), errors: section("errors") });

/** @param {string} id */
function methodTitle(id) {
  const title = translator(section("methods"))(`${id}.title`);
  return title === `${id}.title` ? id.replace(/^scipy-/, "SciPy ") : title;
}

let marked = /** @type {{from: Chart[], key: string, charts: Chart[]}} */ ({ from: [], key: "", charts: [] });
/** The same objects as before where nothing changed, so that nothing is drawn twice. */
function chartsNow() {
  const from = bench.get().charts;
  const key = JSON.stringify(get().dial) + String(bench.get().result !== null);
  if (marked.from !== from || marked.key !== key) marked = { from, key, charts: withMarks(bench.get(), get().dial) };
  return marked.charts;
}

/** @param {object} patch */
function link(patch) {
  const { question } = bench.get();
  const place = writePlace({ ...get().place });
  return `${location.pathname}${place}${place ? "&" : "?"}${writeQuestion({ ...question, ...patch }, known)}${question.scene === OWN ? location.hash : ""}`;
}

/** @param {string} accept */
async function fetchFile(accept) {
  const { question } = bench.get();
  const name = question.lab;
  const request = requestOf(answered(question, bench.get().scene, known), documentOf(question.scene), lang(), known);
  await file(send, name, request, accept).then(
    (blob) => offer(`${name}-${question.scene}.${accept === "text/csv" ? "csv" : "html"}`, blob, accept),
    bench.fail,
  );
}

/** A rung as a scene of its own. @param {import("./model/own.js").SceneDocument} scene */
async function open(scene) {
  const { lang, theme } = get().place;
  location.assign(`/scene${writePlace({ ...HOME, lang, theme })}${await fragmentOf(scene)}`);
}

/** @param {import("./model/types.js").Lang} wanted */
async function speak(wanted) {
  move({ lang: wanted });
  const catalog = await api.catalog(wanted, "labs", "ladder", "methods", "errors").catch(() => null);
  if (catalog && lang() === wanted) set({ catalog });
}

const session = {
  move,
  /** @param {import("./model/types.js").Lang} wanted */
  async language(wanted) {
    await speak(wanted);
    void bench.retell();
  },
};

let opened = "";
function update() {
  const { place, catalog, scenes, dial, play } = get();
  const theme = dressed(place, dark.matches);
  if (!catalog.page) return;
  const t = speech();
  document.title = `δq · ${t("place.labs")}`;
  const now = chartsNow();
  render(
    [
      page({
        state: { place: { ...place, scene: bench.get().question.scene } },
        session,
        t,
        bench: bench.get(),
        benches: starting,
        labs: labs(),
        known,
        scenes,
        charts: now,
        dial,
        play,
        methodTitle,
        fetchFile: (accept) => void fetchFile(accept),
        link,
        open: (scene) => void open(scene),
        editor,
        sceneFrom,
        watch,
        turn: (patch) => set({ dial: { ...get().dial, ...patch } }),
        cursor: get().cursor,
        point: (cursor) => set({ cursor }),
        press: pressed,
        save: (chart, format) => void charts.save(chart, format),
      }),
      missed([{ says: "missed.plots", later: charts.library, wanted: true }], t),
    ],
    root,
  );
  motion.arrange();
  if (opened !== bench.get().question.lab) showOpen(root);
  opened = bench.get().question.lab;
  void charts.show(now, theme, place.lang).then(() => charts.point(now, get().cursor));
  history.replaceState(null, "", link({}));
}

/** What was pointed at goes with the charts on which it stood. */
function clear() {
  watching.forget();
  set({ play: null, cursor: null, dial: { ...get().dial, step: 0 } });
}

/** The bench, which begins with the answers that the form shows. */
const starting = {
  ...bench,
  start() {
    clear();
    bench.edit(answered(bench.get().question, bench.get().scene, known));
    return bench.start();
  },
  /** @param {string} lab */
  open(lab) {
    clear();
    bench.open(lab);
  },
  /** @param {string} scene */
  choose(scene) {
    clear();
    bench.choose(scene);
  },
};

async function start() {
  own = (await documentIn(location.hash)) ?? readDraft(keeper())?.document ?? null;
  if (own) ownFragment = await fragmentOf(own);
  store.subscribe(update);
  bench.subscribe(update);
  dark.addEventListener("change", update);
  new ResizeObserver(update).observe(root);
  everyFrame(motion.advance);
  void api.scenes().then(
    ({ scenes }) => set({ scenes }),
    () => {},
  );
  const offered = speak(lang()).then(() => labs().includes(bench.get().question.lab) || bench.open(NOTHING.lab));
  await Promise.all([offered, bench.load()]);
  // In a lecture there may be no network when its turn comes.
  if (isGuest()) void starting.start();
}
void start();
