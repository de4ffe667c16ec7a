/** Places of a lecture: addresses within this site, and how they are shown in the hall. */

/** @typedef {{path: string, query: string, fragment: string}} Parts */

/** Pages that a lecture can stop at. */
export const PLACES = ["scene", "proof", "variations", "labs", "homework"];
/** Those that show a derivation, which has a lecture mode with steps to go through. */
const DERIVED = ["scene", "proof"];
/** Of the reader, or of how a page is shown: a lecture decides them. */
const READERS = ["lang", "theme", "view", "edit", "panel"];
const LONGEST = 60_000;
const FORM = /^([a-z]+)(\?[\w\-.~:@!$'()*+,;=&%/?[\]^]*)?(#[\w\-=.~:]*)?$/;

/** @param {string} place @returns {Parts} */
function partsOf(place) {
  const [, path = "", query = "", fragment = ""] = FORM.exec(place) ?? [];
  return { path, query, fragment };
}

/** Whether a value is the address of one of these pages: no other site, no other path, nothing that a browser would read otherwise. @param {unknown} value @returns {value is string} */
export function isPlace(value) {
  return typeof value === "string" && value.length <= LONGEST && PLACES.includes(partsOf(value).path);
}

/** @param {string} query @param {readonly string[]} left */
function without(query, left) {
  const kept = query
    .slice(1)
    .split("&")
    .filter((pair) => pair && !left.includes(pair.split("=")[0]));
  return kept.length ? `?${kept.join("&")}` : "";
}

/**
 * What is shown at an address, as a place of a lecture; null if it is none of this site's pages.
 * @param {string} address @param {string} origin  of this site
 */
export function placeOf(address, origin) {
  const text = address.trim();
  const own = text.startsWith(`${origin}/`) ? text.slice(origin.length + 1) : text.replace(/^\//, "");
  if (!isPlace(own)) return null;
  const { path, query, fragment } = partsOf(own);
  return path + without(query, READERS) + fragment;
}

/** @param {string} place */
const isDerived = (place) => DERIVED.includes(partsOf(place).path);

/** @param {string} query @param {string} name */
const valueIn = (query, name) => new URLSearchParams(query).get(name) ?? "";

/** The step at which a place begins, and how many of its substeps are shown. @param {string} place */
export function beginningOf(place) {
  const { query } = partsOf(place);
  return { step: valueIn(query, "step"), part: Number(valueIn(query, "part")) || 0 };
}

/** Places of one derivation, which differ in their step alone, are shown in one frame. @param {string} place */
export function frameOf(place) {
  const { path, query, fragment } = partsOf(place);
  return path + without(query, isDerived(place) ? [...READERS, "step", "part"] : READERS) + fragment;
}

/**
 * The address of a frame of the hall.
 * @param {string} place  the first that it shows @param {{lang: string, theme: string}} reader
 */
export function frameAddress(place, { lang, theme }) {
  const { path, query, fragment } = partsOf(place);
  const kept = without(query, READERS).slice(1);
  const own = [`lang=${lang}`, ...(theme === "auto" ? [] : [`theme=${theme}`])];
  const shown = isDerived(place) ? ["view=lecture"] : [];
  return `/${path}?${[...(kept ? [kept] : []), ...own, ...shown].join("&")}${fragment}`;
}

/** The frames of a lecture, in the order in which they are needed, with the place that each opens. @param {readonly {place: string}[]} stops */
export function framesOf(stops) {
  /** @type {Map<string, string>} */
  const found = new Map();
  for (const { place } of stops) if (!found.has(frameOf(place))) found.set(frameOf(place), place);
  return [...found].map(([key, place]) => ({ key, place }));
}

/** Whether a place shows steps of a derivation. @param {string} place */
export const hasSteps = isDerived;
