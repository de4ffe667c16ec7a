/** The description of the API as a page can show it: calls by subject, each with its fields, an example and its answers. */

/**
 * OpenAPI 3.1, as far as it is shown.
 * @typedef {{$ref?: string, type?: string, anyOf?: Schema[], enum?: unknown[], items?: Schema, properties?: Record<string, Schema>,
 *   required?: string[], examples?: unknown[], description?: string}} Schema
 * @typedef {{name: string, in: string, required?: boolean, description?: string, schema: Schema, example?: unknown}} Parameter
 * @typedef {{operationId: string, tags: string[], summary?: string, description?: string, parameters?: Parameter[],
 *   requestBody?: {content: Record<string, {schema: Schema}>}, responses?: Record<string, {description?: string}>,
 *   "x-codeSamples": Sample[]}} Operation
 * @typedef {{info: {version: string}, tags: {name: string, description: string}[], paths: Record<string, Record<string, Operation>>,
 *   components: {schemas: Record<string, Schema>}}} Description
 */
/** @typedef {{name: string, kind: string, text: string, required: boolean}} Field */
/** @typedef {{lang: string, source: string}} Sample */
/** @typedef {{name: string, place: string, text: string, required: boolean, choices: string[], example: string}} Input  a part of the address */
/** @typedef {{id: string, method: string, path: string, text: string, fields: Field[], inputs: Input[], type: string, examples: string[], samples: Sample[],
 *   answers: {status: string, text: string}[]}} Call  type: of the body, "" without one */
/** @typedef {{subject: string, text: string, calls: Call[]}} Group */

/** Where the samples of the description say the service is. */
const ANYWHERE = "http://localhost:8000";

/** @param {Description} description @param {string} origin where the service is @returns {Group[]} */
export function groupsOf(description, origin) {
  /** @type {Map<string, Call[]>} */
  const groups = new Map(description.tags.map(({ name }) => [name, []]));
  for (const [path, methods] of Object.entries(description.paths)) {
    for (const [method, operation] of Object.entries(methods)) {
      groups.get(operation.tags[0])?.push(callOf(description, method, path, operation, origin));
    }
  }
  return description.tags.map(({ name, description: text }) => ({
    subject: name,
    text,
    calls: groups.get(name) ?? [],
  }));
}

/** @param {Description} description @param {string} method @param {string} path @param {Operation} operation @param {string} origin @returns {Call} */
function callOf(description, method, path, operation, origin) {
  const [type, body] = Object.entries(operation.requestBody?.content ?? {})[0] ?? ["", null];
  const schema = body ? resolved(description, body.schema) : null;
  const parameters = operation.parameters ?? [];
  const given = parameters.map((one) =>
    field(description, one.name, one.schema, one.required === true, one.description),
  );
  return {
    id: operation.operationId,
    method: method.toUpperCase(),
    path,
    text: operation.description || operation.summary || "",
    fields: [...given, ...fieldsOf(description, schema)],
    inputs: parameters.map(inputOf),
    type,
    examples: (schema?.examples ?? []).map(written),
    samples: operation["x-codeSamples"].map(({ lang, source }) => ({
      lang,
      source: source.replaceAll(ANYWHERE, origin),
    })),
    answers: Object.entries(operation.responses ?? {}).map(([status, answer]) => ({
      status,
      text: answer.description ?? "",
    })),
  };
}

/** @param {unknown} example  a body, as it is written */
const written = (example) => (typeof example === "string" ? example : JSON.stringify(example, null, 2));

/** @param {Parameter} parameter @returns {Input} */
function inputOf({ name, in: place, required = false, description: text = "", schema, example }) {
  const kinds = [schema, ...(schema.anyOf ?? [])];
  const choices = kinds.flatMap((kind) => kind.enum?.map(String) ?? (kind.type === "boolean" ? ["true", "false"] : []));
  const shown = example ?? schema.examples?.[0] ?? (required ? choices[0] : undefined);
  return { name, place, text, required, choices, example: String(shown ?? "") };
}

/** @param {Description} description @param {Schema} schema @returns {Schema} */
function resolved(description, schema) {
  const name = schema?.$ref?.split("/").at(-1);
  return name ? description.components.schemas[name] : (schema ?? {});
}

/** @param {Description} description @param {Schema | null} schema @returns {Field[]} */
function fieldsOf(description, schema) {
  const needed = new Set(schema?.required ?? []);
  return Object.entries(schema?.properties ?? {}).map(([name, one]) =>
    field(description, name, one, needed.has(name), one.description),
  );
}

/** @param {Description} description @param {string} name @param {Schema} schema @param {boolean} required @param {string} [text] @returns {Field} */
const field = (description, name, schema, required, text = "") => ({
  name,
  kind: kindOf(description, schema),
  text,
  required,
});

/** @param {Description} description @param {Schema} schema @returns {string} */
function kindOf(description, schema) {
  const { type, anyOf, enum: values, items, $ref } = schema ?? {};
  if ($ref) return kindOf(description, resolved(description, schema));
  if (anyOf)
    return [...new Set(anyOf.map((one) => kindOf(description, one)))].filter((kind) => kind !== "null").join(" | ");
  if (values) return values.join(" | ");
  return type === "array" ? `[${items ? kindOf(description, items) : ""}]` : (type ?? "any");
}
