/** Which steps are shown: all up to the current one. */

/** @typedef {import("./types.js").Chapter} Chapter */
/** @typedef {import("./types.js").Step} Step */
/** @typedef {{step: Step, chapter: Chapter, chapterIndex: number, number: string, index: number}} Line */

/**
 * All steps in order, numbered 1.1, 1.2, 2.1 … by chapter.
 * @param {readonly Chapter[]} chapters
 * @returns {Line[]}
 */
export function linesOf(chapters) {
  return chapters
    .flatMap((chapter, c) =>
      chapter.steps.map((step, s) => ({ step, chapter, chapterIndex: c, number: `${c + 1}.${s + 1}`, index: 0 })),
    )
    .map((line, index) => ({ ...line, index }));
}

/**
 * Where a step stands; an unknown id means the first step.
 * @param {readonly Line[]} lines @param {string} id
 */
export function indexOf(lines, id) {
  return Math.max(
    0,
    lines.findIndex((line) => line.step.id === id),
  );
}

/**
 * The id of the step `by` steps on, held at both ends.
 * @param {readonly Line[]} lines @param {string} id @param {number} by
 */
export function moved(lines, id, by) {
  if (!lines.length) return id;
  const to = Math.max(0, Math.min(lines.length - 1, indexOf(lines, id) + by));
  return lines[to].step.id;
}
