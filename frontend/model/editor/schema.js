/** What the form asks for: the fields of scene format 1, section by section. */

import { tableOf } from "../own.js";

/** @typedef {import("../own.js").SceneDocument} SceneDocument */
/** @typedef {"text" | "number" | "flag" | "expression" | "vector" | "tensor" | "place" | "coordinate" | "material"} FieldType */
/** @typedef {{key: string, type: FieldType, optional?: boolean}} Field */
/** What a field of the form shows, and where it stands. @typedef {{pointer: string, value: unknown, type: FieldType, material: string[]}} Part */
/** @typedef {{key: string, kinds?: Record<string, Field[]>, fields: Field[]}} Section */

/** @param {string} key @param {FieldType} type @returns {Field} */
const field = (key, type) => ({ key, type });
/** @param {string} key @param {FieldType} type @returns {Field} */
const optional = (key, type) => ({ key, type, optional: true });

const NAME = field("name", "text");
const SYMBOL = [NAME, optional("latex", "text"), optional("unit", "text"), field("value", "number")];
const RANGE = [optional("min", "number"), optional("max", "number")];
const ENDS = [field("from", "place"), field("to", "place")];
const POSITION = field("position", "vector");
const MATERIAL = field("material", "material");

/** @type {Section[]} */
export const SECTIONS = [
  { key: "coordinates", fields: [...SYMBOL, field("rate", "number"), ...RANGE] },
  { key: "parameters", fields: [...SYMBOL, ...RANGE, optional("positive", "flag")] },
  { key: "points", fields: [NAME, POSITION] },
  {
    key: "bodies",
    fields: [NAME],
    kinds: {
      particle: [field("mass", "expression"), POSITION],
      rigid: [field("mass", "expression"), POSITION, field("inertia", "expression"), field("angle", "expression")],
      continuum: [MATERIAL, field("density", "expression"), POSITION],
    },
  },
  {
    key: "loads",
    fields: [NAME],
    kinds: {
      gravity: [field("acceleration", "vector")],
      force: [field("at", "place"), field("force", "vector")],
      spring: [...ENDS, field("stiffness", "expression"), optional("rest_length", "expression")],
      damper: [...ENDS, field("coefficient", "expression")],
      moment: [field("angle", "expression"), field("moment", "expression")],
      potential: [field("energy", "expression")],
      "generalized-potential": [field("energy", "expression")],
      dissipation: [field("function", "expression")],
      friction: [
        field("coordinate", "expression"),
        field("force", "expression"),
        optional("static", "expression"),
        optional("surface_rate", "expression"),
      ],
      distributed: [MATERIAL, POSITION, field("density", "vector")],
    },
  },
  { key: "guides", fields: [field("coordinate", "coordinate"), field("value", "expression")] },
  {
    key: "constraints",
    fields: [NAME],
    kinds: {
      equation: [field("equation", "expression"), optional("multiplier", "text")],
      distance: [...ENDS, field("length", "expression"), optional("multiplier", "text")],
    },
  },
  {
    key: "events",
    fields: [NAME, field("value", "expression"), optional("then", "text"), optional("restitution", "expression")],
  },
];

/** In space a rigid body has three principal moments or a tensor, and an angular velocity in place of an angle. */
const RIGID_IN_SPACE = [
  field("mass", "expression"),
  POSITION,
  field("inertia", "tensor"),
  field("angular_velocity", "vector"),
];

/** The fields of a row. @param {Section} section @param {unknown} row @param {number} dimension @returns {Field[]} */
export function fieldsOf(section, row, dimension) {
  const kind = memberOf(row, "kind");
  if (kind === "rigid" && dimension === 3) return [...section.fields, ...RIGID_IN_SPACE];
  return [...section.fields, ...(section.kinds?.[String(kind)] ?? [])];
}

/** Whether a field holds several values. @param {Field} field */
export const isList = ({ type }) => ["vector", "tensor", "material"].includes(type);

/** What an empty field of numbers means. @type {Record<string, Record<string, string>>} */
const STANDARD = { coordinates: { value: "0", rate: "0" }, parameters: { value: "1" } };

/** @param {string} section @param {string} key */
export const standardOf = (section, key) => STANDARD[section]?.[key] ?? "";

/** The material coordinates of a row, as names. @param {unknown} row @returns {string[]} */
export const materialOf = (row) => rowsOf(memberOf(row, "material")).map(nameOf);

/** @param {unknown} value @returns {unknown[]} */
export const rowsOf = (value) => (Array.isArray(value) ? value : []);

/** A member of a row, if it is a table: whoever types may have typed anything. @param {unknown} row @param {string} key */
export const memberOf = (row, key) => tableOf(row)?.[key];

/** @param {unknown} row */
export const nameOf = (row) => String(memberOf(row, "name") ?? "");

/** @param {SceneDocument} given */
export const dimensionOf = (given) => (given.dimension === 3 ? 3 : 2);

/** How many components a vector field shows: none that is there is hidden. @param {unknown} vector @param {number} dimension */
export const componentsOf = (vector, dimension) =>
  Array.from({ length: Math.max(dimension, rowsOf(vector).length) }, (_, i) => i);

/** Whether the moments of inertia are given as the rows of a tensor. @param {unknown} inertia */
export const isTensor = (inertia) => rowsOf(inertia).some(Array.isArray);

/**
 * The same inertia in the other form: the rows of a tensor for principal moments, and the diagonal for a tensor.
 * @param {unknown} inertia
 */
export function otherInertia(inertia) {
  const axes = [0, 1, 2];
  const moments = axes.map((k) =>
    String((isTensor(inertia) ? rowsOf(rowsOf(inertia)[k])[k] : rowsOf(inertia)[k]) ?? "0"),
  );
  return isTensor(inertia) ? moments : axes.map((k) => axes.map((l) => (k === l ? moments[k] : "0")));
}

/**
 * Every field the form shows, as a pointer, with what stands in it.
 * @param {SceneDocument} document
 * @returns {Part[]}
 */
export function shownFields(document) {
  return SECTIONS.flatMap((section) =>
    rowsOf(document[section.key]).flatMap((row, i) =>
      fieldsOf(section, row, dimensionOf(document)).flatMap((field) =>
        parts(`/${section.key}/${i}/${field.key}`, field.type, memberOf(row, field.key), row, dimensionOf(document)),
      ),
    ),
  );
}

/** @param {string} pointer @param {FieldType} type @param {unknown} value @param {unknown} row @param {number} dimension @returns {Part[]} */
function parts(pointer, type, value, row, dimension) {
  const material = materialOf(row);
  if (type === "tensor" && isTensor(value))
    return componentsOf(value, dimension).flatMap((c) =>
      parts(`${pointer}/${c}`, "vector", rowsOf(value)[c], row, dimension),
    );
  if (type === "vector" || type === "tensor") {
    return componentsOf(value, dimension).map((c) => ({
      pointer: `${pointer}/${c}`,
      value: rowsOf(value)[c],
      type: /** @type {FieldType} */ ("expression"),
      material,
    }));
  }
  if (type !== "material") return [{ pointer, value, type, material }];
  return rowsOf(value).flatMap((one, i) =>
    ["name", "from", "to"].map((key) => ({
      pointer: `${pointer}/${i}/${key}`,
      value: memberOf(one, key),
      type: /** @type {FieldType} */ (key === "name" ? "text" : "expression"),
      material: [],
    })),
  );
}
