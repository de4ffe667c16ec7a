/** A sheet in the making, fetched when it is first opened. */

import { createPicker } from "../../model/homework/picker.js";
import { picker } from "./picker.js";

/** @param {{api: import("../../model/api.js").Api, state: () => import("../../model/homework/state.js").State, keeper: import("../../model/own.js").Keeper, changed: () => void}} around */
export function open({ api, state, keeper, changed }) {
  const session = createPicker(api, state, keeper);
  session.subscribe(changed);
  let lang = "";
  return (/** @type {import("./page.js").HomeworkView} */ view) => {
    const wanted = view.state.asked.place.lang;
    if (wanted !== lang) void session.arrive();
    lang = wanted;
    return picker(view, session);
  };
}
