/** Predict, then reveal: the result of a step is hidden until the hall has thought, or has chosen among wrong ones. */

import { html, nothing } from "lit-html";
import { inline, prose } from "../formula.js";
import { icon } from "../icons.js";
import { sizeOf } from "../../model/measure.js";

/** @typedef {import("../../model/types.js").Answered<"/tasks/poll">["choices"]} Choices */
/** @typedef {(step: string) => Promise<{choices: Choices}>} Poll  what a hall may be asked about a step */

/** @param {{changed: () => void, poll?: Poll, shown: () => string, subject: () => string}} page  shown: the step that is shown; subject: of which scene, and in which language */
export function createAsking({ changed, poll, shown, subject }) {
  let on = false;
  /** The steps whose results have been revealed. @type {Set<string>} */
  const revealed = new Set();
  /** @type {Map<string, Choices>} */
  const polls = new Map();
  /** What was chosen, by step. @type {Map<string, number>} */
  const chosen = new Map();
  const key = () => `${subject()} ${shown()}`;

  /** Where nobody answers, the result is only hidden. */
  async function ask() {
    const asked = key();
    if (!poll || polls.has(asked)) return;
    polls.set(asked, []);
    const found = await poll(shown()).catch(() => null);
    polls.set(asked, found?.choices ?? []);
    if (!found) polls.delete(asked);
    changed();
  }

  const veiled = () => on && !revealed.has(key());
  return {
    get on() {
      return on;
    },
    veiled,
    toggle() {
      on = !on;
      revealed.clear();
      chosen.clear();
      changed();
    },
    /** Whether there was something to reveal. */
    reveal() {
      if (!veiled()) return false;
      revealed.add(key());
      changed();
      return true;
    },
    /** Which are right is seen at once; the way to it when the result is revealed. @param {number} index */
    choose(index) {
      if (!veiled() || chosen.has(key()) || !polls.get(key())?.[index]) return;
      chosen.set(key(), index);
      changed();
    },
    /** The choices of the step that is shown; asked for when it is. */
    choices() {
      if (!veiled()) return [];
      void ask();
      return polls.get(key()) ?? [];
    },
    chosen: () => chosen.get(key()),
  };
}

/** @typedef {ReturnType<typeof createAsking>} Asking */

/** In place of a result: what it might be, and after a choice what the wrong ones forget. @param {Asking} asking @param {import("../../model/catalog.js").Translate} t @param {(latex: string) => string} short  bodies by numbers */
export function question(asking, t, short) {
  if (!asking.veiled()) return nothing;
  const choices = asking.choices();
  const open = asking.chosen() === undefined;
  const words = !choices.length ? "lecture.veiled" : open ? "lecture.choose" : "lecture.answered";
  return html`
    <section class="question" aria-label=${t("lecture.ask")}>
      <p class="veil" role="status"><span aria-hidden="true">?</span> ${t(words)}</p>
      ${choices.length ? html`<ol class="choices">${choices.map((choice, i) => html`<li>${one({ ...choice, latex: short(choice.latex) }, i, open, asking, t)}</li>`)}</ol>` : nothing}
    </section>`;
}

/** @param {Choices[number]} choice @param {number} index @param {boolean} open  nothing has been chosen @param {Asking} asking @param {import("../../model/catalog.js").Translate} t */
function one({ latex, right, title, hint }, index, open, asking, t) {
  const wide = `--wide:${Math.max(6, sizeOf(latex).width).toFixed(1)}`;
  const state = open ? "" : right ? "right" : "wrong";
  return html`
    <button class="choice-of-hall ${state}" style=${wide} ?disabled=${!open} aria-pressed=${String(asking.chosen() === index)} @click=${() => asking.choose(index)}>
      <span class="letter">${index + 1}</span>${inline(`\\displaystyle ${latex}`)}
      ${open ? nothing : html`<span class="mark">${icon(right ? "verified" : "close")}<span class="unseen">${t(right ? "lecture.right" : "lecture.wrong")}</span></span>`}
    </button>
    ${open || right ? nothing : html`<p class="hint"><b>${prose(title)}.</b> ${prose(hint)}</p>`}`;
}
