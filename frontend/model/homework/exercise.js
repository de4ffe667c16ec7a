/** The page's course: scenes and assignments become a sheet of tasks, of which one is worked on; solution when asked for. */

import { attempt } from "./attempt.js";
import { createComparison } from "./comparison.js";
import { FIRST_SCENE } from "./place.js";
import { referenceOf, sheetOfAssignment, sheetOfScene } from "./sheet.js";
import { FRESH } from "./state.js";

/** @typedef {import("./place.js").Asked} Asked */
/** @typedef {import("./sheet.js").Entry} Entry */
/** @typedef {import("./sheet.js").Assignment} Assignment */

/** Whether both ask for the same sheet. @param {Asked} a @param {Asked} b */
const isSame = (a, b) => a.seed === b.seed && a.place.scene === b.place.scene && a.place.lang === b.place.lang;

/**
 * @param {import("./state.js").Store} store @param {import("./state.js").Api} api @param {import("./progress.js").Progress} progress
 * @param {import("./answering.js").Answering} answering
 */
export function createExercise(store, api, progress, answering) {
  const { get, set } = store;
  /** @param {Partial<Asked>} patch */
  const ask = (patch) => set({ asked: { ...get().asked, ...patch } });
  const lang = () => get().asked.place.lang;
  const { animate, ...comparison } = createComparison(store, api);
  const workingKey = () => `${get().entry?.group}/~working`;

  /** The sheet that is asked for, in the language of the page. */
  async function fetchSheet() {
    const { asked, assignment, own } = get();
    if (assignment) {
      const { seed } = asked;
      const answer = await api.post("/assignments", { assignment, ...(seed ? { seed } : {}), lang: lang() });
      return sheetOfAssignment(assignment, seed, answer);
    }
    const reference = referenceOf(own ?? (asked.place.scene || FIRST_SCENE), asked.seed);
    return sheetOfScene(reference, await api.post("/tasks", { ...reference, lang: lang() }));
  }

  async function load() {
    const wanted = get().asked;
    await attempt(store, get().sheet ? "trouble" : "failure", "", async () => {
      const sheet = await fetchSheet();
      if (!isSame(get().asked, wanted)) return;
      set({ sheet });
      const { entries } = sheet;
      show(entries.find(({ key }) => key === get().entry?.key) ?? entries.find(({ id }) => id === get().asked.task) ?? entries[0] ?? null);
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

  async function solve() {
    const { entry } = get();
    if (!entry) return;
    await attempt(store, "trouble", "solving", async () => {
      const { seed: _, ...reference } = entry.reference;
      const { chapter, steps } = entry.task.solution;
      const [answer, derivation] = await Promise.all([
        api.post("/tasks/solution", { ...entry.reference, task: entry.task.id, lang: lang() }),
        api.derive({ ...reference, lang: lang() }).catch(() => null),
      ]);
      const chapters = derivation?.chapters ?? [];
      const shown = steps.map((id) => chapters.flatMap((one) => one.steps).find((one) => one.id === id)).find(Boolean);
      const step = shown ?? chapters.find(({ id }) => id === chapter)?.steps.at(-1) ?? null;
      if (get().entry?.key !== entry.key) return;
      set({ solution: { latex: answer.latex, step } });
      answering.keep(entry, (draft) => ({ shown: draft.shown || !draft.solved }));
    });
  }

  return {
    load,
    solve,
    show,
    ...comparison,
    /** @param {Asked} asked @param {Assignment | null} assignment @param {import("../own.js").SceneDocument | null} own  a scene that the address brings along */
    async start(asked, assignment, own) {
      set({ asked, assignment, own });
      const listed = api.scenes().then(({ scenes }) => set({ scenes })).catch(() => {});
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
    /** @param {Asked["side"]} side */
    turn: (side) => ask({ side }),
    /** @param {import("./progress.js").Line[]} lines */
    write(lines) {
      set({ lines, kept: progress.write(workingKey(), lines) });
    },
  };
}

/** @typedef {ReturnType<typeof createExercise>} Exercise */
