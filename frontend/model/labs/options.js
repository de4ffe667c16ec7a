/** What experiments ask besides scene and values: how each answer stands in the address, and what it says to the server. */

/** @typedef {import("../types.js").Scene} Scene */
/** @typedef {{parameter: string, from: number, to: number, count?: number}} Side  of a map, or a sweep; `count` of its values */
/** @typedef {number | string | boolean | Side | null} Answer */
/**
 * How something is asked: by its `kind`. `name` is that of the answer in the question, `key` in the address, `label` the
 * key of a text, `description` what is said where there is none. `usual` is the answer until somebody gives another one;
 * `read` makes an answer of an address, the usual one if it makes no sense; `asked` is its part of the request. A number
 * is that of the `field` of the request times `scale`: bounds are the field's, and where the usual answer is none of its
 * own, so is what is shown for it. What is `ofScene` means nothing for another scene, and `usualIn` is usual in one, where
 * nothing is for all.
 * @template {Answer} [A=Answer]
 * @typedef {{kind: "number" | "tick" | "choice" | "text" | "parameter" | "side", name: string, key: string, label: string, usual: A,
 *   read(text: string): A, write(answer: A): string, asked(answer: A): object, choices?: readonly (string | number)[],
 *   field?: string, scale?: number, range?: {shown: number | "", min?: number, max?: number}, description?: string, ofScene?: boolean, values?: number, usualIn?(scene: Scene): A}} Option
 */
/** @typedef {{example: {scene: string} & Partial<import("./question.js").Question>, options: Option[], driven?: boolean}} Experiment  `example` is the question that shows it best; `driven`: not every scene will do */

/** What the service says of a field. @typedef {import("../types.js").Contract["OptionEntry"]} Field */

/** @param {Pick<Option<number>, "name" | "usual" | "field" | "asked"> & Partial<Option<number>>} given @returns {Option<number>} */
export const number = ({ name, usual, ...given }) => ({
  kind: "number",
  name,
  key: name,
  label: name,
  usual,
  ...given,
  read: (text) => Math.max(0, Number(text) || 0) || usual,
  write: (answer) => (answer === usual ? "" : String(answer)),
});

/** How long the motion lasts; zero for as long as is usual. @returns {Option<number>} */
export const duration = () =>
  number({
    name: "duration",
    key: "t",
    usual: 0,
    field: "t_end",
    asked: (seconds) => (seconds ? { t_end: seconds } : {}),
  });

/** @param {string} name @param {boolean} usual @param {(answer: boolean) => object} asked @returns {Option<boolean>} */
export const tick = (name, usual, asked) => ({
  kind: "tick",
  name,
  key: name,
  label: name,
  usual,
  asked,
  read: (text) => (text === (usual ? "0" : "1") ? !usual : usual),
  write: (answer) => (answer === usual ? "" : String(Number(answer))),
});

/** @param {string} name @param {readonly (string | number)[]} choices @param {string | number} usual @returns {Option<string | number>} */
export const choice = (name, choices, usual) => ({
  kind: "choice",
  name,
  field: name,
  key: name,
  label: name,
  usual,
  choices,
  read: (text) => choices.find((one) => String(one) === text) ?? usual,
  write: (answer) => (answer === usual ? "" : String(answer)),
  asked: (answer) => (answer === usual ? {} : { [name]: answer }),
});

/** What a field shows of a number that is usual; nothing where there is none. @param {Answer} usual @returns {number | ""} */
const shownFor = (usual) => Number(usual) || "";

/** The option within the bounds of its field. @param {Option} option @param {readonly Field[]} fields @returns {Option} */
export function bounded(option, fields) {
  const field = fields.find(({ name }) => name === option.field);
  if (!field) return option;
  const { scale = 1, usual, choices } = option;
  const [min, max] = [field.min, field.max].map((bound) =>
    bound == null ? undefined : Number((bound * scale).toPrecision(12)),
  );
  const within = (/** @type {string | number} */ one) =>
    typeof one === "number" ? one >= (min ?? one) && one <= (max ?? one) : field.choices.includes(one);
  if (choices) return { ...option, choices: choices.filter(within) };
  return { ...option, range: { shown: shownFor(usual || Number(field.default) * scale), min, max } };
}

/** A field of an experiment of which the page knows only what the service says. @param {string} lab @param {Field} field @returns {Option} */
export function optionOf(lab, field) {
  const { name, kind, description, choices } = field;
  const usual = field.default ?? "";
  const asked = (/** @type {Answer | undefined} */ answer) =>
    answer === undefined || answer === usual ? {} : { [name]: answer };
  const told = { label: `experiments.${lab}.options.${name}`, description, usual, asked };
  if (name === "t_end") return bounded(duration(), [field]);
  if (kind === "tick") return { ...tick(name, usual === true, () => ({})), ...told };
  if (kind === "choice") return { ...choice(name, choices, String(usual)), ...told };
  const read = (/** @type {string} */ text) => (text !== "" && Number.isFinite(Number(text)) ? Number(text) : usual);
  const write = (/** @type {Answer} */ answer) => (answer === usual ? "" : String(answer));
  const range = { shown: shownFor(usual), min: field.min ?? undefined, max: field.max ?? undefined };
  return { kind, name, key: name, field: name, range, read, write, ...told };
}

/** A number of any sign that the scene knows, until somebody gives another one. @param {string} name @returns {Option<number | null>} */
export const value = (name) => ({
  kind: "number",
  name,
  field: name,
  key: name,
  label: name,
  usual: null,
  ofScene: true,
  read: (text) => (text !== "" && Number.isFinite(Number(text)) ? Number(text) : null),
  write: (answer) => (answer === null ? "" : String(answer)),
  asked: (answer) => (answer === null ? {} : { [name]: answer }),
});

/** @param {"text" | "parameter"} kind @returns {(name: string) => Option<string>} */
const written = (kind) => (name) => ({
  kind,
  name,
  key: name,
  label: name,
  usual: "",
  ofScene: true,
  read: (text) => text,
  write: (answer) => answer,
  asked: (answer) => (answer ? { [name]: answer } : {}),
});

/** An expression in the scene's names, or none. */
export const expression = written("text");

/** A parameter of the scene, or none. */
export const parameter = written("parameter");

/** @param {import("../types.js").Parameter} parameter @returns {Side} */
export const rangeOf = ({ name, value, min, max }) => ({
  parameter: name,
  from: min ?? value / 2,
  to: max ?? value * 2,
});

/**
 * A parameter of the scene and its range, "parameter:from:to" in the address, with the number of its values behind it if
 * one was given.
 * @param {string} name @param {number} last  the last parameters of a driven scene are those that drive it: which of them is usual
 * @param {number} [values]  how many are usual, where that is asked for
 * @returns {Option<Side | null>}
 */
export const side = (name, last, values) => ({
  kind: "side",
  name,
  key: name,
  label: `axis-${name}`,
  usual: null,
  ofScene: true,
  values,
  usualIn({ parameters }) {
    const found = parameters.at(-last);
    return found ? rangeOf(found) : null;
  },
  read(text) {
    const [parameter, ...ends] = text.split(":");
    const [from, to, count] = ends.map(Number);
    if (!parameter || !Number.isFinite(from) || !Number.isFinite(to)) return null;
    return values && count > 0 ? { parameter, from, to, count } : { parameter, from, to };
  },
  write: (answer) =>
    answer ? [answer.parameter, answer.from, answer.to, answer.count].filter((one) => one !== undefined).join(":") : "",
  asked: (answer) => ({ [name]: answer }),
});
