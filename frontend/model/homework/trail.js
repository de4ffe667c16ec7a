/** The way from task to task: each is a place in the browser's history, so that "back" leads to the task before. */

import { isSame } from "./exercise.js";
import { readAsked } from "./place.js";

/**
 * @param {Pick<History, "pushState" | "replaceState">} past @param {Pick<Location, "pathname" | "search" | "hash">} here
 */
export function createTrail(past, here) {
  let at = "";
  /**
   * Written only when it is another one: it would call off a way that has just been taken.
   * @param {string} address @param {string} task  which one it leads to, "" while it is on its way
   */
  return (address, task) => {
    if (!task && at) return;
    if (address !== here.pathname + here.search + here.hash)
      past[at && task !== at ? "pushState" : "replaceState"](null, "", address);
    at = task;
  };
}

/**
 * Shows the task that the address names again, or draws its exercise again; false if it stands on another sheet.
 * @param {import("./state.js").State} state @param {Pick<import("./exercise.js").Exercise, "show" | "turn" | "drill">} exercise @param {string} query
 */
export function retrace({ asked, sheet }, exercise, query) {
  const there = readAsked(query);
  const inPractice = [there, asked].every(({ side }) => side === "practice") && Boolean(there.drill.number);
  if (inPractice && !isSame(there, asked) && there.place.lang === asked.place.lang) {
    void exercise.drill(there.drill);
    return true;
  }
  const entry = isSame(there, asked) ? sheet?.entries.find(({ id }) => id === there.task) : null;
  if (!entry) return false;
  exercise.turn(there.side);
  exercise.show(entry);
  return true;
}
