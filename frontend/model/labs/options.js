/** What experiments ask besides scene and values: how each answer stands in the address, and what it says to the server. */

/** @typedef {import("../types.js").Scene} Scene */
/** @typedef {{parameter: string, from: number, to: number}} Side  of a map */
/** @typedef {number | string | boolean | Side | null} Answer */
/**
 * How something is asked: by its `kind`. `name` is that of the answer in the question, `key` in the address, `label` the
 * key of a text. `usual` is the answer until somebody gives another one; `read` makes an answer of an address, the usual
 * one if it makes no sense; `asked` is its part of the request. In the `range` of a number, `shown` stands for an answer
 * of zero. What is `ofScene` means nothing for another scene, and `usualIn` is usual in one, where nothing is for all.
 * @template {Answer} [A=Answer]
 * @typedef {{kind: "number" | "tick" | "choice" | "parameter" | "side", name: string, key: string, label: string, usual: A,
 *   read(text: string): A, write(answer: A): string, asked(answer: A): object, choices?: readonly (string | number)[],
 *   range?: {shown: number, min: number, max: number}, ofScene?: boolean, usualIn?(scene: Scene): A}} Option
 */
/** @typedef {{example: {scene: string} & Partial<import("./question.js").Question>, options: Option[], driven?: boolean}} Experiment  `example` is the question that shows it best; `driven`: not every scene will do */

/** @param {Pick<Option<number>, "name" | "usual" | "range" | "asked"> & Partial<Option<number>>} given @returns {Option<number>} */
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

/** How long the motion lasts; zero for as long as is usual. @param {number} [shown] @returns {Option<number>} */
export const duration = (shown = 10) =>
  number({
    name: "duration",
    key: "t",
    usual: 0,
    range: { shown, min: 0.1, max: 1000 },
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
  key: name,
  label: name,
  usual,
  choices,
  read: (text) => choices.find((one) => String(one) === text) ?? usual,
  write: (answer) => (answer === usual ? "" : String(answer)),
  asked: (answer) => (answer === usual ? {} : { [name]: answer }),
});

/** A parameter of the scene, or none. @param {string} name @returns {Option<string>} */
export const parameter = (name) => ({
  kind: "parameter",
  name,
  key: name,
  label: name,
  usual: "",
  ofScene: true,
  read: (text) => text,
  write: (answer) => answer,
  asked: (answer) => (answer ? { [name]: answer } : {}),
});

/** @param {import("../types.js").Parameter} parameter @returns {Side} */
export const rangeOf = ({ name, value, min, max }) => ({
  parameter: name,
  from: min ?? value / 2,
  to: max ?? value * 2,
});

/** A parameter of the scene and its range, "parameter:from:to" in the address. @param {string} name @param {number} last  the last parameters of a driven scene are those that drive it: which of them is usual @returns {Option<Side | null>} */
export const side = (name, last) => ({
  kind: "side",
  name,
  key: name,
  label: `axis-${name}`,
  usual: null,
  ofScene: true,
  usualIn({ parameters }) {
    const found = parameters.at(-last);
    return found ? rangeOf(found) : null;
  },
  read(text) {
    const [parameter, ...ends] = text.split(":");
    const [from, to] = ends.map(Number);
    return parameter && Number.isFinite(from) && Number.isFinite(to) ? { parameter, from, to } : null;
  },
  write: (answer) => (answer ? `${answer.parameter}:${answer.from}:${answer.to}` : ""),
  asked: (answer) => ({ [name]: answer }),
});
