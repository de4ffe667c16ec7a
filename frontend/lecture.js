/** The driver of own lectures: the outline, the hall in which one is given, and the presenter's window of that hall. */

import { render } from "lit-html";
import { translator } from "./model/catalog.js";
import { isId } from "./model/lecture/link.js";
import {
  fragmentOfLecture,
  keepDraft,
  KEY,
  lectureInFragment,
  LONGEST_LINK,
  readDraft,
  replaced,
} from "./model/lectures/draft.js";
import { fileNameOf, lectureIn, problemsOf, textOf } from "./model/lectures/lecture.js";
import { begun, blank, changed, moved, undone, withoutStop, withPatch, withStop } from "./model/lectures/outline.js";
import { placeOf } from "./model/lectures/place.js";
import { plainly } from "./model/prose.js";
import { addressOf, COURSE } from "./model/start/course.js";
import { createLater } from "./model/later.js";
import { createStore, mover } from "./model/store.js";
import { HOME, readPlace, startPlace, writePlace } from "./model/url.js";
import { api } from "./server.js";
import { styled } from "./view/bring.js";
import { offer, toClipboard } from "./view/files.js";
import { dressed } from "./view/header.js";
import { keeper } from "./view/keeper.js";
import { page } from "./view/lectures/page.js";
import { openWindow } from "./view/lectures/window.js";
import { missed } from "./view/missed.js";
import { paper } from "./view/lectures/notes.js";

/** @typedef {import("./model/lectures/lecture.js").Lecture} Lecture */
/** @typedef {import("./view/lectures/page.js").Notice} Notice */

const root = /** @type {HTMLElement} */ (document.getElementById("page"));
const dark = matchMedia("(prefers-color-scheme: dark)");
const query = new URLSearchParams(location.search);
const asked = readPlace(location.search);
const store = createStore({
  place: startPlace(asked, navigator.languages),
  catalog: /** @type {import("./model/types.js").Catalog} */ ({}),
  outline: begun(blank("")),
  keys: /** @type {number[]} */ ([]),
  earlier: /** @type {Lecture[]} */ ([]),
  open: -1,
  problems: /** @type {import("./model/lectures/lecture.js").Problem[]} */ ([]),
  notice: /** @type {Notice | null} */ (null),
  kept: true,
  printing: false,
});
const { get, set } = store;
let giving = false;
let counted = 0;
const newKey = () => (counted += 1);
const texts = () => {
  const { page: everywhere, start, lecture, lectures } = get().catalog;
  return translator({ ...everywhere, ...start, ...lecture, ...lectures });
};
const hall = createLater(() => styled(import("./view/lectures/open-hall.js"), "hall"), update);
/** The stop at which a lecture was to begin. */
let first = 0;

/** @param {import("./model/types.js").Lang} lang */
async function speak(lang) {
  set({ place: { ...get().place, lang } });
  const catalog = await api.catalog(lang, "start", "lecture", "lectures").catch(() => null);
  if (catalog && get().place.lang === lang) set({ catalog });
}

/** What is shown is what is kept. @param {Partial<ReturnType<typeof get>>} patch */
function keep(patch) {
  set({ problems: [], notice: null, ...patch });
  const { outline, earlier } = get();
  set({ kept: keepDraft(keeper(), { lecture: outline.lecture, earlier }) });
}

/** @param {Lecture} lecture @param {number[]} [keys] @param {string} [what] */
function change(lecture, keys = get().keys, what = "") {
  keep({ outline: changed(get().outline, lecture, what), keys });
}

/** Another lecture in the place of the one at hand, which is put aside. @param {Lecture} lecture @param {Notice | null} [notice] */
function replace(lecture, notice = null) {
  const { earlier } = replaced({ lecture: get().outline.lecture, earlier: get().earlier }, lecture);
  keep({ outline: begun(lecture), keys: lecture.stops.map(newKey), earlier, open: -1, notice });
}

