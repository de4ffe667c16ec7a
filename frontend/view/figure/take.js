/** What is seen of a motion, to be taken away: a picture, a table of the curves, a film. */

import { readLook, spanOf } from "../../model/look.js";
import { rowsOf } from "../../model/curves.js";
import { lettersOf } from "../../model/picture/letters.js";
import { familiesOf, paint, svgOf } from "../../model/picture/picture.js";
import { tableOf } from "../../model/picture/table.js";
import { withLength } from "../../model/picture/webm.js";
import { isShown } from "../../model/plots.js";
import { offer } from "../files.js";
import { createPace, filmForm } from "./film.js";
import { createSeen } from "./seen.js";

/** Pixels of a picture and of a film for one of the screen, and of a frame of a film at most. */
const FINE = 2;
const MOST = 1280 * 720;
/** Frames in a second, and bits for a pixel of each. */
const [RATE, BITS] = [30, 0.12];

/** @typedef {"" | "no-motion" | "too-large" | "no-film" | "film-broke"} Trouble  why there is no file; nothing where there is one */

/** Rules of the page's letters, which say where their data is. @param {readonly string[]} families @returns {import("../../model/picture/letters.js").Face[]} */
function facesOf(families) {
  const rules = [...document.styleSheets].flatMap((sheet) => {
    try {
      return [...sheet.cssRules];
    } catch {
      return []; // of another origin: none of ours
    }
  });
  return rules
    .filter((rule) => rule instanceof CSSFontFaceRule)
    .map(({ style, parentStyleSheet }) => {
      const [family, slant, weight] = ["font-family", "font-style", "font-weight"].map((name) =>
        style.getPropertyValue(name).replace(/["']/g, ""),
      );
      const [, address = ""] = style.getPropertyValue("src").match(/url\(["']?([^"')]+\.woff2)["']?\)/) ?? [];
      return {
        family,
        slant,
        weight,
        address: address && new URL(address, parentStyleSheet?.href ?? location.href).href,
      };
    })
    .filter(({ family, address }) => address && families.includes(family));
}

/** Families that the page has rules for. */
const familiesHere = () => [...new Set([...document.fonts].map(({ family }) => family.replace(/["']/g, "")))];

/** A canvas for pictures as large as this one; films want even sides. @param {{width: number, height: number}} size @param {number} scale */
function canvasFor({ width, height }, scale) {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [width, height].map((side) => 2 * Math.round((side * scale) / 2));
  return { canvas, ink: /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d")) };
}

/** @param {import("./open.js").Bench} bench */
export function createTake({ root, frame, state, clock, send }) {
  const see = createSeen();
  const panes = [frame, /** @type {HTMLElement} */ (root.querySelector(".plots"))];
  const now = () => see(panes, getComputedStyle(/** @type {HTMLElement} */ (frame.closest(".figure"))).backgroundColor);
  const name = (/** @type {string} */ end) => `${state().place.scene}.${end}`;
  /** Something moves, and something of it is seen. */
  const isThere = () => Boolean(state().trajectory?.t.length) && panes.some((pane) => pane.clientWidth > 0);

  /** @returns {Promise<Trouble>} */
  async function svg() {
    if (!isThere()) return "no-motion";
    const picture = now();
    const title = root.querySelector(".drawing > svg")?.getAttribute("aria-label") ?? state().place.scene;
    const fonts = await lettersOf(send, facesOf(familiesOf(picture, familiesHere())));
    offer(name("svg"), svgOf(picture, { title, fonts }), "image/svg+xml");
    return "";
  }

  /** @returns {Promise<Trouble>} */
  async function png() {
    if (!isThere()) return "no-motion";
    const picture = now();
    const { canvas, ink } = canvasFor(picture, FINE);
    paint(ink, picture, FINE);
    const made = await new Promise((resolve) => canvas.toBlob(resolve, "image/png"));
    if (!(made instanceof Blob)) return "too-large";
    offer(name("png"), made, "image/png");
    return "";
  }

  /** Of what the plots show, whether they are seen or not. @returns {Promise<Trouble>} */
  async function csv() {
    const { scene, trajectory, runs, place } = state();
    if (!scene || !trajectory?.t.length) return "no-motion";
    const beside = runs.map((run) => run.trajectory);
    offer(name("csv"), tableOf(rowsOf(scene, trajectory, beside, readLook(place.plot)), isShown), "text/csv");
    return "";
  }

  /**
   * Plays what the plots show once, at the speed of the player, and keeps it.
   * @param {(part: number) => void} tell  how much of it there is  @param {AbortSignal} stop  keeps what there is by then
   * @returns {Promise<Trouble>}
   */
  async function film(tell, stop) {
    const form = filmForm();
    if (!form) return "no-film";
    if (!isThere()) return "no-motion";
    const [type, end] = form;
    const [from, to] = spanOf(readLook(state().place.plot), clock.end);
    const before = clock.time;
    clock.play(false);
    clock.seek(from);
    const first = now();
    const scale = Math.min(FINE, Math.sqrt(MOST / (first.width * first.height)));
    const { canvas, ink } = canvasFor(first, scale);
    paint(ink, first, scale);
    const recorder = new MediaRecorder(canvas.captureStream(RATE), {
      mimeType: type,
      videoBitsPerSecond: canvas.width * canvas.height * RATE * BITS,
    });
    const pace = createPace(recorder);
    await pace.ready(() => paint(ink, first, scale));
    const begun = pace.seconds();
    for (let t = from; t < to && !stop.aborted && !pace.broken;) {
      await new Promise(requestAnimationFrame);
      t = Math.min(to, from + (pace.seconds() - begun) * clock.speed);
      clock.seek(t);
      paint(ink, now(), scale);
      tell((t - from) / (to - from));
    }
    const { parts, length } = await pace.end(() => paint(ink, now(), scale));
    clock.seek(before);
    if (!parts.length) return "film-broke";
    const whole = new Uint8Array(await new Blob(parts).arrayBuffer());
    offer(name(end), new Blob([end === "webm" ? withLength(whole, length) : whole], { type }), type);
    return "";
  }

  return { svg, png, csv, film };
}

/** @typedef {ReturnType<typeof createTake>} TakeSeen */
