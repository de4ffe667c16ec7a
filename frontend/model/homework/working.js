/** A whole working: lines that answer one task each, marked together. */

import { attempt } from "./attempt.js";
import { valueOf } from "./answering.js";
import { isOrdering } from "./ordering.js";

/** @typedef {import("./progress.js").Line} Line */

const MOST = 24;

/** The working as a text that tells whether it is still the one that was marked. @param {readonly Line[]} lines */
export const fingerprint = (lines) => JSON.stringify(lines);

/**
 * @param {import("./state.js").Store} store @param {import("./state.js").Api} api @param {import("./progress.js").Progress} progress
 * @param {import("./exercise.js").Exercise} exercise
 */
export function createWorking(store, api, progress, exercise) {
  const { get, set } = store;
  /** An order of blocks is no line. */
  const entries = () =>
    (get().sheet?.entries ?? []).filter(({ group, task }) => group === get().entry?.group && !isOrdering(task));

  /** The task after the last one that was answered. */
  function nextTask() {
    const tasks = entries();
    const last = get().lines.at(-1);
    const index = last ? tasks.findIndex(({ task }) => task.id === last.task) + 1 : 0;
    return (tasks[index] ?? tasks.at(-1))?.task.id ?? "";
  }

  return {
    entries,
    add() {
      const { lines, draft } = get();
      if (lines.length < MOST)
        exercise.write([...lines, { task: nextTask(), syntax: lines.at(-1)?.syntax ?? draft.syntax, value: "" }]);
    },
    /** @param {number} index @param {Partial<Line>} patch */
    edit: (index, patch) => exercise.write(get().lines.map((line, i) => (i === index ? { ...line, ...patch } : line))),
    /** @param {number} index */
    remove: (index) => exercise.write(get().lines.filter((_, i) => i !== index)),
    /** One line for each task that has been answered by itself. */
    gather() {
      const answered = entries().map((entry) => ({ entry, draft: progress.draft(entry.key) }));
      const lines = answered.map(({ entry, draft }) => ({
        task: entry.task.id,
        syntax: draft.syntax,
        value: valueOf(entry, draft),
        blank: !draft.texts[draft.syntax].some((text) => text.trim()),
      }));
      exercise.write(
        lines
          .filter(({ blank }) => !blank)
          .slice(0, MOST)
          .map(({ blank: _, ...line }) => line),
      );
    },
    /** A line in the other syntax; it stays as it is where it cannot be read. @param {number} index */
    async convert(index) {
      const { lines, entry, asked } = get();
      const line = lines[index];
      const to = line.syntax === "plain" ? "latex" : "plain";
      if (!entry || !line.value.trim())
        return exercise.write(lines.map((one, i) => (i === index ? { ...one, syntax: to } : one)));
      const read = await api
        .post("/checks/reading", {
          ...entry.reference,
          task: line.task,
          answer: { syntax: line.syntax, value: line.value },
          lang: asked.place.lang,
        })
        .catch(() => null);
      if (get().lines[index] !== line) return;
      if (!read || read.problems.length) return set({ notice: `homework.kept-${line.syntax}` });
      exercise.write(get().lines.map((one, i) => (i === index ? { ...one, syntax: to, value: read[to] } : one)));
    },
    async mark() {
      const { entry, asked, sheet } = get();
      const lines = get().lines.filter(({ value }) => value.trim());
      if (!entry || !lines.length) return set({ notice: "homework.empty" });
      exercise.write(lines);
      await attempt(store, "trouble", "marking", async () => {
        const points = Object.fromEntries(entries().map(({ task }) => [task.id, task.points]));
        const scheme = {
          points,
          follow_through: sheet?.followThrough ?? 0.5,
          simplified: sheet?.simplified ?? 0.5,
        };
        const body = {
          ...entry.reference,
          lines: lines.map(({ task, syntax, value }) => ({ task, answer: { syntax, value } })),
          scheme,
          lang: asked.place.lang,
        };
        const { lines: marks, first_wrong, points: earned, of } = await api.post("/checks/lines", body);
        set({ marked: { of: fingerprint(lines), lines: marks, first_wrong, points: earned, total: of } });
      });
    },
  };
}

/** @typedef {ReturnType<typeof createWorking>} Working */