/** After the page is drawn anew. @param {number} key @param {string} at */
const focus = (key, at) =>
  queueMicrotask(() => {
    const stop = root.querySelector(`[data-stop="${key}"]`);
    const wanted = /** @type {HTMLButtonElement | null} */ (stop?.querySelector(`[data-at="${at}"]`));
    const found = wanted?.disabled ? stop?.querySelector('[data-at="title"]') : wanted;
    if (found instanceof HTMLElement) found.focus({ preventScroll: true });
    stop?.scrollIntoView({ block: "nearest" });
  });

/** @param {string} words */
function announce(words) {
  const region = document.getElementById("announcer");
  if (region) region.textContent = words;
}

/** A stop at the end. @param {string} place @param {string} title */
function append(place, title) {
  const { lecture } = get().outline;
  const longer = withStop(lecture, { place, title });
  if (longer === lecture) return set({ notice: { key: "lectures.full" } });
  change(longer, [...get().keys, newKey()]);
  set({ notice: { key: "lectures.added", parameters: { number: longer.stops.length } } });
}

/** @param {{lecture: Lecture | null, problems: import("./model/lectures/lecture.js").Problem[]}} read */
function take({ lecture, problems }) {
  if (lecture) replace(lecture, { key: "lectures.opened", parameters: { count: lecture.stops.length } });
  else set({ problems, notice: null });
}

/** @param {import("./model/types.js").Lang} lang */
async function shipped(lang) {
  const answer = await fetch(`/lectures/seed.${lang}.json`).catch(() => null);
  if (answer?.ok) take(lectureIn(await answer.text()));
  else set({ notice: { key: "failure.unreachable" } });
}

/** Unfinished texts are said where they stand before anybody sees them. */
function isFinished() {
  const problems = problemsOf({ ...get().outline.lecture, title: get().outline.lecture.title || "–" });
  set({ problems, notice: null });
  return !problems.length;
}

/** @type {import("./view/lectures/page.js").OutlineView["acts"]} */
const acts = {
  start(index = 0) {
    if (isFinished()) void give(index);
  },
  rename: (title) => change({ ...get().outline.lecture, title }, undefined, "title"),
  patch: (index, patch, what) => change(withPatch(get().outline.lecture, index, patch), undefined, what),
  move(from, to, at) {
    const { outline, keys } = get();
    const lecture = moved(outline.lecture, from, to);
    if (lecture === outline.lecture) return;
    const key = keys[from];
    const others = keys.filter((one) => one !== key);
    const place = lecture.stops.indexOf(outline.lecture.stops[from]);
    change(lecture, [...others.slice(0, place), key, ...others.slice(place)]);
    focus(key, at ?? "title");
    announce(
      texts()("lectures.moved", { title: plainly(lecture.stops[place].title), number: place + 1, count: keys.length }),
    );
  },
  remove(index) {
    const { outline, keys } = get();
    const { title } = outline.lecture.stops[index];
    const left = keys.filter((_, i) => i !== index);
    change(withoutStop(outline.lecture, index), left);
    set({ notice: { key: "lectures.removed", parameters: { title: plainly(title) } } });
    if (left.length) focus(left[Math.min(index, left.length - 1)], "remove");
  },
  unfold: (key) => set({ open: get().open === key ? -1 : key }),
  undo() {
    const outline = undone(get().outline);
    const keys = outline.lecture.stops.map((stop) => get().keys[get().outline.lecture.stops.indexOf(stop)] ?? newKey());
    keep({ outline, keys: new Set(keys).size === keys.length ? keys : keys.map(newKey) });
  },
  add(address) {
    const place = placeOf(address, location.origin);
    if (place) append(place, placeTitle(place));
    else set({ notice: { key: "lectures.no-place" } });
    return Boolean(place);
  },
  addFromCourse(part, id) {
    const entry = COURSE.find((one) => one.id === part)?.entries.find((one) => one.id === id);
    const place = entry && placeOf(addressOf(entry, { lang: "en", theme: "auto" }), location.origin);
    if (place) append(place, texts()(`course.${part}.${id}`));
  },
  save: () => {
    if (isFinished())
      offer(`${fileNameOf(get().outline.lecture)}.json`, textOf(get().outline.lecture), "application/json");
  },
  async load(file) {
    if (file) take(lectureIn(await file.text()));
  },
  async link() {
    if (!isFinished()) return;
    const { lang } = get().place;
    const address = `${location.origin}/lecture?lang=${lang}${await fragmentOfLecture(get().outline.lecture)}`;
    if (address.length > LONGEST_LINK) return set({ notice: { key: "lectures.link-long" } });
    history.replaceState(null, "", address);
    set({ notice: { key: (await toClipboard(address)) ? "lectures.copied" : "lectures.copy-by-hand" } });
  },
  print() {
    set({ printing: true });
    setTimeout(() => print());
  },
  anew: () => replace(blank("")),
  restore: (index) => replace(get().earlier[index]),
  openShipped: () => shipped(get().place.lang),
};

