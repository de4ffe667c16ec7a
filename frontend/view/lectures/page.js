/** The page of own lectures: what they are, the outline of the one at hand, and where else one comes from. */

import { html, nothing } from "lit-html";
import { live } from "lit-html/directives/live.js";
import { repeat } from "lit-html/directives/repeat.js";
import { icon } from "../icons.js";
import { titled, top } from "../top.js";
import { COURSE } from "../../model/start/course.js";
import { pageAddress } from "../../model/url.js";
import { MOST } from "../../model/lectures/lecture.js";
import { stopEntry } from "./stop.js";

/** @typedef {import("../../model/lectures/lecture.js").Lecture} Lecture */
/** @typedef {import("../../model/lectures/lecture.js").Problem} Problem */
/** @typedef {import("../../model/lectures/lecture.js").Stop} Stop */
/** @typedef {{key: string, parameters?: Record<string, string | number>}} Notice */
/**
 * @typedef {import("../header.js").Appearance & {lecture: Lecture, keys: number[], open: number, undoable: boolean, earlier: Lecture[], problems: Problem[],
 *   notice: Notice | null, kept: boolean, printing: boolean, acts: Acts}} OutlineView  keys: one for each stop, that stays with it; open: the key of the one whose notes are open
 */
/**
 * @typedef {object} Acts
 * @property {(index?: number) => void} start
 * @property {(title: string) => void} rename
 * @property {(index: number, patch: Partial<Stop>, what?: string) => void} patch
 * @property {(from: number, to: number, focus?: string) => void} move
 * @property {(index: number) => void} remove
 * @property {(key: number) => void} unfold
 * @property {() => void} undo
 * @property {(address: string) => boolean} add
 * @property {(part: string, entry: string) => void} addFromCourse
 * @property {() => void} save
 * @property {(file: File | undefined) => Promise<void>} load
 * @property {() => Promise<void>} link
 * @property {() => void} print
 * @property {() => void} anew
 * @property {(index: number) => void} restore
 * @property {() => Promise<void>} openShipped
 */

/** @param {OutlineView} view */
export function page(view) {
  const { t, acts } = view;
  const over = (/** @type {DragEvent} */ event) =>
    event.dataTransfer?.types.includes("Files") && event.preventDefault();
  const drop = (/** @type {DragEvent} */ event) => {
    const [file] = event.dataTransfer?.files ?? [];
    if (!file) return;
    event.preventDefault();
    void acts.load(file);
  };
  return html`
    ${top(view, { main: "outline", skip: t("lectures.skip"), here: "lecture", heading: titled(t("place.lecture"), t("lectures.subtitle")) })}
    <main class="own-lecture" @dragover=${over} @drop=${drop}>
      <section id="outline" aria-label=${t("lectures.outline")}>
        ${heading(view)} ${said(view)} ${stops(view)} ${adding(view)}
      </section>
      <aside>${sources(view)}</aside>
    </main>`;
}

/** @param {OutlineView} view */
function heading({ lecture, undoable, acts, t }) {
  return html`
    <label class="lecture-title"><span>${t("lectures.title")}</span>
      <input maxlength=${MOST.title} .value=${live(lecture.title)} placeholder=${t("lectures.title-hint")} @input=${(/** @type {Event} */ e) => acts.rename(valueOf(e))}></label>
    <p class="deeds">
      <button class="main" ?disabled=${!lecture.stops.length} @click=${() => acts.start()}>${icon("lecture")}${t("lectures.start")}</button>
      <button class="quiet" ?disabled=${!undoable} @click=${acts.undo}>${icon("again")}${t("lectures.undo")}</button>
      <button class="quiet" ?disabled=${!lecture.stops.length} @click=${acts.save}>${icon("file")}${t("lectures.save")}</button>
      <button class="quiet" ?disabled=${!lecture.stops.length} @click=${acts.link}>${icon("share")}${t("lectures.link")}</button>
      <button class="quiet" ?disabled=${!lecture.stops.length} @click=${acts.print}>${icon("print")}${t("lectures.print")}</button>
    </p>`;
}

