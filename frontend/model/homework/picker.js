/** A sheet in the making: tasks picked from a list, with points and rules; as a document, a file and an address. */

import { latestOnly } from "../latest.js";
import { asTyped, OWN, tableOf } from "../own.js";
import { createStore } from "../store.js";
import { ApiError } from "../api.js";
import { numberIn } from "../numbers.js";
import { fragmentOfAssignment } from "./assignment.js";
import { FIRST_SCENE } from "./place.js";
import { groupOf } from "./sheet.js";

/** @typedef {import("./sheet.js").Assignment} Assignment */
/** @typedef {Assignment["tasks"][number]} Assigned */
/** @typedef {import("./sheet.js").Task} Task */
/** @typedef {import("./sheet.js").Reference} Reference */
/** @typedef {{title: Record<string, string>, tasks: Task[]}} List  the tasks of a scene */
/**
 * @typedef {object} Picking
 * @property {Assignment} sheet  as it is so far
 * @property {string} scene  whose tasks are offered
 * @property {Record<string, List>} lists  by scene and language
 * @property {import("../types.js").Failure | null} failure  why there is no list
 * @property {import("../types.js").Failure | null} wrong  what is wrong with the sheet
 * @property {string} fragment  the end of the address for the class; "" while there is none
 * @property {string} code
 * @property {string} notice  the key of a sentence
 */

const KEY = "deltaq.sheet.1";
const PAUSE = 400;
const CHANGES = /** @type {const} */ (["scene", "guides", "freeze", "parameters"]);

/** @type {Assignment} */
const BLANK_SHEET = { format: 1, title: "", individual: false, follow_through: 0.5, tasks: [] };

/** What requests say of the scene of a task. @param {Assigned} task @returns {Reference} */
export const sceneIn = (task) =>
  /** @type {Reference} */ (
    Object.fromEntries(CHANGES.filter((name) => task[name] != null).map((name) => [name, task[name]]))
  );

/** @param {Reference} reference @param {string} lang */
export const listKey = (reference, lang) => `${lang} ${groupOf(reference)}`;

/** The sheet without what is as usual or empty. @param {Assignment} sheet @returns {Assignment} */
export function written({ tasks, ...rules }) {
  const given = Object.entries(rules).filter(([, value]) => value !== null && value !== undefined && value !== "");
  return /** @type {Assignment} */ ({ ...Object.fromEntries(given), tasks });
}

/** A sheet out of anything that was kept. @param {string | null} text @returns {Assignment} */
function sheetIn(text) {
  try {
    const found = tableOf(JSON.parse(text ?? "null"));
    return found && Array.isArray(found.tasks)
      ? /** @type {Assignment} */ (/** @type {unknown} */ (found))
      : BLANK_SHEET;
  } catch {
    return BLANK_SHEET;
  }
}

/** A moment as a field for date and time shows it, in the time of the place. @param {string | null | undefined} instant */
export function localOf(instant) {
  const time = new Date(instant ?? "");
  if (Number.isNaN(time.getTime())) return "";
  return new Date(time.getTime() - 60_000 * time.getTimezoneOffset()).toISOString().slice(0, 16);
}

/** And back. @param {string} local */
export function instantOf(local) {
  const time = new Date(local);
  return local && !Number.isNaN(time.getTime()) ? time.toISOString() : null;
}

/** A number that was typed, between bounds; null where it is none. @param {string} text @param {number} low @param {number} high */
export function bounded(text, low, high) {
  const value = numberIn(text);
  return Number.isFinite(value) ? Math.min(high, Math.max(low, value)) : null;
}

/**
 * @param {Pick<import("../api.js").Api, "post">} api @param {() => Pick<import("./state.js").State, "asked" | "assignment" | "own">} state
 * @param {import("../own.js").Keeper} keeper
 */
