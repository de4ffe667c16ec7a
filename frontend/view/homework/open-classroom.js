/** The table of a class, fetched when it is first opened. */

import { createClassroom } from "../../model/homework/classroom.js";
import { classroom } from "./classroom.js";

/** @param {{api: import("../../model/homework/state.js").Api, state: () => import("../../model/homework/state.js").State, changed: () => void, say: (key: string) => string, questions: (reference: object) => Promise<string | null>}} around */
export function open({ api, state, changed, say, questions }) {
  const session = createClassroom({ api, state, say, questions });
  session.subscribe(changed);
  return (/** @type {import("./page.js").HomeworkView} */ view) => classroom(view, session);
}
