/** What an empty scene and a new row begin with. */

import { componentsOf, dimensionOf, memberOf, rowsOf, SECTIONS } from "./schema.js";

/** @typedef {import("../own.js").SceneDocument} SceneDocument */

/** @type {SceneDocument} */
export const EMPTY = {
  format: 1,
  id: "my-scene",
  title: { de: "Meine Szene", en: "My scene" },
  summary: { de: "", en: "" },
  dimension: 2,
  coordinates: [],
  parameters: [],
  points: [],
  bodies: [],
  loads: [],
  guides: [],
  constraints: [],
  events: [],
};

/** @type {Record<string, SceneDocument>} */
const ROWS = {
  coordinates: { name: "q", unit: "m", value: 0.5, rate: 0 },
  parameters: { name: "a", unit: "", value: 1 },
  points: { name: "point", position: ["0", "0"] },
  bodies: { name: "body", kind: "particle", mass: "", position: ["", ""] },
  loads: { name: "load", kind: "gravity", acceleration: ["0", ""] },
  guides: { coordinate: "", value: "" },
  constraints: { name: "constraint", kind: "equation", equation: "" },
  events: { name: "event", value: "" },
};

/** A copy of a built-in scene, to be changed. @param {SceneDocument} given */
export function copyOf(given) {
  const id = String(given.id ?? "scene");
  return { ...given, id: id.endsWith("-copy") ? id : `${id.slice(0, 58)}-copy` };
}

/** A new row with a name that is still free. @param {SceneDocument} document @param {string} key */
export function rowFor(document, key) {
  const row = structuredClone(ROWS[key]);
  for (const [field, value] of Object.entries(row)) {
    if (Array.isArray(value)) row[field] = componentsOf(value, dimensionOf(document)).map((c) => value[c] ?? "0");
  }
  return typeof row.name === "string" ? { ...row, name: freeName(document, row.name) } : row;
}

/** @param {SceneDocument} document @param {string} wish */
function freeName(document, wish) {
  const taken = new Set(SECTIONS.flatMap(({ key }) => rowsOf(document[key]).map((row) => memberOf(row, "name"))));
  for (let i = 1; ; i++) {
    const name = i === 1 ? wish : `${wish}${i}`;
    if (!taken.has(name)) return name;
  }
}
