/** Opens the editor: its state and its view. */

import { createEditor } from "../../model/editor/editor.js";
import { copyOf, EMPTY } from "../../model/editor/templates.js";
import { OWN } from "../../model/own.js";
import { editorView } from "./editor.js";

/** @typedef {import("../../model/own.js").Draft} Draft */

/** What is written when the editor opens: what was sent or chosen, and what was kept set aside. @param {import("../../model/state.js").State} state @param {Draft | null} draft @returns {Draft} */
function firstDraft({ place, own, scene }, draft) {
  const given = place.scene === OWN ? own : scene ? copyOf(scene) : null;
  if (!given) return draft ?? { document: EMPTY, text: null, earlier: [] };
  if (!draft) return { document: given, text: null, earlier: [] };
  if (JSON.stringify(draft.document) === JSON.stringify(given)) return draft;
  return { document: given, text: null, earlier: [draft.document, ...draft.earlier] };
}

/**
 * @param {{api: import("../../model/api.js").Api, session: import("../page.js").View["session"],
 *   state: () => import("../../model/state.js").State, draft: Draft | null, keep: (draft: Draft) => boolean, changed: () => void}} around
 */
export function open({ api, session, state, draft, keep, changed }) {
  const editor = createEditor(
    {
      api,
      keep,
      lang: () => state().place.lang,
      show: (document) => void session.show(document),
      address: (document) => void session.address(document),
    },
    firstDraft(state(), draft),
  );
  let lang = state().place.lang;
  editor.subscribe(changed);
  return {
    /** @param {import("../page.js").View} view */
    view(view) {
      if (view.state.place.lang !== lang) {
        lang = view.state.place.lang;
        queueMicrotask(editor.again);
      }
      return editorView({ ...view, editing: editor, api });
    },
    /** A copy of the scene that is on the page, unless it is the viewer's own. */
    copy() {
      const { place, scene } = state();
      if (place.scene !== OWN && scene) editor.begin(copyOf(scene));
    },
  };
}
