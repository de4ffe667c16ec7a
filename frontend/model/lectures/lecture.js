/** An own lecture as a document: what may stand in it, and what is wrong with one, at its exact place. */

import { tableOf } from "../own.js";
import { isPlace } from "./place.js";

/** @typedef {{question: string, choices: string[], right: number}} Poll  right: the number of the right choice, from 1 */
/** @typedef {{place: string, title: string, notes?: string, hide?: boolean, poll?: Poll}} Stop  hide: the result, until a key */
/** @typedef {{format: string, title: string, lang?: import("../types.js").Lang, stops: Stop[]}} Lecture */
/** @typedef {{pointer: string, code: string, most?: number, least?: number, name?: string}} Problem  pointer: RFC 6901 */

export const FORMAT = "deltaq-lecture/1";
/** Characters, or how many. */
export const MOST = {
  title: 120,
  stops: 120,
  stop: 160,
  notes: 8000,
  question: 400,
  choice: 200,
  choices: 4,
  document: 400_000,
};
const LEAST_CHOICES = 2;
const LANGS = ["de", "en"];

/** Whoever writes texts may break lines only in notes. */
// eslint-disable-next-line no-control-regex
const CONTROL = /[\u0000-\u001f\u007f\u2028\u2029]/;

/** @typedef {(problem: Problem) => void} Tell */

/** @param {string} pointer @param {unknown} value @param {number} most @param {Tell} tell @param {{empty?: boolean, lines?: boolean}} [options] */
function checkText(pointer, value, most, tell, { empty = false, lines = false } = {}) {
  if (typeof value !== "string") return tell({ pointer, code: "text" });
  if (!empty && !value.trim()) return tell({ pointer, code: "empty" });
  if (value.length > most) return tell({ pointer, code: "long", most });
  if (CONTROL.test(lines ? value.replace(/[\n\r\t]/g, "") : value)) tell({ pointer, code: "control" });
}

/** Members that nothing reads are mistakes: a misspelt one would be lost in silence. @param {string} pointer @param {object} table @param {readonly string[]} known @param {Tell} tell */
function checkMembers(pointer, table, known, tell) {
  for (const name of Object.keys(table))
    if (!known.includes(name)) {
      const part = name.slice(0, 40).replaceAll("~", "~0").replaceAll("/", "~1");
      tell({ pointer: `${pointer}/${part}`, code: "unknown", name: name.slice(0, 40) });
    }
}

/** @param {string} pointer @param {unknown} value @param {Tell} tell */
function checkPoll(pointer, value, tell) {
  const poll = tableOf(value);
  if (!poll) return tell({ pointer, code: "table" });
  checkMembers(pointer, poll, ["question", "choices", "right"], tell);
  checkText(`${pointer}/question`, poll.question, MOST.question, tell);
  const { choices, right } = poll;
  if (!Array.isArray(choices) || choices.length < LEAST_CHOICES || choices.length > MOST.choices)
    return tell({ pointer: `${pointer}/choices`, code: "choices", least: LEAST_CHOICES, most: MOST.choices });
  choices.forEach((choice, i) => checkText(`${pointer}/choices/${i}`, choice, MOST.choice, tell));
  if (!Number.isInteger(right) || Number(right) < 1 || Number(right) > choices.length)
    tell({ pointer: `${pointer}/right`, code: "right", least: 1, most: choices.length });
}

/** @param {string} pointer @param {unknown} value @param {Tell} tell */
function checkStop(pointer, value, tell) {
  const stop = tableOf(value);
  if (!stop) return tell({ pointer, code: "table" });
  checkMembers(pointer, stop, ["place", "title", "notes", "hide", "poll"], tell);
  if (!isPlace(stop.place)) tell({ pointer: `${pointer}/place`, code: "place" });
  checkText(`${pointer}/title`, stop.title, MOST.stop, tell);
  if (stop.notes !== undefined)
    checkText(`${pointer}/notes`, stop.notes, MOST.notes, tell, { empty: true, lines: true });
  if (stop.hide !== undefined && typeof stop.hide !== "boolean") tell({ pointer: `${pointer}/hide`, code: "flag" });
  if (stop.poll !== undefined) checkPoll(`${pointer}/poll`, stop.poll, tell);
}

/** All that is wrong with what should be a lecture; nothing, if it is one. @param {unknown} value @returns {Problem[]} */
export function problemsOf(value) {
  /** @type {Problem[]} */
  const found = [];
  const tell = (/** @type {Problem} */ problem) => void found.push(problem);
  const lecture = tableOf(value);
  if (!lecture) return [{ pointer: "", code: "table" }];
  if (lecture.format !== FORMAT) return [{ pointer: "/format", code: "format", name: FORMAT }];
  checkMembers("", lecture, ["format", "title", "lang", "stops"], tell);
  checkText("/title", lecture.title, MOST.title, tell);
  if (lecture.lang !== undefined && !LANGS.includes(String(lecture.lang))) tell({ pointer: "/lang", code: "lang" });
  if (!Array.isArray(lecture.stops)) tell({ pointer: "/stops", code: "list" });
  else if (lecture.stops.length > MOST.stops) tell({ pointer: "/stops", code: "many", most: MOST.stops });
  else lecture.stops.forEach((stop, i) => checkStop(`/stops/${i}`, stop, tell));
  return found;
}

/** A valid document as it is kept: members that say nothing are left out. @param {Lecture} given @returns {Lecture} */
export const tidy = ({ title, lang, stops }) => ({
  format: FORMAT,
  title,
  ...(lang ? { lang } : {}),
  stops: stops.map(({ place, title: called, notes, hide, poll }) => ({
    place,
    title: called,
    ...(notes ? { notes } : {}),
    ...(hide ? { hide } : {}),
    ...(poll ? { poll } : {}),
  })),
});

/**
 * The lecture in a value that came from outside, and what is wrong with it.
 * @param {unknown} value @returns {{lecture: Lecture | null, problems: Problem[]}}
 */
export function lectureOf(value) {
  const problems = problemsOf(value);
  return { lecture: problems.length ? null : tidy(/** @type {Lecture} */ (value)), problems };
}

/** The same for a file's text. @param {string} text @returns {{lecture: Lecture | null, problems: Problem[]}} */
export function lectureIn(text) {
  if (text.length > MOST.document)
    return { lecture: null, problems: [{ pointer: "", code: "long", most: MOST.document }] };
  try {
    return lectureOf(JSON.parse(text));
  } catch {
    return { lecture: null, problems: [{ pointer: "", code: "json" }] };
  }
}

/** @param {Lecture} lecture */
export const textOf = (lecture) => `${JSON.stringify(tidy(lecture), null, 2)}\n`;

/** What a file of it is called. @param {Lecture} lecture */
export const fileNameOf = ({ title }) =>
  title
    .toLowerCase()
    .replace(/[^\p{L}\p{N}]+/gu, "-")
    .replace(/^-|-$/g, "")
    .slice(0, 60) || "lecture";
