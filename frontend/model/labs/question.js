/** What a lab is asked: which experiment, on which scene, with which values; as an address, and as a request. */

import { KNOWN } from "./experiments.js";

/** @typedef {import("./experiments.js").Experiments} Experiments */

/** @typedef {import("../types.js").Scene} Scene */
/** @typedef {import("./options.js").Answer} Answer */
/**
 * @typedef {{lab: string, scene: string, parameters: Record<string, number>,
 *   initial: Record<string, {value?: number, rate?: number}>, [option: string]: unknown}} Question  with an answer to every option
 */

/** What is answered to an option. @param {Question} question @param {string} option */
const answerTo = (question, option) => /** @type {Answer} */ (question[option]);

const FIRST = "work-precision";

/** The usual answer to everything that may be asked. @param {string} lab @param {Experiments} known */
const usualOf = (lab, known) => Object.fromEntries(known.options(lab).map(({ name, usual }) => [name, usual]));

/** @type {Question} */
export const NOTHING = { lab: FIRST, scene: "", ...usualOf(FIRST, KNOWN), parameters: {}, initial: {} };

/** The scene that shows a lab best, and what else to ask there. @param {string} lab @param {Experiments} [known] */
export const exampleOf = (lab, known = KNOWN) => known.experiment(lab).example;

/** @param {string} query @param {Experiments} [known] */
export function readQuestion(query, known = KNOWN) {
  const given = new URLSearchParams(query);
  const lab = given.get("lab") || FIRST;
  const answers = known
    .options(lab)
    .map(({ name, key, usual, read }) => [name, given.has(key) ? read(given.get(key) ?? "") : usual]);
  /** @type {Question} */
  const question = {
    ...NOTHING,
    lab,
    scene: given.get("scene") ?? "",
    ...Object.fromEntries(answers),
    parameters: {},
    initial: {},
  };
  for (const [key, text] of given) put(question, key, Number(text));
  return question;
}

/** A value in the address: p.l, q.phi, v.phi. @param {Question} question @param {string} key @param {number} value */
function put(question, key, value) {
  const [kind, name] = [key.slice(0, 2), key.slice(2)];
  if (!name || !Number.isFinite(value)) return;
  if (kind === "p.") question.parameters[name] = value;
  if (kind === "q.") question.initial[name] = { ...question.initial[name], value };
  if (kind === "v.") question.initial[name] = { ...question.initial[name], rate: value };
}

/** The query of a question, without what is as usual. @param {Question} question @param {Experiments} [known] */
export function writeQuestion(question, known = KNOWN) {
  const { parameters, initial, lab, scene } = question;
  const answers = known.options(lab).map(({ name, key, write }) => [key, write(answerTo(question, name))]);
  const values = Object.entries(parameters).map(([name, value]) => [`p.${name}`, value]);
  const starts = Object.entries(initial).flatMap(([name, { value, rate }]) => [
    [`q.${name}`, value],
    [`v.${name}`, rate],
  ]);
  const query = new URLSearchParams();
  for (const [key, value] of [["lab", lab], ["scene", scene], ...answers, ...values, ...starts]) {
    if (value !== "" && value !== undefined) query.set(String(key), String(value));
  }
  return query.toString().replaceAll("%3A", ":");
}

/** @param {Question} question @param {string | object} scene @param {string} lang @param {Experiments} [known] */
export function requestOf(question, scene, lang, known = KNOWN) {
  const { lab, parameters, initial } = question;
  return Object.assign(
    { scene, parameters, initial, lang },
    ...known.experiment(lab).options.map(({ name, asked }) => asked(answerTo(question, name))),
  );
}

/** The question with the answers that are usual in its scene, where nobody has given any. @param {Question} question @param {Scene | null} scene @param {Experiments} [known] @returns {Question} */
export function answered(question, scene, known = KNOWN) {
  const usual = known
    .experiment(question.lab)
    .options.flatMap(({ name, usualIn }) => (scene && usualIn ? [[name, question[name] ?? usualIn(scene)]] : []));
  return { ...question, ...Object.fromEntries(usual) };
}

/** The same on another scene: what was said of the one before goes. @param {Question} question @param {string} scene @returns {Question} */
export function onScene(question, scene) {
  const ofScene = KNOWN.options(question.lab)
    .filter((option) => option.ofScene)
    .map(({ name, usual }) => [name, usual]);
  return { ...question, scene, parameters: {}, initial: {}, ...Object.fromEntries(ofScene) };
}

/** Whether nobody has chosen anything: scene and values are still those that show the lab best. @param {Question} question */
function isExample({ lab, scene, parameters, initial }) {
  const { example } = KNOWN.experiment(lab);
  return (
    scene === example.scene &&
    JSON.stringify([parameters, initial]) === JSON.stringify([example.parameters ?? {}, example.initial ?? {}])
  );
}

/** Another lab, on the same scene if somebody chose it; else, or where not every scene will do, on the one that shows it best. @param {Question} question @param {string} lab @param {Experiments} [known] @returns {Question} */
export function inLab(question, lab, known = KNOWN) {
  const { example, options, driven } = known.experiment(lab);
  const whole = { ...usualOf(lab, known), ...question, lab };
  if (question.scene && !driven && !isExample(question)) return whole;
  const shown = { ...whole, parameters: {}, initial: {}, ...example, lab };
  const said = options.filter(({ name, ofScene }) => ofScene && question[name] && shown.scene === question.scene);
  return { ...shown, ...Object.fromEntries(said.map(({ name }) => [name, question[name]])) };
}

/** @param {Question["initial"]} initial @param {string} quantity  a coordinate, or dot of one: its rate @param {number} amount */
function begunAt(initial, quantity, amount) {
  const name = /^dot\((.+)\)$/.exec(quantity)?.[1];
  return name
    ? { ...initial, [name]: { ...initial[name], rate: amount } }
    : { ...initial, [quantity]: { ...initial[quantity], value: amount } };
}

/** The motion at a point of a map: two parameters, two components of the start, or two angles at rest. @param {Question} question @param {import("./chart.js").Contract["TraceMeaning"]} map @param {number} x @param {number} y @returns {Pick<Question, "parameters" | "initial">} */
export function pointOf({ parameters, initial }, { role, ...axes }, x, y) {
  const [across, up] = [axes.x ?? "", axes.y ?? ""];
  if (role === "map") return { parameters: { ...parameters, [across]: x, [up]: y }, initial };
  if (role === "basins") return { parameters, initial: begunAt(begunAt(initial, across, x), up, y) };
  const still = Object.fromEntries(Object.entries(initial).map(([name, start]) => [name, { ...start, rate: 0 }]));
  return { parameters, initial: { ...still, [across]: { value: x, rate: 0 }, [up]: { value: y, rate: 0 } } };
}
