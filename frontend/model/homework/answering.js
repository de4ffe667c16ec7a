/** Answering one task: every keystroke is kept, read by the server when the hand rests, and checked when asked. */

import { latestOnly } from "../latest.js";
import { isComplete, isEmpty, joined, partsOf } from "./answer.js";
import { attempt } from "./attempt.js";
import { isOrdering } from "./ordering.js";
import { freedomsOf } from "../subject.js";

/** @typedef {import("./answer.js").Syntax} Syntax */
/** @typedef {import("./progress.js").Draft} Draft */
/** @typedef {import("./sheet.js").Entry} Entry */

const PAUSE = 250;
const MOST_LINES = 24;
const CARRIED = ["wrong", "follow_through"];

/** The texts of a draft's parts, as many as the task has. @param {Entry} entry @param {Draft} draft @param {Syntax} [syntax] */
export function partsIn({ task, scene }, draft, syntax = draft.syntax) {
  const count = Math.max(1, partsOf(task, freedomsOf(scene)));
  return Array.from({ length: count }, (_, i) => draft.texts[syntax][i] ?? "");
}

/** The answer as one text. @param {Entry} entry @param {Draft} draft */
export const valueOf = (entry, draft) => joined(partsIn(entry, draft), entry.task.form, draft.syntax);

/** @param {readonly string[]} a @param {readonly string[]} b */
export const sameTexts = (a, b) => a.length === b.length && a.every((text, i) => text === b[i]);

/** Whether what stands there was made from the other syntax, and not touched since. @param {Entry} entry @param {Draft} draft */
export const isTranslated = (entry, draft) =>
  draft.converted !== null &&
  draft.converted.from !== draft.syntax &&
  sameTexts(draft.converted.texts, partsIn(entry, draft));

/** Whether the last verdict is about what stands there now. @param {Entry} entry @param {Draft} draft */
export function isCurrent(entry, draft) {
  const { checked } = draft;
  if (checked?.syntax === draft.syntax) return checked.value === valueOf(entry, draft);
  return (
    checked !== null &&
    isTranslated(entry, draft) &&
    checked.value === valueOf(entry, { ...draft, syntax: checked.syntax })
  );
}

/** Why there is nothing to be checked. @param {Entry} entry @param {string[]} parts */
function missing({ task }, parts) {
  if (isOrdering(task)) return "homework.block-none-moved";
  return isEmpty(parts) ? "homework.empty" : "homework.incomplete";
}

/** What the server understands of what is typed, asked for when the hand rests. @param {import("./state.js").Store} store @param {import("./state.js").Api} api */
function createReading({ get, set }, api) {
  const readings = latestOnly(read, PAUSE);

  /** @param {{entry: Entry, syntax: Syntax, value: string}} wish @param {AbortSignal} signal */
  async function read({ entry, syntax, value }, signal) {
    const { lang } = get().asked.place;
    const answer = { ...entry.reference, task: entry.task.id, answer: { syntax, value }, lang };
    const reading = await api.post("/checks/reading", answer, signal).catch(() => null);
    if (reading && get().entry?.key === entry.key && valueOf(entry, get().draft) === value)
      set({ reading: { of: value, ...reading } });
  }

  function ask() {
    const { entry, draft } = get();
    if (!entry || isOrdering(entry.task)) return;
    const parts = partsIn(entry, draft);
    if (isEmpty(parts)) set({ reading: null });
    else if (isComplete(parts, entry.task.form))
      void readings.ask({ entry, syntax: draft.syntax, value: valueOf(entry, draft) });
  }

  return { ask, cancel: readings.cancel };
}

/**
 * @param {import("./state.js").Store} store @param {import("./state.js").Api} api @param {import("./progress.js").Progress} progress
 */
export function createAnswering(store, api, progress) {
  const { get, set } = store;
  const reading = createReading(store, api);

  /** @param {Entry} entry @param {(draft: Draft) => Partial<Draft>} change */
  function keep(entry, change) {
    const current = get().entry?.key === entry.key;
    const before = current ? get().draft : progress.draft(entry.key);
    const draft = { ...before, ...change(before) };
    const kept = progress.write(entry.key, draft);
    set(current ? { draft, kept } : { kept });
  }

  /** The student's own wrong answers to earlier tasks of the scene: what follows from them is no new mistake. @param {Entry} entry */
  function previous(entry) {
    const entries = get().sheet?.entries ?? [];
    const earlier = entries.slice(0, entries.indexOf(entry)).filter(({ group }) => group === entry.group);
    return earlier
      .flatMap(({ key, task }) => {
        const { checked } = progress.draft(key);
        return checked && CARRIED.includes(checked.verdict.outcome)
          ? [{ task: task.id, answer: { syntax: checked.syntax, value: checked.value } }]
          : [];
      })
      .slice(-MOST_LINES);
  }

  /** @param {Entry} entry @param {Syntax} syntax @param {string} value @param {number} counted as a try */
  async function verdict(entry, syntax, value, counted) {
    const { lang } = get().asked.place;
    await attempt(store, "trouble", "checking", async () => {
      const found = await api.post("/checks", {
        ...entry.reference,
        task: entry.task.id,
        answer: { syntax, value },
        previous: previous(entry),
        lang,
      });
      keep(entry, ({ tries, solved }) => ({
        checked: { verdict: found, syntax, value, lang },
        tries: tries + counted,
        solved: solved || found.outcome === "correct",
      }));
    });
  }

  return {
    keep,
    /** After another task, or another language, has come onto the page. */
    arrive() {
      reading.cancel();
      reading.ask();
      const { entry, draft, asked } = get();
      const { checked } = draft;
      if (entry && checked && checked.lang !== asked.place.lang) void verdict(entry, checked.syntax, checked.value, 0);
    },
    /** @param {number} part @param {string} text */
    type(part, text) {
      const { entry } = get();
      if (!entry) return;
      keep(entry, (draft) => ({
        texts: { ...draft.texts, [draft.syntax]: partsIn(entry, draft).map((old, i) => (i === part ? text : old)) },
      }));
      set({ notice: "" });
      reading.ask();
    },
    /** What stands there is meant so, and from now on it says so. @param {import("./progress.js").PossibleReading} one */
    reread(one) {
      const { entry } = get();
      if (!entry) return;
      keep(entry, (draft) => ({
        texts: {
          ...draft.texts,
          [draft.syntax]: partsIn(entry, draft).map((_, i) => (i === 0 ? one[draft.syntax] : "")),
        },
      }));
      set({ notice: "" });
      reading.ask();
    },
    async check() {
      const { entry, draft } = get();
      if (!entry) return;
      const parts = partsIn(entry, draft);
      if (!isComplete(parts, entry.task.form)) return set({ notice: missing(entry, parts) });
      set({ notice: "", answered: null });
      await verdict(entry, draft.syntax, valueOf(entry, draft), 1);
    },
    hint() {
      const { entry } = get();
      if (entry) keep(entry, ({ hints }) => ({ hints: Math.min(entry.task.hints.length, hints + 1) }));
    },
  };
}

/** @typedef {ReturnType<typeof createAnswering>} Answering */
