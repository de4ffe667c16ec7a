/** The table of a class, fetched when it is first opened. */

import { createClassroom } from "../../model/homework/classroom.js";
import { classroom } from "./classroom.js";

/** @param {{send: typeof fetch, state: () => import("../../model/homework/state.js").State, changed: () => void, questions: (reference: object) => Promise<string | null>}} around */
export function open({ send, state, changed, questions }) {
  const session = createClassroom({ send, state, questions });
  session.subscribe(changed);
  return (/** @type {import("./page.js").HomeworkView} */ view) => classroom(view, session);
}
