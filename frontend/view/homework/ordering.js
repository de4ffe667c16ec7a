/** Steps of a derivation to be put in order: by dragging, with Alt and the arrows, or with the buttons of each. */

import { html, nothing } from "lit-html";
import { repeat } from "lit-html/directives/repeat.js";
import { isCurrent, valueOf } from "../../model/homework/answering.js";
import { arranged, placed, stepFrom, textOf } from "../../model/homework/ordering.js";
import { displayed, prose } from "../formula.js";
import { icon } from "../icons.js";
import { drag } from "./dragging.js";

/** @typedef {import("./page.js").HomeworkView} HomeworkView */
/** @typedef {import("../../model/homework/sheet.js").Entry} Entry */
/** @typedef {import("../../model/homework/ordering.js").Arrangement} Arrangement */
/** @typedef {import("../../model/homework/ordering.js").Block} Block */
/** @typedef {{arrangement: Arrangement, wrong: string, needed: string, go: (block: Block, place: number | null | undefined, from: Element) => void}} Desk  `from` has the focus */

const ARROWS = /** @type {Record<string, -1 | 1>} */ ({ ArrowUp: -1, ArrowDown: 1 });

/** @param {HomeworkView} view @param {Entry} entry */
export function ordering(view, entry) {
  const { t } = view;
  const desk = deskOf(view, entry);
  const { used, left } = desk.arrangement;
  return html`<div class="ordering" data-outcome=${outcomeOf(view, entry)}>
    <div class="answer-head"><h3>${t("homework.answer")}</h3></div>
    <p class="so" id="moving-help">${t("homework.block-help")}</p>
    <ol class="blocks" aria-label=${t("homework.blocks-used")} aria-describedby="moving-help">${repeat(
      used,
      ({ id }) => id,
      (block, place) => movable(view, desk, block, place),
    )}</ol>
    <h4>${t("homework.blocks-left")}</h4>
    <ol class="blocks left" aria-label=${t("homework.blocks-left")}>
      ${repeat(
        left,
        ({ id }) => id,
        (block) => movable(view, desk, block, null),
      )}
      ${left.length ? nothing : html`<li class="so none">${t("homework.blocks-left-none")}</li>`}
    </ol>
  </div>`;
}

/** @param {HomeworkView} view @param {Entry} entry */
const verdictOn = ({ state }, entry) => (isCurrent(entry, state.draft) ? state.draft.checked?.verdict : undefined);

/** @param {HomeworkView} view @param {Entry} entry */
const outcomeOf = (view, entry) => verdictOn(view, entry)?.outcome ?? nothing;

/** @param {HomeworkView} view @param {Entry} entry @returns {Desk} */
function deskOf(view, entry) {
  const { state, answering, t } = view;
  const arrangement = arranged(entry.task.blocks ?? [], valueOf(entry, state.draft));
  const [wrong = "", needed = ""] = verdictOn(view, entry)?.blocks ?? [];
  return {
    arrangement,
    wrong,
    needed,
    go(block, place, from) {
      if (place === undefined) return;
      const next = placed(arrangement, block.id, place);
      answering.type(0, textOf(next));
      const root = from.closest(".ordering");
      const button = from.closest("[data-move]")?.getAttribute("data-move") ?? "";
      // After the page is drawn anew, which is due first, and before the next key could come.
      queueMicrotask(() => focus(root, block.id, button));
      announce(told(next, block, t));
    },
  };
}

/** The same button of the block, or the block itself, wherever it is by now. @param {Element | null} root @param {string} id @param {string} button */
function focus(root, id, button) {
  const block = root?.querySelector(`[data-block="${id}"]`);
  const found = (button && block?.querySelector(`[data-move="${button}"]`)) || block;
  if (found instanceof HTMLElement) found.focus({ preventScroll: true });
  block?.scrollIntoView({ block: "nearest" });
}

/** @param {string} words */
function announce(words) {
  const region = document.getElementById("announcer");
  if (region) region.textContent = words;
}

/** What a block is called aloud. @param {Block} block */
const saidOf = ({ id, announced }) => `${id}: ${announced}`;

/** Where a block is now. @param {Arrangement} arrangement @param {Block} block @param {HomeworkView["t"]} t */
function told({ used }, block, t) {
  const place = used.findIndex(({ id }) => id === block.id);
  const title = saidOf(block);
  return place < 0
    ? t("homework.block-left", { title })
    : t("homework.block-placed", { title, number: place + 1, count: used.length });
}

/** @param {HomeworkView} view @param {Desk} desk @param {Block} block @param {number | null} place */
function movable({ t }, desk, block, place) {
  const { arrangement, go, wrong, needed } = desk;
  const press = (/** @type {KeyboardEvent} */ event) => {
    const by = ARROWS[event.key];
    if (!by || !event.altKey || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    go(block, stepFrom(arrangement, block.id, by), /** @type {Element} */ (event.target));
  };
  const take = (/** @type {PointerEvent} */ event) => {
    const item = /** @type {Element} */ (event.currentTarget);
    drag(event, (to) => go(block, to, item));
  };
  return html`<li class="block" data-block=${block.id} tabindex="-1" data-mark=${block.id === wrong ? "wrong" : block.id === needed ? "needed" : nothing} @keydown=${press} @pointerdown=${take}>
    <span class="grip" aria-hidden="true"></span>
    ${content(block, place)}
    <div class="block-moves">${/** @type {const} */ ([-1, 1]).map((by) => mover(t, desk, block, by))}</div>
    ${block.id === wrong ? html`<p class="wrong">${icon("close")}<span>${t("homework.block-wrong")}</span></p>` : nothing}
  </li>`;
}

/** Place, title and formulas. @param {Block} block @param {number | null} place */
const content = (
  block,
  place,
) => html`<p class="block-title">${place === null ? nothing : html`<span class="place">${place + 1}</span>`}<span>${prose(block.title)}</span> <span class="letter">${block.id}</span></p>
    <div class="says">${displayed(block.marked, false, { spoken: block.spoken })}</div>`;

/** A button keeps the focus where it leads nowhere, so it is never disabled. @param {HomeworkView["t"]} t @param {Desk} desk @param {Block} block @param {-1 | 1} by */
function mover(t, { arrangement, go }, block, by) {
  const to = stepFrom(arrangement, block.id, by);
  const label = t(by < 0 ? "homework.block-up" : "homework.block-down", { title: saidOf(block) });
  const press = (/** @type {Event} */ event) => go(block, to, /** @type {Element} */ (event.currentTarget));
  return html`<button type="button" class="tool" data-move=${by < 0 ? "up" : "down"} aria-disabled=${String(to === undefined)} aria-label=${label} @click=${press}>${icon(by < 0 ? "up" : "chevron")}</button>`;
}

/** The blocks in the right order, to be read. @param {Entry} entry @param {readonly string[]} letters */
export const inOrder = ({ task }, letters) =>
  html`<ol class="blocks read">${arranged(task.blocks ?? [], letters.join(";")).used.map(
    (block, place) => html`<li class="block">${content(block, place)}</li>`,
  )}</ol>`;
