/** Rungs of the fidelity ladder in words. */

import { inLanguage } from "../catalog.js";

/** @typedef {Record<string, string | Record<string, string>>} Names  what a scene calls its quantities and parts */

/**
 * @param {{parts: {kind: string, parameters: Record<string, string>}[]}} rung @param {(key: string, parameters?: Record<string, string>) => string} t
 * @param {Names} [names] @param {string} [lang]
 */
export function titleOf({ parts }, t, names = {}, lang = "en") {
  const called = (/** @type {string} */ name) => inLanguage(names[name] ?? name, lang);
  const told = (/** @type {Record<string, string>} */ parameters) =>
    Object.fromEntries(Object.entries(parameters).map(([key, some]) => [key, some.split(", ").map(called).join(", ")]));
  return (
    parts.map(({ kind, parameters }) => t(`ladder.kinds.${kind}.title`, told(parameters))).join(", ") ||
    t("ladder.kinds.full.title")
  );
}
