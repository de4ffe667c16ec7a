/** Practice without end: exercises one after the other, what they were got wrong by, and what the browser remembers. */

import { createStore } from "../store.js";
import { atLevel, blank, dropped, KEY, onward, opened, readMemory, shown, solved, written, wrong } from "./memory.js";

/** @typedef {import("./memory.js").Memory} Memory */
/** @typedef {import("./state.js").State} State */
/** @typedef {{memory: Memory, kept: boolean, risen: boolean, asks: boolean}} Session  `risen` after an exercise that led to the next level, `asks` before everything is forgotten */

/**
 * @param {{keeper: import("../own.js").Keeper, now: () => Date, random: () => number}} around
 */
export function createPractice({ keeper, now, random }) {
  const begun = readMemory(held(), random);
  const store = createStore(/** @type {Session} */ ({ memory: begun, kept: true, risen: false, asks: false }));
  const { get, set } = store;
  /** What was last looked at, so that each verdict is taken once. @type {{key: string, checked: unknown, shown: boolean}} */
  let seen = { key: "", checked: null, shown: false };

  function held() {
    try {
      return keeper.getItem(KEY);
    } catch {
      return null;
    }
  }

  /** @param {Memory} memory @param {Partial<Session>} [rest] */
  function keep(memory, rest = {}) {
    let kept = true;
    try {
      keeper.setItem(KEY, written(memory));
    } catch {
      kept = false;
    }
    set({ memory, kept, ...rest });
  }

  /** @param {import("./sheet.js").Entry} entry @param {import("./progress.js").Draft} draft */
  function judge({ task }, draft) {
    const before = get().memory;
    const { outcome, misconceptions } = draft.checked?.verdict ?? { outcome: "", misconceptions: [] };
    const level = before.open?.drill.level ?? before.level;
    const [named] = outcome === "wrong" ? misconceptions : [];
    const learnt = named ? wrong(before, named.id, task.kind, level, now()) : before;
    const looked = draft.shown ? shown(learnt, now()) : learnt;
    const after = draft.solved ? solved(looked, draft, now()) : looked;
    if (after !== before) keep(after, { risen: after.level > before.level });
  }

  return {
    get,
    subscribe: store.subscribe,
    now,
    /** The exercise to begin with: the one at hand, unless it is done. */
    resumed() {
      const { open } = get().memory;
      return open && !open.done ? open.drill : this.next();
    },
    next() {
      const memory = onward(get().memory, now());
      keep(memory, { risen: false, asks: false });
      return /** @type {import("./memory.js").Open} */ (memory.open).drill;
    },
    /** What is on the page: an exercise that an address brings along, and what came of the answer to it. @param {State} state */
    observe({ asked: { side, drill }, sheet, entry, draft }) {
      if (side !== "practice" || !drill.number || !entry) return;
      const memory = opened(get().memory, drill, draft.solved || draft.shown);
      if (memory !== get().memory) keep(memory);
      if (drill.recall && !sheet?.recalled && memory.open?.drill.recall) keep(dropped(memory));
      const news = entry.key !== seen.key || draft.checked !== seen.checked || draft.shown !== seen.shown;
      seen = { key: entry.key, checked: draft.checked, shown: draft.shown };
      if (news) judge(entry, draft);
    },
    /** @param {number} level */
    choose(level) {
      keep(atLevel(get().memory, level), { risen: false });
      return this.next();
    },
    /** Asks first. */
    forget() {
      if (get().asks) keep(blank(random), { asks: false, risen: false });
      else set({ asks: true });
    },
    spare: () => set({ asks: false }),
  };
}

/** @typedef {ReturnType<typeof createPractice>} Practice */
