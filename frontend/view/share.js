/** Sharing: the address, a code for phones, a frame for other pages, files to take away. */

import { generate } from "lean-qr";
import { html, nothing, svg } from "lit-html";
import { offer, toClipboard } from "./files.js";
import { dialog } from "./overlays.js";
import { icon } from "./icons.js";
import { inLanguage } from "../model/catalog.js";
import { FORMS, frameAddress, pathOf, proofFrameAddress, SHOWN, snippet } from "../model/share.js";
import { HOME, writePlace } from "../model/url.js";

/** @typedef {import("./page.js").View} View */
/** Empty modules around a code, so that phones find it. */
const QUIET = 4;
/** More does not fit a code that a phone reads from a wall. */
const LONGEST = 1200;

/** @typedef {(form: typeof FORMS[number]) => Promise<import("../model/share.js").File | null>} Take */

/** @typedef {import("./overlays.js").View & {link: (patch: Partial<import("../model/types.js").Place>) => string}} Shared  a page with an address */

/** The address of what is shown, with its code, and what else there is to take away. @param {Shared} view @param {unknown} more */
function sharing(view, more) {
  const { link, t } = view;
  const address = location.origin + link({});
  return dialog(
    "share",
    html`
    <div class="sharing">
      <section><h3>${t("share.link")}</h3>${copied(address, t("share.link"), t)}</section>
      <section class="code">${address.length > LONGEST ? html`<p>${t("share.code-too-long")}</p>` : code(address, t)}</section>
      ${more}
    </div>`,
    view,
  );
}

/** A proof has an address, a frame and a handout. @param {Shared} view @param {string} proof */
export function shareProof(view, proof) {
  const { state, t } = view;
  const { lang, theme } = state.place;
  const query = writePlace({ ...HOME, lang, theme });
  const frame = snippet(proofFrameAddress(location.origin, state.place), "derivation", t("place.proof"));
  return sharing(
    view,
    html`
      ${framing(copied(frame, t("share.frame"), t), t)}
      <section><h3>${t("share.files")}</h3>
        <ul class="files"><li>${handoutLink(`/handout${query}${query ? "&" : "?"}proof=${proof}`, t)}</li></ul></section>`,
  );
}

/** Lines of HTML for other pages. @param {unknown} lines @param {View["t"]} t */
const framing = (lines, t) =>
  html`<section><h3>${t("share.frame")}</h3><p>${t("share.frame-help")}</p>${lines}</section>`;

/** @param {View} view @param {Take} take */
export function share(view, take) {
  const { state, t } = view;
  const title = inLanguage(state.scene?.title, state.place.lang);
  const line = (/** @type {typeof SHOWN[number]} */ shown) =>
    snippet(frameAddress(location.origin, state.place, shown, fragment(state)), shown, title);
  const named = (/** @type {typeof SHOWN[number]} */ shown) => t(`share.show-${shown || "both"}`);
  return sharing(
    view,
    html`
      ${framing(
        SHOWN.map((shown) => html`<p class="kind">${named(shown)}</p>${copied(line(shown), named(shown), t)}`),
        t,
      )}
      <section><h3>${t("share.files")}</h3>${files(view, take)}</section>`,
  );
}

/** @param {View["state"]} state */
const fragment = ({ place, fragment }) => (place.scene === "own" ? fragment : "");

/** @param {string} text @param {string} label @param {View["t"]} t */
function copied(text, label, t) {
  const copy = async (/** @type {Event} */ { currentTarget }) => {
    const button = /** @type {HTMLElement} */ (currentTarget);
    const done = await toClipboard(text);
    const field = /** @type {HTMLInputElement} */ (button.previousElementSibling);
    if (!done) field.select();
    /** @type {HTMLElement} */ (button.nextElementSibling).textContent = t(
      done ? "share.copied" : "share.copy-by-hand",
    );
  };
  return html`<p class="copied"><input readonly .value=${text} aria-label=${label} @focus=${(/** @type {Event} */ { target }) => /** @type {HTMLInputElement} */ (target).select()}>
    <button class="quiet" @click=${copy}>${t("share.copy")}</button><span role="status"></span></p>`;
}

