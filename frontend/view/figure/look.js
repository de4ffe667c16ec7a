/** How the plots are looked at: by wheel, by a dragged part of the time, by the names of the curves, and by a menu. */

import { html, nothing } from "lit-html";
import { between, readLook, toggled, writeLook, zoomed } from "../../model/look.js";

/** @typedef {import("../page.js").View} View */
/** @typedef {import("../../model/look.js").Look} Look */

/** A step of zooming by a button, and by a hundred units of the wheel. */
const STEP = 0.5;
const WHEEL = 0.75;
/** Milliseconds between two changes of the address by the wheel. */
const PAUSE = 80;
/** Where a page is scrolled with a finger or the wheel, the wheel needs Ctrl to zoom. */
const narrow = matchMedia("(max-width: 900px)");

const SLIDERS = "M3 6h7M14 6h3M10 6a2 2 0 1 0 4 0a2 2 0 1 0-4 0M3 14h3M10 14h7M6 14a2 2 0 1 0 4 0a2 2 0 1 0-4 0";

const AXES = /** @type {const} */ (["", "one", "each"]);

/** @param {import("./open.js").Bench} bench */
export function createLook({ root, parts: { plots }, state, clock, session }) {
  const area = /** @type {HTMLElement} */ (root.querySelector(".plots"));
  const now = () => readLook(state().place.plot);
  const look = (/** @type {Look} */ next) => session.move({ plot: writeLook(next) });
  const timeOf = (/** @type {MouseEvent} */ { clientX }) =>
    plots.drawn?.scale.time(clientX - area.getBoundingClientRect().left) ?? 0;
  const zoom = (/** @type {number} */ factor, t = clock.time) => look(zoomed(now(), state().place.duration, t, factor));
  const whole = () => look({ ...now(), span: null });
  const isFree = (/** @type {Event} */ { target }) =>
    Boolean(plots.drawn) && !(target instanceof Element && target.closest("button, .plot-tools, .phase"));

  let turned = 0;
  let due = 0;
  area.addEventListener(
    "wheel",
    (event) => {
      if (!isFree(event) || (narrow.matches && !event.ctrlKey)) return;
      event.preventDefault();
      turned += event.deltaY / 100;
      const t = timeOf(event);
      due ||= window.setTimeout(() => {
        zoom(WHEEL ** -turned, t);
        [turned, due] = [0, 0];
      }, PAUSE);
    },
    { passive: false },
  );

  const band = document.createElement("div");
  band.className = "span";
  /** Where a dragged part of the time begins. @type {{x: number, t: number} | null} */
  let from = null;
  area.addEventListener("pointerdown", (event) => {
    if (!event.shiftKey || !isFree(event)) return;
    area.setPointerCapture(event.pointerId);
    from = { x: event.clientX, t: timeOf(event) };
    area.append(band);
    band.style.width = "0";
    event.preventDefault();
  });
  area.addEventListener("pointermove", ({ clientX }) => {
    if (!from) return;
    const left = Math.min(clientX, from.x) - area.getBoundingClientRect().left;
    band.style.cssText = `left:${left}px;width:${Math.abs(clientX - from.x)}px`;
  });
  for (const end of /** @type {const} */ (["pointerup", "pointercancel"]))
    area.addEventListener(end, (event) => {
      if (!from) return;
      const { t } = from;
      from = null;
      band.remove();
      if (end === "pointerup") look(between(now(), state().place.duration, t, timeOf(event)));
    });
  area.addEventListener("dblclick", (event) => isFree(event) && now().span && whole());
  area.addEventListener("click", ({ target }) => {
    const name = target instanceof Element ? target.closest(".legend [data-curve]") : null;
    const key = name instanceof HTMLElement ? name.dataset.curve : null;
    if (!key) return;
    look(toggled(now(), key));
  });

  /** @param {View} view */
  function menu({ state: { scene, place }, session, t }) {
    const chosen = now();
    const close = (/** @type {KeyboardEvent} */ event) => {
      const menu = /** @type {HTMLDetailsElement} */ (event.currentTarget);
      if (event.key !== "Escape" || !menu.open) return;
      event.stopPropagation();
      menu.open = false;
      menu.querySelector("summary")?.focus();
    };
    const left = (/** @type {FocusEvent} */ { currentTarget, relatedTarget }) => {
      const menu = /** @type {HTMLDetailsElement} */ (currentTarget);
      if (relatedTarget instanceof Node && !menu.contains(relatedTarget)) menu.open = false;
    };
    const angles = scene?.coordinates.some(({ unit }) => unit === "rad");
    const button = (/** @type {string} */ name, /** @type {() => void} */ act, disabled = false) =>
      html`<button class="quiet small" ?disabled=${disabled} @click=${act}>${t(name)}</button>`;
    return html`
      ${place.plot && chosen.span ? button("plots.whole", whole) : nothing}
      <details class="plot-menu" @keydown=${close} @focusout=${left}>
        <summary class="tool" title=${t("plots.look")} aria-label=${t("plots.look")}><svg class="icon" viewBox="0 0 20 20" aria-hidden="true"><path d=${SLIDERS} /></svg></summary>
        <div class="sheet">
          <p>${button("plots.nearer", () => zoom(STEP))}${button("plots.further", () => zoom(1 / STEP), !chosen.span)}${button("plots.whole", whole, !chosen.span)}</p>
          ${angles ? html`<label><input type="checkbox" .checked=${chosen.wrapped} @change=${() => look({ ...now(), wrapped: !chosen.wrapped })}>${t("plots.wrapped")}</label>` : nothing}
          <label>${t("plots.axes")}
            <select @change=${(/** @type {Event} */ { target }) => look({ ...now(), axes: AXES[/** @type {HTMLSelectElement} */ (target).selectedIndex] })}>
              ${AXES.map((axes) => html`<option ?selected=${axes === chosen.axes}>${t(`plots.axes-${axes || "scale"}`)}</option>`)}
            </select></label>
          <p class="hint">${t("plots.hint")}</p>
          <button class="quiet small" @click=${() => session.overlay("share")}>${t("tool.share")}</button>
        </div>
      </details>`;
  }
  return { menu };
}
