/** The page's course: scenes and assignments become a sheet of tasks, of which one is worked on. */

import { asTyped } from "../own.js";
import { attempt } from "./attempt.js";
import { createComparison } from "./comparison.js";
import { drillName, FIRST_SCENE } from "./place.js";
import { referenceOf, sheetOfAssignment, sheetOfExercise, sheetOfScene } from "./sheet.js";
import { createSolution } from "./solution.js";
import { FRESH } from "./state.js";

/** @typedef {import("./place.js").Asked} Asked */
/** @typedef {import("./state.js").State} State */
/** @typedef {import("./sheet.js").Entry} Entry */
/** @typedef {import("./sheet.js").Assignment} Assignment */

/** What tells sheets apart: an exercise is its own, whatever scene one comes from. @param {import("./place.js").Address} asked */
const sheetName = ({ side, drill, seed, place }) =>
  side === "practice" ? drillName(drill) : ["sheet", seed, place.scene].join("~");

/** Whether both ask for the same sheet. @param {import("./place.js").Address} a @param {Asked} b */
export const isSame = (a, b) => sheetName(a) === sheetName(b) && a.place.lang === b.place.lang;
/** And for that of the same assignment, or of the same scene that was brought along. @param {State} a @param {State} b */
const isStill = (a, b) => a.assignment === b.assignment && a.own === b.own && isSame(a.asked, b.asked);

/** The sheet that is asked for, in the language of the page. @param {import("./state.js").Api} api @param {State} state */
async function fetchSheet(
  api,
  {
    asked: {
      side,
      drill,
      seed,
      place: { scene, lang },
    },
    assignment,
    own,
  },
) {
  if (side === "practice")
    return sheetOfExercise(drillName(drill), await api.post("/practice", { ...questionOf(drill), lang }));
  if (assignment)
    return sheetOfAssignment(
      assignment,
      seed,
      await api.post("/assignments", { assignment, ...(seed ? { seed } : {}), lang }),
    );
  const reference = referenceOf(own ? asTyped(own) : scene || FIRST_SCENE, seed);
  return sheetOfScene(reference, await api.post("/tasks", { ...reference, lang }));
}

/** @param {import("./place.js").Drill} drill */
const questionOf = ({ series: seed, level, number, recall, kind }) => ({
  ...{ seed, level, number },
  ...(recall ? { recall, ...(kind ? { kind } : {}) } : {}),
});

/**
 * @param {import("./state.js").Store} store @param {import("./state.js").Api} api @param {import("./progress.js").Progress} progress
 * @param {import("./answering.js").Answering} answering
 */
export function createExercise(store, api, progress, answering) {
  const { get, set } = store;
  /** @param {Partial<Asked>} patch */
  const ask = (patch) => set({ asked: { ...get().asked, ...patch } });
  const { animate, ...comparison } = createComparison(store, api);
  const solve = createSolution(store, api, answering);
  const workingKey = () => `${get().entry?.group}/~working`;

  async function load() {
    const wanted = get();
    await attempt(store, wanted.sheet ? "trouble" : "failure", "", async () => {
      const sheet = await fetchSheet(api, wanted).catch((error) => {
        if (isStill(get(), wanted)) throw error;
      });
      if (!sheet || !isStill(get(), wanted)) return;
      set({ sheet });
      const { entries } = sheet;
      show(
        entries.find(({ key }) => key === get().entry?.key) ??
          entries.find(({ id }) => id === get().asked.task) ??
          entries[0] ??
          null,
      );
    });
  }

  /** @param {Entry | null} entry */
  function show(entry) {
    const before = get().entry;
    const elsewhere = entry?.group !== before?.group;
    const other = entry?.key !== before?.key;
    ask({ task: entry?.id ?? "" });
    set({ entry, ...(other ? FRESH : {}), ...(entry && other ? { draft: progress.draft(entry.key) } : {}) });
    if (elsewhere) set({ right: null, still: false, guides: [], lines: progress.lines(workingKey()), marked: null });
    answering.arrive();
    if (!entry) return;
    if (elsewhere) void animate(entry);
    if (get().solution) void solve();
  }

  return {
    load,
    solve,
    show,
    ...comparison,
    /** @param {Asked} asked @param {Assignment | null} assignment @param {import("../own.js").SceneDocument | null} own  a scene that the address brings along */
    async start(asked, assignment, own) {
      set({ asked, assignment, own });
      const listed = api
        .scenes()
        .then(({ scenes }) => set({ scenes }))
        .catch(() => {});
      await Promise.all([listed, load()]);
    },
    /** Another scene; what was typed for this one is kept. @param {string} scene */
    choose(scene) {
      ask({ task: "", place: { ...get().asked.place, scene } });
      set({ assignment: null, own: null, sheet: null, entry: null });
      return load();
    },
    /** @param {string} seed */
    individual(seed) {
      ask({ seed });
      return load();
    },
    /** @param {Assignment} assignment */
    assign(assignment) {
      ask({ task: "" });
      set({ assignment, own: null, sheet: null, entry: null });
      return load();
    },
    /** @param {Partial<Asked["place"]>} patch */
    move: (patch) => ask({ place: { ...get().asked.place, ...patch } }),
    /** Another side of the page; who leaves practice comes back to the tasks. @param {Asked["side"]} side */
    turn(side) {
      const leaves = get().asked.side === "practice" && side !== "practice";
      ask({ side, ...(leaves ? { task: "" } : {}) });
      if (!leaves) return;
      set({ sheet: null, entry: null });
      void load();
    },
    /** An exercise drawn at random. @param {import("./place.js").Drill} drill */
    drill(drill) {
      ask({ side: "practice", drill, task: "" });
      set({ sheet: null, entry: null });
      return load();
    },
    /** @param {import("./progress.js").Line[]} lines */
    write(lines) {
      set({ lines, kept: progress.write(workingKey(), lines) });
    },
  };
}

/** @typedef {ReturnType<typeof createExercise>} Exercise */
