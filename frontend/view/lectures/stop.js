/** A stop in the outline: its title, where it is, and below, when unfolded, notes, what is hidden, and a poll. */

import { html, nothing } from "lit-html";
import { live } from "lit-html/directives/live.js";
import { prose } from "../formula.js";
import { icon } from "../icons.js";
import { MOST } from "../../model/lectures/lecture.js";
import { emptyPoll, fewerChoices, moreChoices, withChoice } from "../../model/lectures/outline.js";
import { drag } from "./dragging.js";

/** @typedef {import("../../model/lectures/lecture.js").Stop} Stop */
/** @typedef {import("../../model/lectures/lecture.js").Poll} Poll */
/** @typedef {import("./page.js").OutlineView} View */

const LETTERS = "ABCD";
const LONG = 46;

/** @param {Event} event */
const valueOf = (event) => /** @type {HTMLInputElement | HTMLTextAreaElement} */ (event.target).value;

/** An address as one reads it. @param {string} place */
function shortened(place) {
  const text = decodeURIComponent(place.replace(/%(?![0-9a-f]{2})/gi, "%25").split("#")[0]).replace("?", " · ");
  return text.length > LONG ? `${text.slice(0, LONG)}…` : text;
}

/** Alt with an arrow moves the stop, wherever in its line the focus is. @param {number} index @param {View} view */
const byKeys =
  (index, { acts }) =>
  (/** @type {KeyboardEvent} */ event) => {
    const by = event.altKey ? { ArrowUp: -1, ArrowDown: 1 }[event.key] : 0;
    if (!by) return;
    event.preventDefault();
    acts.move(index, index + by, /** @type {Element} */ (event.target).getAttribute("data-at") ?? "title");
  };

/** @param {Stop} stop @param {number} index @param {View} view */
export function stopEntry(stop, index, view) {
  const { lecture, keys, open, acts, t } = view;
  const number = index + 1;
  const unfolded = open === keys[index];
  const tool = (
    /** @type {Parameters<typeof icon>[0]} */ name,
    /** @type {string} */ at,
    /** @type {() => void} */ press,
    disabled = false,
  ) => {
    const label = t(`lectures.stop-${at}`, { number });
    return html`<button class="tool" data-at=${at} title=${label} aria-label=${label} ?disabled=${disabled} @click=${press}>${icon(name)}</button>`;
  };
  return html`
    <li class="stop" data-stop=${keys[index]} ?data-open=${unfolded} @keydown=${byKeys(index, view)} @pointerdown=${(/** @type {PointerEvent} */ e) => drag(e, (to) => acts.move(index, to))}>
      <div class="line">
        <span class="grip" aria-hidden="true" title=${t("lectures.grip")}>${number}</span>
        <input class="stop-title" data-at="title" maxlength=${MOST.stop} aria-label=${t("lectures.stop-title", { number })} .value=${live(stop.title)}
          @input=${(/** @type {Event} */ e) => acts.patch(index, { title: valueOf(e) }, `title-${keys[index]}`)}>
        <span class="marks">${stop.notes ? mark("pen", t("lectures.has-notes")) : nothing}${stop.hide ? mark("black", t("lectures.hidden")) : nothing}${stop.poll ? mark("help", t("lectures.has-poll")) : nothing}</span>
        <span class="moves">
          ${tool("up", "up", () => acts.move(index, index - 1, "up"), index === 0)}
          ${tool("chevron", "down", () => acts.move(index, index + 1, "down"), number === lecture.stops.length)}
          <button class="quiet small" data-at="more" aria-expanded=${String(unfolded)} aria-label=${t("lectures.stop-more", { number })} @click=${() => acts.unfold(keys[index])}>${t("lectures.stop-more-short")}</button>
          ${tool("close", "remove", () => acts.remove(index))}
        </span>
      </div>
      <p class="where"><a href=${`/${stop.place}`} target="_blank" rel="noopener">${shortened(stop.place)}</a>${stop.title.includes("$") ? html` <span class="as-seen">${prose(stop.title)}</span>` : nothing}</p>
      ${unfolded ? details(stop, index, view) : nothing}
    </li>`;
}

/** @param {Parameters<typeof icon>[0]} name @param {string} label */
const mark = (name, label) =>
  html`<span class="mark" role="img" aria-label=${label} title=${label}>${icon(name)}</span>`;

/** @param {Stop} stop @param {number} index @param {View} view */
function details({ notes = "", hide = false, poll }, index, { keys, acts, t }) {
  const what = (/** @type {string} */ part) => `${part}-${keys[index]}`;
  return html`
    <div class="stop-more">
      <label>${t("lectures.notes")}<textarea rows="4" maxlength=${MOST.notes} .value=${live(notes)} @input=${(/** @type {Event} */ e) => acts.patch(index, { notes: valueOf(e) }, what("notes"))}></textarea></label>
      <label class="check"><input type="checkbox" .checked=${live(hide)} @change=${() => acts.patch(index, { hide: !hide })}><span>${t("lectures.hide")}</span></label>
      <label class="check"><input type="checkbox" .checked=${live(Boolean(poll))} @change=${() => acts.patch(index, { poll: poll ? undefined : emptyPoll() })}><span>${t("lectures.poll")}</span></label>
      ${poll ? pollEditor(poll, (changed, part) => acts.patch(index, { poll: changed }, part && what(part)), what(""), t) : nothing}
    </div>`;
}

/** @param {Poll} poll @param {(poll: Poll, part?: string) => void} change @param {string} name @param {View["t"]} t */
function pollEditor(poll, change, name, t) {
  const full = poll.choices.length >= MOST.choices;
  return html`
    <fieldset class="poll-editor"><legend>${t("lectures.poll-legend")}</legend>
      <label>${t("lectures.question")}<input maxlength=${MOST.question} .value=${live(poll.question)} @input=${(/** @type {Event} */ e) => change({ ...poll, question: valueOf(e) }, "question")}></label>
      ${poll.question.includes("$") ? html`<p class="as-seen">${prose(poll.question)}</p>` : nothing}
      <ol>${poll.choices.map(
        (choice, i) => html`
        <li><label class="check" title=${t("lectures.right")}><input type="radio" name=${`right${name}`} aria-label=${t("lectures.right-of", { letter: LETTERS[i] })} .checked=${live(poll.right === i + 1)} @change=${() => change({ ...poll, right: i + 1 })}>${LETTERS[i]}</label>
          <input maxlength=${MOST.choice} aria-label=${t("lectures.choice", { letter: LETTERS[i] })} .value=${live(choice)} @input=${(/** @type {Event} */ e) => change(withChoice(poll, i, valueOf(e)), `choice-${i}`)}>
          <span class="as-seen">${choice.includes("$") ? prose(choice) : nothing}</span>
          <button type="button" class="tool" ?disabled=${poll.choices.length <= 2} title=${t("lectures.less", { letter: LETTERS[i] })} aria-label=${t("lectures.less", { letter: LETTERS[i] })} @click=${() => change(fewerChoices(poll, i))}>${icon("close")}</button></li>`,
      )}</ol>
      <button type="button" class="quiet small" ?disabled=${full} @click=${() => change(moreChoices(poll))}>${icon("add")}${t("lectures.more")}</button>
      <p class="hint">${t("lectures.poll-hint")}</p>
    </fieldset>`;
}
