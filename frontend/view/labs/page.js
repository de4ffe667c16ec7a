/** The page of the labs: what is measured to the left, charts as they come to the right. */

import { html, nothing } from "lit-html";
import { repeat } from "lit-html/directives/repeat.js";
import { roughly, significant } from "../../model/numbers.js";
import { failure, inScene } from "../failure.js";
import { inLanguage } from "../../model/catalog.js";
import { OWN } from "../../model/own.js";
import { addEntry, addTool, titleOfPlace } from "../lectures/adding.js";
import { titled, top } from "../top.js";
import { bifurcations } from "./bifurcations.js";
import { canvas } from "./cursor.js";
import { form, labelOf } from "./form.js";
import { motion } from "./motion.js";
import { orbits } from "./orbits.js";
import { rungs } from "./rungs.js";
import { failures, slider } from "./stability.js";
import { tolerance } from "./tolerance.js";

/** @typedef {import("../../model/labs/chart.js").Chart} Chart */
/**
 * @typedef {import("../header.js").Appearance & {bench: import("../../model/labs/bench.js").Bench,
 *   benches: import("../../model/labs/bench.js").Benches, scenes: import("../../model/types.js").SceneEntry[],
 *   labs: string[], known: import("../../model/labs/experiments.js").Experiments, t: import("../page.js").View["t"], methodTitle: (id: string) => string, charts: Chart[], dial: Dial, turn: (patch: Partial<Dial>) => void,
 *   save: (chart: Chart, format: "png" | "svg") => void, fetchFile: (accept: string) => void,
 *   play: Play | null, watch: (patch: object) => void, link: (patch: object) => string, open: (scene: import("../../model/own.js").SceneDocument) => void,
 *   editor: () => string, sceneFrom: (initial: import("../../model/values.js").Changes["initial"], parameters?: Record<string, number>) => string,
 *   cursor: Cursor | null, point: (cursor: Cursor) => void, press: (chart: Chart, x: number, y: number, curve?: number) => void}} View
 * @typedef {import("./cursor.js").Cursor} Cursor
 * @typedef {{tolerance: number, step: number}} Dial  where the sliders stand: wanted error, step h in seconds
 * @typedef {{title: string, address: string, status: string}} Play
 */

/** What stands above and below the charts of a lab. @type {Record<string, (view: View) => unknown>} */
const ABOVE = { "work-precision": tolerance, stability: slider };
/** @type {Record<string, (view: View) => unknown>} */
const BELOW = { stability: failures, fidelity: rungs, "poincare-section": orbits, bifurcation: bifurcations };

/** @param {View} view */
export function page(view) {
  const { t, bench } = view;
  const { lab, scene } = bench.question;
  const subject = () => inLanguage(view.scenes.find(({ id }) => id === scene)?.title, view.state.place.lang);
  const title = () => titleOfPlace(t(`labs.experiments.${lab}.title`), subject());
  return html`
    ${top(view, { main: "measured", here: "labs", heading: titled(t("place.labs"), t("labs.lead")), menu: addEntry(title, t), tools: addTool(title, t) })}
    <main class="labs">
      <nav class="kinds" aria-label=${t("labs.choose-lab")}>${view.labs.map((lab) => kind(view, lab))}</nav>
      <div class="asking">${form(view)}</div>
      <div class="measured" id="measured" tabindex="-1" aria-busy=${String(bench.running)}>
        <p class="purpose">${t(`labs.experiments.${bench.question.lab}.summary`)}</p>
        ${progress(view)}
        ${bench.failure ? failure(bench.failure, t(bench.charts.length ? "labs.unfinished" : "labs.failed"), view.benches.start, t, mending(view), placeOf(view)) : nothing}
        ${bench.charts.length ? charts(view) : bench.running || bench.failure ? nothing : invitation(view)}
        ${motion(view)}
      </div>
    </main>`;
}

/** The field of the form that a problem is about, else its place in the scene. @param {View} view */
const placeOf = (view) => (/** @type {string} */ pointer) => {
  const { question } = view.bench;
  const [, member] = pointer.split("/");
  const option = view.known.experiment(question.lab).options.find(({ name, asked }) => {
    return member in asked(/** @type {never} */ (question[name]));
  });
  return option ? html`<b>${labelOf(view, option)}:</b>` : inScene(pointer);
};

/** The way into the editor from one's own scene, in which there are problems. @param {View} view */
function mending({ bench, editor, t }) {
  const isOwn =
    bench.question.scene === OWN && bench.failure?.problems.some(({ pointer }) => pointer.startsWith("/scene/"));
  return isOwn ? html`<a class="main" href=${editor()}>${t("editor.open")}</a>` : nothing;
}