/** Until somebody finds a better one. @param {string} place */
const placeTitle = (place) => {
  const { step, scene } = readPlace(new URL(place, location.origin).search);
  return [texts()(`place.${place.split(/[?#]/)[0]}`), scene, step].filter(Boolean).join(": ");
};

/** The address says where a lecture that is given stands, so that a reload goes on there. @param {number | null} index */
function address(index) {
  const { place } = get();
  const start = writePlace({ ...HOME, lang: place.lang, theme: place.theme });
  const fragment = location.hash.startsWith("#l=") ? location.hash : "";
  history.replaceState(
    null,
    "",
    location.pathname + (index === null ? start : `${start}${start ? "&" : "?"}give=${index + 1}`) + fragment,
  );
}

/** @param {number} index */
async function give(index) {
  first = index;
  const part = await hall.again();
  if (!part) return;
  const { place, outline } = get();
  giving = true;
  render(null, root);
  address(index);
  const left = () => {
    giving = false;
    render(null, root);
    address(null);
    update();
  };
  part.openHall({
    root,
    lecture: outline.lecture,
    reader: { lang: outline.lecture.lang ?? place.lang, theme: place.theme },
    at: index,
    t: texts(),
    moved: address,
    left,
  });
}

function update() {
  const { place, catalog, outline, ...state } = get();
  dressed(place, dark.matches);
  if (!catalog.page || giving) return;
  const t = texts();
  document.title = `δq · ${outline.lecture.title || t("place.lecture")}`;
  const session = { language: speak, move: mover(store) };
  render(
    [
      page({
        ...state,
        state: { place },
        session,
        t,
        lecture: outline.lecture,
        undoable: outline.past.length > 0,
        acts,
      }),
      missed([{ says: "missed.hall", later: { failed: hall.failed, again: () => give(first) }, wanted: true }], t),
      state.printing ? paper(outline.lecture, t) : null,
    ],
    root,
  );
  address(null);
}

/** What this browser keeps, as another window has left it. */
function recall() {
  const { lecture, earlier } = readDraft(keeper());
  if (lecture) set({ outline: changed(get().outline, lecture), keys: lecture.stops.map(newKey), earlier });
}

async function begin() {
  store.subscribe(update);
  dark.addEventListener("change", update);
  addEventListener("afterprint", () => set({ printing: false }));
  addEventListener("storage", ({ key }) => key === KEY && !giving && recall());
  await speak(get().place.lang);
  const { lecture, earlier } = readDraft(keeper());
  if (lecture) set({ outline: begun(lecture), keys: lecture.stops.map(newKey), earlier });
  const sent = await lectureInFragment(location.hash);
  if (sent?.lecture && JSON.stringify(sent.lecture) === JSON.stringify(lecture)) set({ notice: null });
  else if (sent) take(sent);
  if (query.has("shipped")) await shipped(get().place.lang);
  const at = Number(query.get("give"));
  if (at > 0 && get().outline.lecture.stops.length && isFinished()) await give(at - 1);
}

const desk = query.get("with");
if (isId(desk)) {
  await speak(get().place.lang);
  dressed(get().place, dark.matches);
  void openWindow({ root, id: /** @type {string} */ (desk), reader: get().place, t: texts() });
} else void begin();
