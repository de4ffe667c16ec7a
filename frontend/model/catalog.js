/** Texts by key, from the catalogs that the backend shares. */

import { tableOf } from "./own.js";

/** @typedef {(key: string, parameters?: Record<string, string | number>) => string} Translate */

/**
 * Looks a text up in one section of a catalog; keys may be flat ("player.play") or nested.
 * Where `count` is 1, the text under the key and "-one" is taken, if there is one.
 * An absent text shows its key, so that it is seen.
 * @param {Record<string, unknown>} section
 * @returns {Translate}
 */
export function translator(section) {
  const found = (/** @type {string} */ key) => section[key] ?? nested(section, key);
  return (key, parameters = {}) => {
    const text = (String(parameters.count) === "1" ? found(`${key}-one`) : undefined) ?? found(key);
    return typeof text === "string" ? filled(text, parameters) : key;
  };
}

/** @param {Record<string, unknown>} section @param {string} key */
function nested(section, key) {
  /** @type {unknown} */
  let node = section;
  for (const part of key.split(".")) node = tableOf(node)?.[part];
  return node;
}

/** @param {string} text @param {Record<string, string | number>} parameters */
function filled(text, parameters) {
  return text.replace(/\{(\w+)\}/g, (whole, name) => (name in parameters ? String(parameters[name]) : whole));
}

/**
 * The text in the asked language, else in English, else in any; one that stands for all languages as it is.
 * @param {string | Record<string, string> | null | undefined} texts @param {string} lang
 */
export function inLanguage(texts, lang) {
  if (!texts || typeof texts === "string") return texts || "";
  return texts[lang] ?? texts.en ?? Object.values(texts)[0] ?? "";
}

/**
 * What a point, body or load is called: its label, else the word for the kind of what has no name of its own, else the name.
 * @param {import("./types.js").Scene["labels"]} labels @param {string} name @param {string} lang @param {Translate} t
 */
export function called(labels, name, lang, t) {
  const label = inLanguage(labels?.[name], lang);
  const [, named, number = ""] = /^([a-z]+(?:_[a-z]+)*)-?(\d*)$/.exec(name) ?? [];
  const kind = named?.replaceAll("_", "-");
  const word = t(`kinds.${kind}`);
  return label || (word === `kinds.${kind}` ? name : `${word} ${number}`.trim());
}
