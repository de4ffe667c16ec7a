/** The viewer's lecture: how it is kept in the browser, and how it travels in an address. */

import { documentIn, fragmentOf, tableOf } from "../own.js";
import { lectureOf, MOST, tidy } from "./lecture.js";
import { blank, withStop } from "./outline.js";

/** @typedef {import("./lecture.js").Lecture} Lecture */
/** @typedef {import("../own.js").Keeper} Keeper */
/** @typedef {{lecture: Lecture | null, earlier: Lecture[]}} Draft  earlier: put aside for another one, the latest first */

export const KEY = "deltaq.lecture-draft.1";
const START = "#l=";
const SCENE = "#s=";
const EARLIER = 5;
/** Longer addresses do not survive mail and chat. */
export const LONGEST_LINK = 16_000;

/** What is being written may be unfinished: of a draft only its shape is asked. @param {unknown} value @returns {Lecture | null} */
function shaped(value) {
  const given = tableOf(value);
  if (!given || typeof given.title !== "string" || !Array.isArray(given.stops)) return null;
  const whole = { ...given, title: given.title || " " };
  const sound = given.stops.filter((stop) => !bare({ ...whole, stops: [stop] }).length);
  return tidy(/** @type {Lecture} */ ({ ...given, stops: sound.slice(0, MOST.stops) }));
}

/** What is wrong but for texts that are still empty. @param {unknown} value */
const bare = (value) => lectureOf(value).problems.filter(({ code }) => code !== "empty");

/** @param {Keeper} keeper @returns {Draft} */
export function readDraft(keeper) {
  try {
    const kept = tableOf(JSON.parse(keeper.getItem(KEY) ?? "null"));
    const earlier = Array.isArray(kept?.earlier) ? kept.earlier.map(shaped) : [];
    return { lecture: shaped(kept?.lecture), earlier: earlier.filter((one) => one !== null).slice(0, EARLIER) };
  } catch {
    return { lecture: null, earlier: [] };
  }
}

/** False where the browser keeps nothing. @param {Keeper} keeper @param {Draft} draft */
export function keepDraft(keeper, draft) {
  try {
    keeper.setItem(KEY, JSON.stringify(draft));
    return true;
  } catch {
    return false;
  }
}

/** Another lecture in its place; one with stops is put aside. @param {Draft} draft @param {Lecture} lecture @returns {Draft} */
export function replaced({ lecture: before, earlier }, lecture) {
  const same = (/** @type {Lecture} */ one) => JSON.stringify(one) === JSON.stringify(lecture);
  const aside = before?.stops.length ? [before, ...earlier] : earlier;
  return { lecture, earlier: aside.filter((one) => !same(one)).slice(0, EARLIER) };
}

/**
 * Appends a stop to the draft; how many there are then, 0 if it could not be kept.
 * @param {Keeper} keeper @param {import("./lecture.js").Stop} stop @param {string} title  of a lecture that begins with it
 */
export function appended(keeper, stop, title) {
  const draft = readDraft(keeper);
  const before = draft.lecture ?? blank(title);
  const lecture = withStop(before, stop);
  return lecture !== before && keepDraft(keeper, { ...draft, lecture }) ? lecture.stops.length : 0;
}

/** @param {Lecture} lecture */
export const fragmentOfLecture = async (lecture) =>
  START +
  (await fragmentOf(/** @type {import("../own.js").SceneDocument} */ ({ ...tidy(lecture) }))).slice(SCENE.length);

/** The lecture of a fragment, or what is wrong with it; null if there is none in it. @param {string} fragment */
export async function lectureInFragment(fragment) {
  if (!fragment.startsWith(START)) return null;
  const document = await documentIn(SCENE + fragment.slice(START.length));
  return document ? lectureOf(document) : { lecture: null, problems: [{ pointer: "", code: "link" }] };
}
