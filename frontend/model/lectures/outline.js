/** Changes of an own lecture, each a new one; what was before can be had back. */

import { FORMAT, MOST } from "./lecture.js";

/** @typedef {import("./lecture.js").Lecture} Lecture */
/** @typedef {import("./lecture.js").Stop} Stop */
/** @typedef {import("./lecture.js").Poll} Poll */
/** @typedef {{lecture: Lecture, past: Lecture[], what: string}} Outline  what: which change comes of one going on, as typing does */

const REMEMBERED = 100;

/** @param {string} title @returns {Lecture} */
export const blank = (title) => ({ format: FORMAT, title, stops: [] });

/** @param {Lecture} lecture @returns {Outline} */
export const begun = (lecture) => ({ lecture, past: [], what: "" });

/**
 * The outline after a change. Changes that say the same are one: a text is taken back whole, not by letters.
 * @param {Outline} outline @param {Lecture} lecture @param {string} [what] @returns {Outline}
 */
export function changed({ lecture: before, past, what: last }, lecture, what = "") {
  if (lecture === before) return { lecture, past, what };
  const goesOn = what !== "" && what === last;
  return { lecture, past: goesOn ? past : [...past, before].slice(-REMEMBERED), what };
}

/** @param {Outline} outline @returns {Outline} */
export const undone = ({ lecture, past }) =>
  past.length ? { lecture: past[past.length - 1], past: past.slice(0, -1), what: "" } : { lecture, past, what: "" };

/** @param {string} text @param {number} most */
const cut = (text, most) => (text.length > most ? `${text.slice(0, most - 1)}…` : text);

/** At the end, or behind a stop; the same lecture if it is full. @param {Lecture} lecture @param {Stop} stop @param {number} [behind] @returns {Lecture} */
export function withStop(lecture, stop, behind = lecture.stops.length - 1) {
  if (lecture.stops.length >= MOST.stops) return lecture;
  const title = cut(stop.title.replace(/\s+/g, " ").trim(), MOST.stop) || stop.place;
  const at = Math.max(0, Math.min(lecture.stops.length, behind + 1));
  return { ...lecture, stops: [...lecture.stops.slice(0, at), { ...stop, title }, ...lecture.stops.slice(at)] };
}

/** @param {Lecture} lecture @param {number} index @param {Partial<Stop>} patch @returns {Lecture} */
export const withPatch = (lecture, index, patch) => ({
  ...lecture,
  stops: lecture.stops.map((stop, i) => (i === index ? { ...stop, ...patch } : stop)),
});

/** @param {Lecture} lecture @param {number} index @returns {Lecture} */
export const withoutStop = (lecture, index) => ({ ...lecture, stops: lecture.stops.filter((_, i) => i !== index) });

/** A stop comes to stand at a place, the others in their order; held at both ends. @param {Lecture} lecture @param {number} from @param {number} to @returns {Lecture} */
export function moved(lecture, from, to) {
  const stop = lecture.stops[from];
  const place = Math.max(0, Math.min(lecture.stops.length - 1, to));
  if (!stop || place === from) return lecture;
  const rest = lecture.stops.filter((_, i) => i !== from);
  return { ...lecture, stops: [...rest.slice(0, place), stop, ...rest.slice(place)] };
}

/** A poll to begin with. @returns {Poll} */
export const emptyPoll = () => ({ question: "", choices: ["", ""], right: 1 });

/** @param {Poll} poll @param {number} index @param {string} text @returns {Poll} */
export const withChoice = (poll, index, text) => ({
  ...poll,
  choices: poll.choices.map((choice, i) => (i === index ? text : choice)),
});

/** One choice more, as long as there may be one. @param {Poll} poll @returns {Poll} */
export const moreChoices = (poll) =>
  poll.choices.length < MOST.choices ? { ...poll, choices: [...poll.choices, ""] } : poll;

/** A choice less; the right one stays the right one, if it stays. @param {Poll} poll @param {number} index @returns {Poll} */
export function fewerChoices(poll, index) {
  if (poll.choices.length <= 2) return poll;
  const { right } = poll;
  const now = right - 1 === index ? 1 : right - 1 > index ? right - 1 : right;
  return { ...poll, choices: poll.choices.filter((_, i) => i !== index), right: now };
}