export function createPicker(api, state, keeper) {
  const begun = state().assignment ?? sheetIn(kept(keeper));
  const own = state().own;
  const store = createStore(
    /** @type {Picking} */ ({
      sheet: begun,
      scene: own ? OWN : state().asked.place.scene || FIRST_SCENE,
      lists: {},
      failure: null,
      wrong: null,
      fragment: "",
      code: "",
      notice: "",
    }),
  );
  const { get, set } = store;
  const lang = () => state().asked.place.lang;
  /** @returns {Reference} */
  const reference = () => ({ scene: get().scene === OWN && own ? asTyped(own) : get().scene });

  /** The tasks of a scene, once. @param {Reference} asked */
  async function list(asked) {
    const key = listKey(asked, lang());
    if (get().lists[key]) return;
    try {
      const { scene, tasks } = await api.post("/tasks", { ...asked, lang: lang() });
      const title = /** @type {Record<string, string>} */ (tableOf(scene)?.title ?? {});
      set({ lists: { ...get().lists, [key]: { title, tasks } }, failure: null });
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      set({ failure: error.failure });
    }
  }

  /** What the server says of the sheet: its code, or what is wrong with it. @param {Assignment} sheet @param {AbortSignal} signal */
  async function look(sheet, signal) {
    const assignment = written(sheet);
    try {
      const { code } = await api.post("/assignments", { assignment, lang: lang() }, signal);
      const fragment = await fragmentOfAssignment(assignment);
      if (get().sheet === sheet) set({ code, fragment, wrong: null });
    } catch (error) {
      if (error instanceof ApiError && get().sheet === sheet) set({ wrong: error.failure, fragment: "", code: "" });
      else if (!(error instanceof ApiError) && /** @type {Error} */ (error).name !== "AbortError") throw error;
    }
  }
  const looks = latestOnly(look, PAUSE);

  /** @param {Assignment} sheet @param {string} [notice] */
  function write(sheet, notice = "") {
    set({ sheet, notice, fragment: "", code: "", wrong: null });
    keep(keeper, JSON.stringify(sheet));
    if (sheet.tasks.length) void looks.ask(sheet);
    else looks.cancel();
  }

  /** @param {(tasks: Assigned[]) => Assigned[]} change */
  const alter = (change) => write({ ...get().sheet, tasks: change([...get().sheet.tasks]) });

  const fetchAll = () =>
    Promise.all([reference(), ...get().sheet.tasks.map(sceneIn)].map((one) => list(one))).then(() => {});

  if (begun.tasks.length) write(begun);

  return {
    get,
    subscribe: store.subscribe,
    reference,
    own: Boolean(own),
    /** The lists in the language of the page. */
    arrive: fetchAll,
    /** @param {string} scene */
    choose(scene) {
      set({ scene });
      return list(reference());
    },
    /** @param {Task[]} tasks */
    add(tasks) {
      const scene = reference();
      alter((all) => [...all, ...tasks.map(({ id, points }) => ({ ...scene, task: id, points }))]);
    },
    /** @param {number} index */
    remove: (index) => alter((all) => all.filter((_, i) => i !== index)),
    /** @param {number} index @param {number} by */
    move: (index, by) =>
      alter((all) => {
        const [one] = all.splice(index, 1);
        all.splice(Math.max(0, index + by), 0, one);
        return all;
      }),
    /** @param {number} index @param {number | null} points */
    weigh: (index, points) =>
      alter((all) => all.map((one, i) => (i === index ? { ...one, points: points ?? one.points } : one))),
    /** @param {Partial<Assignment>} patch */
    change: (patch) => write({ ...get().sheet, ...patch }),
    /** @param {Assignment} sheet */
    take: (sheet) => {
      write(sheet);
      return fetchAll();
    },
    clear: () => write(BLANK_SHEET),
    /** The sheet as it goes to students. */
    made: () => written(get().sheet),
    /** The text of the file. */
    file: () => JSON.stringify(written(get().sheet), null, 1),
  };
}

/** @param {import("../own.js").Keeper} keeper */
function kept(keeper) {
  try {
    return keeper.getItem(KEY);
  } catch {
    return null;
  }
}

/** @param {import("../own.js").Keeper} keeper @param {string} text */
function keep(keeper, text) {
  try {
    keeper.setItem(KEY, text);
  } catch {
    // The browser keeps nothing: the sheet is saved as a file.
  }
}

/** @typedef {ReturnType<typeof createPicker>} Picker */
