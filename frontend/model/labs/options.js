/** What experiments ask besides scene and values: how each answer stands in the address, and what it says to the server. */

/** @typedef {import("../types.js").Scene} Scene */
/** @typedef {{parameter: string, from: number, to: number}} Side  of a map */
/**
 * @typedef {object} Option
 * @property {"number" | "tick" | "choice" | "parameter" | "side"} kind  how it is asked
 * @property {string} name  of the answer in the question
 * @property {string} key  of the answer in the address
 * @property {string} label  the key of a text
 * @property {any} usual  the answer until somebody gives another one
 * @property {(text: string) => any} read  the answer in an address, the usual one if it makes no sense
 * @property {(answer: any) => string} write
 * @property {(answer: any) => object} asked  the part of the request
 * @property {readonly (string | number)[]} [choices]
 * @property {{shown: number, min: number, max: number}} [range]  of a number; `shown` stands for an answer of zero
 * @property {boolean} [ofScene]  an answer for one scene means nothing for another
 * @property {(scene: Scene) => any} [usualIn]  what is usual in a scene, where none is for all
 */
/** @typedef {{example: {scene: string} & Record<string, any>, options: Option[], driven?: boolean}} Experiment  `example` is the question that shows it best; `driven`: not every scene will do */

/** @param {Pick<Option, "name" | "usual" | "range" | "asked"> & Partial<Option>} given @returns {Option} */
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

/** How long the motion lasts; zero for as long as is usual. @param {number} [shown] @returns {Option} */
export const duration = (shown = 10) =>
  number({
    name: "duration",
    key: "t",
    usual: 0,
    range: { shown, min: 0.1, max: 1000 },
    asked: (seconds) => (seconds ? { t_end: seconds } : {}),
  });

/** @param {string} name @param {boolean} usual @param {Option["asked"]} asked @returns {Option} */
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

/** @param {string} name @param {readonly (string | number)[]} choices @param {string | number} usual @returns {Option} */
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

/** A parameter of the scene, or none. @param {string} name @returns {Option} */
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

/** A parameter of the scene and its range, "parameter:from:to" in the address. @param {string} name @param {number} last  the last parameters of a driven scene are those that drive it: which of them is usual @returns {Option} */
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