/** What has happened, and what is wrong with a file. @param {OutlineView} view */
function said({ notice, problems, kept, t }) {
  return html`
    <p class="said" role="status">${notice ? t(notice.key, notice.parameters) : nothing}</p>
    ${kept ? nothing : html`<p class="warning" role="alert">${t("lectures.not-kept")}</p>`}
    ${
      problems.length
        ? html`<div class="failure" role="alert"><h2>${t("lectures.refused")}</h2>
          <ul>${problems.slice(0, 8).map(({ pointer, code, ...more }) => html`<li><code>${pointer || "/"}</code> ${t(`lectures.problem.${code}`, more)}</li>`)}</ul></div>`
        : nothing
    }`;
}

/** @param {OutlineView} view */
function stops(view) {
  const { lecture, keys, t } = view;
  if (!lecture.stops.length) return html`<p class="empty">${t("lectures.empty")}</p>`;
  return html`
    <p class="unseen" id="moving-stops">${t("lectures.moving")}</p>
    <ol class="stops" aria-label=${t("lectures.stops")} aria-describedby="moving-stops">${repeat(
      lecture.stops,
      (_, i) => keys[i],
      (stop, i) => stopEntry(stop, i, view),
    )}</ol>`;
}

/** By its address, or from the course. @param {OutlineView} view */
function adding({ acts, t }) {
  const add = (/** @type {Event} */ event) => {
    event.preventDefault();
    const form = /** @type {HTMLFormElement} */ (event.target);
    if (acts.add(String(new FormData(form).get("address") ?? ""))) form.reset();
  };
  return html`
    <form class="by-address" @submit=${add}>
      <label>${t("lectures.address")}<input name="address" required autocomplete="off" placeholder=${t("lectures.address-hint")}></label>
      <button class="quiet">${icon("add")}${t("lectures.add")}</button>
    </form>`;
}

/** @param {OutlineView} view */
function sources({ state, earlier, acts, t }) {
  const pages = ["scene", "proof", "variations", "labs", "homework"];
  return html`
    <section><h2>${t("lectures.how")}</h2>
      <p>${t("lectures.how-text")}</p>
      <ul class="ways-in">${pages.map((name) => html`<li><a href=${pageAddress(name, state.place)}>${t(`place.${name}`)}</a></li>`)}</ul></section>
    <section><h2>${t("lectures.shipped")}</h2><p>${t("lectures.shipped-text")}</p>
      <button class="quiet framed" @click=${acts.openShipped}>${t("lectures.open-shipped")}</button></section>
    <section><h2>${t("lectures.course")}</h2>
      ${COURSE.map(
        ({ id, entries }) => html`
        <details><summary>${t(`course.${id}`)}</summary>
          <ul>${entries.map((entry) => html`<li><button class="quiet small" @click=${() => acts.addFromCourse(id, entry.id)}>${icon("add")}<span>${t(`course.${id}.${entry.id}`)}</span></button></li>`)}</ul></details>`,
      )}</section>
    <section><h2>${t("lectures.files")}</h2>
      <p>${t("lectures.files-text")}</p>
      <label class="quiet framed file-in">${icon("up")}${t("lectures.open")}<input class="unseen" type="file" accept=".json,application/json" @change=${opening(acts.load)}></label>
      <button class="quiet framed" @click=${acts.anew}>${icon("add")}${t("lectures.anew")}</button>
      ${earlier.length ? html`<h3>${t("lectures.earlier")}</h3><ul>${earlier.map((one, i) => html`<li><button class="quiet small" @click=${() => acts.restore(i)}>${one.title || t("lectures.untitled")} (${one.stops.length})</button></li>`)}</ul>` : nothing}</section>`;
}

/** The same file can be chosen twice. @param {Acts["load"]} load */
const opening = (load) => (/** @type {Event} */ event) => {
  const field = /** @type {HTMLInputElement} */ (event.target);
  void load(field.files?.[0]).then(() => (field.value = ""));
};

/** @param {Event} event */
export const valueOf = (event) => /** @type {HTMLInputElement | HTMLTextAreaElement} */ (event.target).value;
