/** What can be taken away from a scene: files, a frame for other pages, a picture of the address. */

import { ApiError, failureOf } from "./api.js";
import { requestOf } from "./request.js";
import { HOME, writePlace } from "./url.js";

/** @typedef {import("./types.js").Place} Place */
/** @typedef {import("./types.js").Shown} Shown */

export const FORMS = /** @type {const} */ (["latex", "markdown", "python"]);
/** @type {Shown[]} */
export const SHOWN = ["", "figure", "derivation"];
/** Heights of frames in pixels, until they say their own. */
const HEIGHTS = { "": 760, figure: 420, derivation: 420 };

/** @param {string} text */
const escaped = (text) =>
  text.replace(/[&"<>]/g, (sign) => ({ "&": "&amp;", '"': "&quot;", "<": "&lt;", ">": "&gt;" })[sign] ?? "");

/** The address of a place within frames of other pages. @param {string} origin @param {Place} place @param {Shown} shown @param {string} fragment */
export function frameAddress(origin, place, shown, fragment) {
  return `${origin}/embed${writePlace({ ...place, view: "", edit: "", panel: HOME.panel, show: shown })}${fragment}`;
}

/** The address of the general proof within frames of other pages. @param {string} origin @param {Pick<Place, "step" | "lang" | "theme">} place */
export const proofFrameAddress = (origin, { step, lang, theme }) =>
  `${origin}/embed/proof${writePlace({ ...HOME, step, lang, theme })}`;

/** One line of HTML that shows a place in another page. @param {string} address @param {Shown} shown @param {string} title */
export function snippet(address, shown, title) {
  return `<iframe src="${escaped(address)}" title="${escaped(title)}" width="100%" height="${HEIGHTS[shown]}" style="border:0" loading="lazy" allow="fullscreen"></iframe>`;
}

/** The modules of a code as one path, each a unit square. @param {{size: number, get: (x: number, y: number) => boolean}} code */
export function pathOf({ size, get }) {
  const path = [];
  for (let y = 0; y < size; y++) for (let x = 0; x < size; x++) if (get(x, y)) path.push(`M${x} ${y}h1v1h-1z`);
  return path.join("");
}

/** @typedef {{text: string, name: string, type: string}} File */

/**
 * Files of what is shown; null where it failed, and why is kept.
 * @param {typeof fetch} send
 * @param {Pick<ReturnType<typeof import("./store.js").createStore<import("./state.js").State>>, "get" | "set">} store
 */
export function createExports(send, { get, set }) {
  return async (/** @type {typeof FORMS[number]} */ form) => {
    const { scene, initial, parameters, release, t_end, lang } = requestOf(get(), get().changes, "");
    const { formulation } = get().place;
    const fail = (/** @type {import("./types.js").Failure | null} */ failure) =>
      set({ failures: { ...get().failures, export: failure } });
    try {
      const file = await exported(send, form, { scene, initial, parameters, release, t_end, lang, formulation });
      fail(null);
      return file;
    } catch (error) {
      if (!(error instanceof ApiError)) throw error;
      fail(error.failure);
      return null;
    }
  };
}

/** @param {typeof fetch} send @param {string} form @param {object} body @returns {Promise<File>} */
async function exported(send, form, body) {
  const options = { method: "POST", headers: { "content-type": "application/json" }, body: JSON.stringify(body) };
  const response = await send(`/api/v1/exports/${form}`, options).catch(() => {
    throw new ApiError(failureOf(0, null));
  });
  if (!response.ok) throw new ApiError(failureOf(response.status, await response.json().catch(() => null)));
  const [, name] = response.headers.get("content-disposition")?.match(/filename="([^"]+)"/) ?? [];
  return {
    text: await response.text(),
    name: name ?? `deltaq.${form}`,
    type: response.headers.get("content-type") ?? "text/plain",
  };
}
