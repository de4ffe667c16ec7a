/** Forces that a motion does not determine, in sentences: where more sticks, rests or is bound than it needs. */

import { inLanguage } from "./catalog.js";
import { symbolOfForce } from "./forces.js";
import { fixed } from "./numbers.js";
import { endOf } from "./trajectory.js";

/** @typedef {import("./types.js").Trajectory} Trajectory */
/** @typedef {import("./types.js").Scene} Scene */
/** @typedef {NonNullable<Trajectory["indeterminate"]>} Spans */

/** Spans by the forces that are not determined in them. @param {Spans} spans @returns {Map<string, Spans>} */
function byNames(spans) {
  const found = new Map();
  for (const span of spans) {
    const key = span.names.join(" ");
    found.set(key, [...(found.get(key) ?? []), span]);
  }
  return found;
}

/**
 * One sentence for each group of forces of which only what they do together is known: when, and why.
 * @param {Trajectory} trajectory @param {Scene} scene @param {import("./catalog.js").Translate} t @param {string} lang
 * @returns {import("./prose.js").CatalogText[]}
 */
export function indeterminateIn(trajectory, scene, t, lang) {
  const { indeterminate = [], undetermined } = trajectory;
  const called = (/** @type {string} */ name) => {
    const contact = (scene.events ?? []).find((event) => event.name === name);
    if (!contact) return `$${symbolOfForce(scene, trajectory, name)}$`;
    return t("status.contact", { title: (inLanguage(contact.title, lang) || name).replaceAll("$", "＄") });
  };
  const list = (/** @type {readonly string[]} */ names) => names.map(called).join(", ");
  const end = endOf(trajectory);
  const when = (/** @type {Spans} */ spans) => {
    const [first] = spans;
    if (first.start <= 0 && first.end >= end) return t("status.throughout");
    const times = { start: fixed(first.start, 2, lang), end: fixed(first.end, 2, lang), count: spans.length };
    return t("status.spans", times);
  };
  const always = undetermined?.length ? [t("status.dependent", { names: list(undetermined) })] : [];
  const sometimes = [...byNames(indeterminate).values()].map((spans) =>
    t("status.indeterminate", { names: list(spans[0].names), when: when(spans) }),
  );
  return [...always, ...sometimes];
}
