/** What most readers never need, fetched when it is first wanted: the editor, lecture mode, overlays, sharing. */

import { translator } from "../model/catalog.js";
import { createLater } from "../model/later.js";
import { keepDraft, OWN, readDraft } from "../model/own.js";
import { sceneOf } from "../model/request.js";
import { sheet } from "./bring.js";
import { keeper } from "./keeper.js";

/** @typedef {import("./page.js").View} View */
/** Milliseconds after which a motion is told: not while a slider moves. */
const REST = 1200;
/** A motion is shown all the same. */
const UNTOLD = { summary: () => "" };

/** @typedef {ReturnType<typeof import("../model/store.js").createStore<import("../model/state.js").State>>} Store */

/**
 * @param {{root: HTMLElement, store: Store, api: import("../model/api.js").Api, session: View["session"], send: typeof fetch,
 *   changed: () => void, play: () => void}} page
 */
export function createAside({ root, store, api, session, send, changed, play }) {
  const { get } = store;
  const above = createLater(async () => {
    const [part] = await Promise.all([import("./overlays.js"), sheet("overlays")]);
    return part;
  }, changed);
  const editor = createLater(async () => {
    const [{ open }] = await Promise.all([import("./editor/open.js"), sheet("editor")]);
    const keep = (/** @type {import("../model/own.js").Draft} */ draft) => keepDraft(keeper(), draft);
    return open({ api, session, state: get, draft: readDraft(keeper()), keep, changed });
  }, changed);
  const lecture = createLater(async () => {
    const [{ open }] = await Promise.all([import("./lecture/open.js"), sheet("lecture")]);
    const about = () => ({ scene: get().place.scene, title: get().scene?.title ?? {} });
    return open({ root, session, state: get, about, changed, play, poll });
  }, changed);
  /** @param {string} step */
  function poll(step) {
    const { place } = get();
    const parameters = place.n ? { parameters: { n: place.n } } : {};
    return api.poll({ scene: sceneOf(get()) ?? OWN, ...parameters, step, lang: place.lang });
  }
  const sharing = createLater(async () => {
    const [{ share }, { createExports }, dialogs] = await Promise.all([
      import("./share.js"),
      import("../model/share.js"),
      above.again(),
    ]);
    if (!dialogs) throw new Error("no dialogs to share in");
    const take = createExports(send, store);
    return (/** @type {View} */ view) => share(view, take);
  }, changed);

  /** @type {import("../model/types.js").Trajectory | null} */
  let told = null;
  let telling = 0;

  /** The motion in words, once it is settled. */
  function tell() {
    const { trajectory } = get();
    if (trajectory === told) return;
    told = trajectory;
    clearTimeout(telling);
    telling = window.setTimeout(async () => {
      const { summary } = await import("./summary.js").catch(() => UNTOLD);
      const { scene, trajectory: settled, catalog, place } = get();
      const words = translator(catalog.page ?? {});
      const element = root.querySelector("#motion");
      if (element && scene && settled?.t.length) element.textContent = summary(scene, settled, words, place.lang);
    }, REST);
  }

  const framed =
    location.pathname === "/embed"
      ? import("./embed.js").then(({ embed }) => embed(root, () => get().place, whole))
      : null;
  const whole = () => location.href.replace("/embed", "/scene");

  return {
    editor,
    lecture,
    /** Lecture mode while it is on. */
    lecturing: () => (get().place.view && get().catalog.lecture ? lecture.part : null),
    /** What lies above the page, once its texts are there. @returns {View["overlays"]} */
    overlays() {
      const { catalog, overlay } = get();
      if (!catalog.lecture) return undefined;
      return (overlay === "share" ? sharing.part : above.part?.overlays) ?? undefined;
    },
    /** @returns {import("./missed.js").Missable[]} */
    tools() {
      const { overlay, place } = get();
      return [
        { says: "missed.editor", later: editor, wanted: Boolean(place.edit) },
        { says: "missed.lecture", later: lecture, wanted: Boolean(place.view) },
        { says: "missed.sharing", later: sharing, wanted: overlay === "share" },
        { says: "missed.overlays", later: above, wanted: overlay !== "" && overlay !== "share" },
      ];
    },
    /** Called after each rendering: fetches what is wanted now. */
    update() {
      const { overlay, place, scene, failures } = get();
      if (overlay) void (overlay === "share" ? sharing : above).want();
      above.part?.openDialog(root);
      void framed?.then((tell) => tell());
      // It begins with the scene of the page, so that has to be there.
      if (place.edit && (place.scene === OWN || scene || failures.scene || failures.page)) void editor.want();
      if (place.view) void lecture.want();
      lecture.part?.update();
      tell();
    },
  };
}