/** @param {string} address @param {View["t"]} t */
function code(address, t) {
  const made = generate(address);
  const side = made.size + 2 * QUIET;
  return html`<svg class="qr" role="img" aria-label=${t("share.code")} viewBox="${-QUIET} ${-QUIET} ${side} ${side}">
    ${svg`<rect x=${-QUIET} y=${-QUIET} width=${side} height=${side} /><path d=${pathOf(made)} />`}</svg>`;
}

/** Hands a file to the browser. @param {import("../model/share.js").File | null} file */
function save(file) {
  if (file) offer(file.name, file.text, file.type);
}

/** @param {string} address @param {View["t"]} t */
const handoutLink = (address, t) => html`<a href=${address}>${icon("print")}<span>${t("share.handout")}</span></a>`;

/** What is seen of the motion. @param {View} view */
function seen({ instruments, t }) {
  if (!instruments) return nothing;
  const { take } = instruments;
  const button = (/** @type {"svg" | "png" | "csv"} */ form) =>
    html`<li><button class="quiet" @click=${trying(take[form], t)}>${icon("file")}<span>${t(`share.${form}`)}</span></button></li>`;
  return html`${button("svg")} ${button("png")} ${button("csv")} ${film(take, t)}
    <li class="warning" role="alert" data-trouble></li>`;
}

/** Tells in the list why there is no file, and what helps. @param {() => Promise<import("./figure/take.js").Trouble>} act @param {View["t"]} t */
const trying =
  (act, t) =>
  async (/** @type {Event} */ { currentTarget }) => {
    const list = /** @type {HTMLElement} */ (/** @type {HTMLElement} */ (currentTarget).closest("ul"));
    const told = /** @type {HTMLElement} */ (list.querySelector("[data-trouble]"));
    told.textContent = "";
    const why = await act().catch(() => "unknown");
    if (why) told.textContent = t(`share.trouble-${why}`);
  };

/** @param {import("./figure/take.js").TakeSeen} take @param {View["t"]} t */
function film(take, t) {
  const record = (/** @type {Event} */ event) => {
    const button = /** @type {HTMLButtonElement} */ (event.currentTarget);
    const way = /** @type {HTMLElement} */ (button.nextElementSibling);
    const [bar, end] = /** @type {[HTMLProgressElement, HTMLButtonElement]} */ ([...way.children]);
    const stop = new AbortController();
    end.onclick = () => stop.abort();
    [button.disabled, way.hidden] = [true, false];
    const filming = async () => {
      try {
        return await take.film((part) => (bar.value = part), stop.signal);
      } finally {
        [button.disabled, way.hidden] = [false, true];
      }
    };
    return trying(filming, t)(event);
  };
  return html`<li><button class="quiet" @click=${record}>${icon("file")}<span>${t("share.film")}</span></button>
    <span class="film" hidden><progress max="1" value="0" aria-label=${t("share.film-under-way")}></progress> <button class="quiet small">${t("share.film-stop")}</button></span></li>`;
}

/** @param {View} view @param {Take} take */
function files(view, take) {
  const { state, t } = view;
  const { scene, lang, theme, formulation, n, set, release } = state.place;
  const handout = `/handout${writePlace({ ...HOME, scene, lang, theme, formulation, n, set, release })}${fragment(state)}`;
  return html`
    <ul class="files">
      <li>${handoutLink(handout, t)}</li>
      ${FORMS.map((form) => html`<li><button class="quiet" @click=${() => void take(form).then(save)}>${icon("file")}<span>${t(`share.${form}`)}</span></button></li>`)}
      ${seen(view)}
    </ul>
    ${state.failures.export ? html`<p class="warning" role="alert">${state.failures.export.detail || t("failure.unreachable")}</p>` : nothing}`;
}