/** Where the labs do not all fit beside each other, the open one is in sight. @param {Element} root */
export const showOpen = (root) =>
  root.querySelector(".kinds [aria-current]")?.scrollIntoView({ block: "nearest", inline: "center" });

/** @param {View} view @param {string} lab */
function kind({ bench, benches, link, t }, lab) {
  const open = (/** @type {MouseEvent} */ event) => {
    if (event.ctrlKey || event.metaKey || event.shiftKey) return;
    event.preventDefault();
    benches.open(lab);
  };
  return html`<a href=${link({ lab })} aria-current=${bench.question.lab === lab ? "page" : nothing} @click=${open}>${t(`labs.experiments.${lab}.title`)}</a>`;
}

/** @param {View} view */
function progress({ bench, t }) {
  if (!bench.running && !bench.stopped) return nothing;
  const percent = Math.round(100 * bench.progress);
  return html`<div class="progress" role="status">
    <progress max="100" value=${percent} aria-label=${t("labs.progress")}></progress>
    <span>${bench.running ? underWay(bench, percent, t) : t("labs.stopped", { percent })}</span></div>`;
}

/** @param {View["bench"]} bench @param {number} percent @param {View["t"]} t */
function underWay({ waiting, progress }, percent, t) {
  if (waiting && "kernels" in waiting)
    return t("labs.preparing", { kernels: String(waiting.kernels), of: String(waiting.of) });
  if (waiting?.place) return t("labs.queued", { place: String(waiting.place), time: roughly(waiting.seconds) });
  return progress || waiting ? t("labs.measuring", { percent }) : t("labs.waiting");
}

/** @param {View} view */
function invitation({ benches, bench, t }) {
  return html`<div class="invitation"><p>${t("labs.invitation")}</p>
    <button class="main" ?disabled=${!bench.scene} @click=${benches.start}>${t("labs.start")}</button></div>`;
}

/** @param {View} view */
function charts(view) {
  const { bench, t, fetchFile } = view;
  const { lab } = bench.question;
  return html`
    ${taken(view)}
    ${bench.result ? (ABOVE[lab]?.(view) ?? nothing) : nothing}
    ${repeat(
      view.charts,
      (chart) => chart.id,
      (chart) => figure(view, chart),
    )}
    ${bench.result ? (BELOW[lab]?.(view) ?? nothing) : nothing}
    ${
      bench.result
        ? html`<p class="files">${t("labs.all")}
      <button class="quiet small" @click=${() => fetchFile("text/csv")}>CSV</button>
      <button class="quiet small" @click=${() => fetchFile("text/html")}>HTML</button></p>`
        : nothing
    }`;
}

/** Of each processor: beyond it another program had to wait now and then. */
const BUSY = 0.7;

/** When the times were measured and how busy the machine was; and to measure them again. @param {View} view */
function taken({ bench, benches, t, state }) {
  const found = bench.result?.taken;
  if (!found) return nothing;
  const { lang } = state.place;
  const date = new Intl.DateTimeFormat(lang, { dateStyle: "medium", timeStyle: "short" }).format(new Date(found.date));
  const told = {
    date,
    load: found.load === null ? "–" : significant(found.load, 2, lang),
    repetitions: String(found.repetitions),
    processors: String(found.processors),
  };
  return html`<p class="note taken"><time datetime=${found.date}>${t(found.repetitions > 1 ? "labs.taken" : "labs.taken-once", told)}</time>
    ${(found.load ?? 0) > BUSY ? t("labs.busy") : nothing}
    <button class="quiet small" ?disabled=${bench.running} @click=${benches.start}>${t("labs.again")}</button></p>`;
}

/** @param {View} view @param {Chart} chart */
function figure(view, chart) {
  const { save, t } = view;
  return html`
    <figure data-chart=${chart.id} aria-labelledby=${`${chart.id}-title`}>
      <h2 id=${`${chart.id}-title`}>${chart.title}
        <span class="files"><button class="quiet small" title=${t("labs.save", { format: "PNG" })} @click=${() => save(chart, "png")}>PNG</button>
        <button class="quiet small" title=${t("labs.save", { format: "SVG" })} @click=${() => save(chart, "svg")}>SVG</button></span></h2>
      ${canvas(view, chart)}
      <figcaption>${chart.caption}</figcaption>
    </figure>`;
}
