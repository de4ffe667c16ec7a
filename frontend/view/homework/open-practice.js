/** Practice without end, fetched when it is first opened: it brings the scheduler along. */

import { translator } from "../../model/catalog.js";
import { createPractice } from "../../model/homework/practice.js";
import { onward, panel, problem } from "./practice.js";

/** @typedef {import("./page.js").HomeworkView} HomeworkView */

/** @param {{api: import("../../model/api.js").Api, keeper: import("../../model/own.js").Keeper, changed: () => void}} around */
export function open({ api, keeper, changed }) {
  const session = createPractice({ keeper, now: () => new Date(), random: Math.random });
  session.subscribe(changed);
  /** The names of misconceptions, by language. @type {Record<string, ReturnType<typeof translator>>} */
  const names = {};
  let wanted = "";

  /** @param {import("../../model/types.js").Lang} lang */
  async function name(lang) {
    wanted = lang;
    const catalog = await api.catalog(lang, "homework").catch(() => null);
    if (!catalog) return;
    names[lang] = translator(catalog.homework);
    changed();
  }

  /** What a misconception is called, whatever it is made on. @param {HomeworkView} view @param {string} id */
  function nameOf({ state }, id) {
    const say = names[state.asked.place.lang];
    if (!say) return "…";
    return (
      [`misconceptions.${id}.general`, `misconceptions.${id}.title`]
        .map((key) => say(key))
        .find((text) => !text.startsWith("misconceptions.")) ?? id
    );
  }

  return {
    session,
    /** @param {HomeworkView} view */
    panel(view) {
      const { lang } = view.state.asked.place;
      if (wanted !== lang) void name(lang);
      return panel(view, session, (id) => nameOf(view, id));
    },
    problem,
    /** @param {HomeworkView} view */
    onward: (view) => onward(view, session),
  };
}
