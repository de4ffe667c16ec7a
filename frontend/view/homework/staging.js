/** The motions on the stage, moved by the clock; and a new verdict, brought before the eyes of who asked for it. */

import { framed } from "../../model/homework/motions.js";
import { endOf } from "../../model/trajectory.js";
import { createDrawing } from "../drawing.js";
import { createTransport } from "../player.js";

/** @typedef {import("../../model/homework/state.js").State} State */

/** @param {HTMLElement} root @param {import("../../model/clock.js").Clock} clock */
export function createStaging(root, clock) {
  /** @type {{right: ReturnType<typeof createDrawing>, yours: ReturnType<typeof createDrawing>, transport: ReturnType<typeof createTransport>} | null} */
  let parts = null;
  /** @type {{entry: unknown, right: State["right"], answered: State["answered"], scene: import("../../model/types.js").Scene | null}} */
  let staged = { entry: null, right: null, answered: null, scene: null };
  let lang = "en";

  function assemble() {
    const find = (/** @type {string} */ selector) => /** @type {HTMLElement} */ (root.querySelector(selector));
    const [right, yours] = [createDrawing(find(".drawing.right")), createDrawing(find(".drawing.yours"))];
    new ResizeObserver(() => [right, yours].forEach((drawing) => drawing.resize(clock.time))).observe(find(".stage"));
    return { right, yours, transport: createTransport(find(".player")) };
  }

  /** @param {number} t */
  function move(t) {
    parts?.right.draw(t);
    if (staged.answered) parts?.yours.draw(t);
    parts?.transport.move(t, clock, lang);
  }

  /** What is on the stage has changed: both motions get one frame, and that of the answer begins by itself. @param {State} state @param {boolean} still */
  function set({ entry, right, answered }, still) {
    const scene = entry?.scene ?? null;
    const begins = answered !== null && answered !== staged.answered;
    const renewed = right !== staged.right;
    staged = { entry, right, answered, scene: scene && right && answered ? framed(scene, [right, answered]) : scene };
    if (renewed) clock.setEnd(endOf(right));
    if (!begins) return;
    clock.seek(0);
    if (!still) clock.play(true);
    root.querySelector(".stage")?.scrollIntoView({ block: "nearest", behavior: still ? "instant" : "smooth" });
  }

  return {
    move,
    /** @param {State} state @param {boolean} still  whether motion is not wanted */
    show(state, still) {
      parts ??= assemble();
      lang = state.asked.place.lang;
      if (staged.entry !== state.entry || staged.right !== state.right || staged.answered !== state.answered)
        set(state, still);
      parts.right.show(staged.scene, state.right, clock.time);
      parts.yours.show(staged.scene, state.answered, clock.time);
      move(clock.time);
    },
  };
}

/** Another task begins at its beginning, and is seen in the list. @param {HTMLElement} root */
function toTop(root) {
  const list = root.querySelector(".tasks");
  const current = /** @type {HTMLElement | null} */ (list?.querySelector("[aria-current]"));
  root.querySelectorAll(".homework, .work").forEach((room) => (room.scrollTop = 0));
  if (!list || !current) return;
  list.scrollLeft = current.offsetLeft - (list.clientWidth - current.offsetWidth) / 2;
  list.scrollTop = current.offsetTop - (list.clientHeight - current.offsetHeight) / 2;
}

/** @param {HTMLElement} root */
export function createReach(root) {
  /** @type {{key: string | undefined, checked: State["draft"]["checked"]}} */
  let seen = { key: undefined, checked: null };
  return (/** @type {State} */ { entry, draft: { checked } }, /** @type {boolean} */ still) => {
    const judged = checked !== seen.checked && entry?.key === seen.key;
    if (entry?.key !== seen.key) toTop(root);
    seen = { key: entry?.key, checked };
    if (judged)
      root.querySelector(".verdict-card")?.scrollIntoView({ block: "nearest", behavior: still ? "instant" : "smooth" });
  };
}
