/** Changes of a scene document: each returns a new one, and what nobody touched stays as it was. */

import { dimensionOf, fieldsOf, isList, memberOf, rowsOf, SECTIONS } from "./schema.js";
import { numberIn } from "../numbers.js";
import { tableOf } from "../own.js";

/** @typedef {import("../own.js").SceneDocument} SceneDocument */

/** Where things are called by their names, besides expressions. */
const PLACES = ["at", "from", "to"];
const NAMED = ["points", "bodies", "loads"];
/** Nothing refers to these by their names, or expressions alone do. */
const UNREFERRED = ["parameters", "guides", "constraints", "events"];

/**
 * The document with another value at a pointer; undefined takes the field away.
 * @template T @param {T} document @param {string} pointer @param {unknown} value
 * @returns {T}
 */
export function written(document, pointer, value) {
  return /** @type {T} */ (put(document, pointer.split("/").slice(1), value));
}

/** @param {unknown} node @param {string[]} path @param {unknown} value @returns {unknown} */
function put(node, [key, ...rest], value) {
  if (key === undefined) return value;
  if (/^\d+$/.test(key) && (Array.isArray(node) || !tableOf(node))) {
    const list = rowsOf(node).slice();
    while (list.length < Number(key)) list.push("0");
    list[Number(key)] = put(list[Number(key)], rest, value);
    return list;
  }
  const table = { ...(tableOf(node) ?? {}), [key]: put(tableOf(node)?.[key], rest, value) };
  if (table[key] === undefined) delete table[key];
  return table;
}

/** A number as typed; what is none stays text, and the server says so. @param {string} text */
export function numberOf(text) {
  if (!text.trim()) return undefined;
  const number = numberIn(text);
  return Number.isNaN(number) ? text : number;
}

/** @param {SceneDocument} document @param {string} key @param {object} row */
export const added = (document, key, row) => ({ ...document, [key]: [...rowsOf(document[key]), row] });

/**
 * A body or load of another kind. @param {SceneDocument} document @param {string} key @param {number} index @param {string} kind
 */
export const ofKind = (document, key, index, kind) => fitted(written(document, `/${key}/${index}/kind`, kind));

/** In the plane or in space. @param {SceneDocument} document @param {number} dimension */
export const inDimension = (document, dimension) => fitted({ ...document, dimension });

/** Without fields that belong to other kinds or another dimension: the form does not show them, so nobody could take them away. @param {SceneDocument} document */
function fitted(document) {
  const sections = SECTIONS.filter(({ key, kinds }) => kinds && Array.isArray(document[key]));
  return {
    ...document,
    ...Object.fromEntries(
      sections.map((section) => [
        section.key,
        rowsOf(document[section.key]).map((row) => fittedRow(section, row, dimensionOf(document))),
      ]),
    ),
  };
}

/** @param {import("./schema.js").Section} section @param {unknown} row @param {number} dimension */
function fittedRow(section, row, dimension) {
  const shown = new Map(fieldsOf(section, row, dimension).map((field) => [field.key, field]));
  const elsewhere = new Set(
    [2, 3].flatMap((space) =>
      Object.keys(section.kinds ?? {}).flatMap((kind) => fieldsOf(section, { kind }, space).map(({ key }) => key)),
    ),
  );
  return Object.fromEntries(
    Object.entries(tableOf(row) ?? {}).filter(([key, value]) => {
      const field = shown.get(key);
      return field ? isList(field) === Array.isArray(value) : !elsewhere.has(key);
    }),
  );
}

/** @param {SceneDocument} document @param {string} key @param {number} index @param {number} by */
export function shifted(document, key, index, by) {
  const list = rowsOf(document[key]).slice();
  const to = index + by;
  if (to < 0 || to >= list.length) return document;
  [list[index], list[to]] = [list[to], list[index]];
  return { ...document, [key]: list };
}

/** Without a row; labels and elements of the drawing that hang on it go with it. @param {SceneDocument} document @param {string} key @param {number} index */
export function removed(document, key, index) {
  const gone = memberOf(rowsOf(document[key])[index], "name");
  const next = { ...document, [key]: rowsOf(document[key]).filter((_, i) => i !== index) };
  if (!gone || UNREFERRED.includes(key)) return next;
  const keys = referring(key);
  const kept = labelled(next, (labels) =>
    Object.fromEntries(Object.entries(labels).filter(([name]) => key === "coordinates" || name !== gone)),
  );
  return elements(kept, (all) => all.filter((element) => !keys.some((one) => memberOf(element, one) === gone)));
}

/** @param {string} section */
const referring = (section) => (section === "loads" ? ["load"] : section === "coordinates" ? ["coordinate"] : PLACES);

/** @param {SceneDocument} given @param {(elements: unknown[]) => unknown[]} change */
function elements(given, change) {
  const drawing = tableOf(given.drawing);
  return drawing && Array.isArray(drawing.elements)
    ? { ...given, drawing: { ...drawing, elements: change(drawing.elements) } }
    : given;
}

/** @param {SceneDocument} given @param {(labels: SceneDocument) => SceneDocument} change */
function labelled(given, change) {
  const labels = tableOf(given.labels);
  return labels ? { ...given, labels: change(labels) } : given;
}

/**
 * A point, body, load or coordinate by another name; loads, guides, labels and drawing follow where this is unambiguous.
 * @param {SceneDocument} document @param {string} key @param {number} index @param {string} name
 */
export function renamed(document, key, index, name) {
  const before = memberOf(rowsOf(document[key])[index], "name");
  const next = written(document, `/${key}/${index}/name`, name);
  const taken = SECTIONS.flatMap((section) => rowsOf(document[section.key]).map((row) => memberOf(row, "name")));
  if (
    !before ||
    !name ||
    UNREFERRED.includes(key) ||
    taken.includes(name) ||
    taken.filter((one) => one === before).length > 1
  )
    return next;
  const keys = referring(key);
  const follow = (/** @type {unknown} */ row) =>
    Object.fromEntries(
      Object.entries(tableOf(row) ?? {}).map(([k, v]) => [k, keys.includes(k) && v === before ? name : v]),
    );
  const lists = key === "coordinates" ? ["guides"] : ["loads", "constraints", "events"];
  const moved = Object.fromEntries(
    lists.filter((list) => Array.isArray(next[list])).map((list) => [list, rowsOf(next[list]).map(follow)]),
  );
  const labels = (/** @type {SceneDocument} */ all) =>
    Object.fromEntries(Object.entries(all).map(([k, v]) => [NAMED.includes(key) && k === before ? name : k, v]));
  return elements(labelled({ ...next, ...moved }, labels), (all) => all.map(follow));
}
